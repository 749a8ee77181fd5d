#!/usr/bin/env bash
# Tracks a person in tags for long, at the speed of a camera:
#   soak.sh POSELIFT CLIP SECONDS
# CLIP: pictures, shown there and back at 30 a second, camera.yaml and tags.toml, as
# poselift_make_clip and poselift_render_tags write them. Fails when memory grows, when a frame is
# neither followed by a line nor told as lost, or when the recording lacks one. Times are printed,
# not judged. The video takes some 3 MB a second in $TMPDIR meanwhile.
set -euo pipefail
poselift=$(realpath "$1")
clip=$(realpath "$2")
seconds=$3
rate=30
most_growth_kb=6144 # of memory, from the second fifth of the time to the last

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

mapfile -t pictures < <(find "$clip" -maxdepth 1 -name '*.jpg' -o -maxdepth 1 -name '*.png' | sort)
((${#pictures[@]} >= 2)) || { echo "$clip: wanted two pictures or more" >&2; exit 1; }
back=("${pictures[@]:1:${#pictures[@]}-2}")
mapfile -t back < <(printf '%s\n' "${back[@]}" | tac)
cat "${pictures[@]}" "${back[@]}" |
  ffmpeg -loglevel error -f image2pipe -framerate $rate -i - -c:v mjpeg -q:v 2 -pix_fmt yuvj422p \
    cycle.mkv
ffmpeg -loglevel error -stream_loop -1 -i cycle.mkv -t "$seconds" -c copy video.mkv
shown=$(ffprobe -loglevel error -count_packets -select_streams v \
  -show_entries stream=nb_read_packets -of csv=p=0 video.mkv | tr -d ,)

echo "load average $(cut -d' ' -f1-3 /proc/loadavg) before"
mkfifo lines
wc -l <lines >num_lines &
counter=$!
"$poselift" track video.mkv --realtime --camera "$clip/camera.yaml" --tags "$clip/tags.toml" \
  --stream --udp 47000 --out run --json report.json >lines 2>log &
tracker=$!
step=$((seconds > 100 ? 10 : 1))
while sleep $step && kill -0 $tracker 2>/dev/null; do
  awk '/^VmRSS/ {print $2}' /proc/$tracker/status >>memory_kb || true
done
wait $tracker || { cat log >&2; exit 1; }
wait $counter
echo "load average $(cut -d' ' -f1-3 /proc/loadavg) after"
cat log

number() { sed -n "s/^ *\"$1\": \([0-9]*\).*/\1/p" report.json; }
frames=$(number frames) lost=$(number lost) lines=$(<num_lines)
recorded=$(grep -o '"time_s"' run/poses.json | wc -l)
angles=$(($(wc -l <run/angles.csv) - 1))
echo "$shown frames shown, $frames tracked, $lost lost; $lines lines, $recorded in poses.json," \
  "$angles in angles.csv; recorded $(du -sk run | cut -f1) KB"
echo "memory, KB, each $step s: $(tr '\n' ' ' <memory_kb)"
growth=$(awk '{kb[NR] = $1}
  END {for (i = int(NR / 5) + 1; i <= NR; ++i) {n = i - int(NR / 5)
         if (n <= NR / 5) {first += kb[i]; f++}
         if (i > NR - NR / 5) {last += kb[i]; l++}}
       printf "%d", last / l - first / f}' memory_kb)
echo "memory grew by $growth KB, at most $most_growth_kb"
((frames + lost == shown && lines == frames && recorded == frames && angles == frames)) ||
  { echo "frames are not accounted for" >&2; exit 1; }
((growth <= most_growth_kb)) || { echo "memory grows" >&2; exit 1; }
