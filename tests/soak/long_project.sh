#!/usr/bin/env bash
# Opens what is large in the labelling window and says how much memory that takes:
#   long_project.sh POSELIFT_LABEL [MOST_MB]
# A video of ten minutes, 1280 x 720, a key frame each ten seconds, whose labels file is made first;
# the same again, from its labels file, some seconds later; and a photo of 50 megapixels. Fails when
# one of them takes more than MOST_MB (700) at its peak. Wants ffmpeg; no screen.
set -euo pipefail
label=$(realpath "$1")
most_mb=${2:-700}
export QT_QPA_PLATFORM=offscreen

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

ffmpeg -loglevel error -f lavfi -i testsrc2=s=1280x720:r=30:d=10 -c:v libx264 -preset veryfast \
  -g 300 -bf 2 -pix_fmt yuv420p cycle.mp4
ffmpeg -loglevel error -stream_loop 59 -i cycle.mp4 -c copy long.mp4
ffmpeg -loglevel error -f lavfi -i testsrc2=s=8660x5774 -frames:v 1 -q:v 2 photo.jpg

is_too_much=0
# What it opens, the file whose being there says that it has read all, and seconds more.
peak_of() {
  local what=$1 file=$2 more_s=$3
  shift 3
  local start=$SECONDS
  "$label" "$@" 2>log &
  local window=$!
  until [[ -s $file ]]; do
    kill -0 $window 2>/dev/null || { cat log >&2; exit 1; }
    sleep 0.2
  done
  local opened_s=$((SECONDS - start))
  sleep "$more_s"
  local peak_mb
  peak_mb=$(awk '/^VmHWM/ {printf "%d", $2 / 1024}' /proc/$window/status)
  kill $window
  wait $window 2>/dev/null || true
  echo "$what: open after $opened_s s, $peak_mb MB at its peak in all $((SECONDS - start)) s"
  ((peak_mb <= most_mb)) || is_too_much=1
}

peak_of "10 minutes of video, new" long.labels.json 10 long.mp4
peak_of "10 minutes of video, again" long.labels.json 40 long.mp4
peak_of "50 megapixels" photo.labels.json 10 photo.jpg
echo "frames: $(grep -o '"time_s"' long.labels.json | wc -l)"
((is_too_much == 0)) || { echo "wanted at most $most_mb MB" >&2; exit 1; }
