#!/usr/bin/env bash
# A person at the labelling window, on a screen of its own: fifteen clicks, a drag, an undo, save,
# end. Exits with 77 where there is no Xvfb or no xdotool.
#   x11_session.sh POSELIFT_LABEL POSELIFT PICTURE FOLDER
set -euo pipefail
label=$1
poselift=$2
picture=$3
folder=$4

for program in Xvfb xdotool; do
  command -v $program >/dev/null || { echo "skipped: there is no $program"; exit 77; }
done
rm -rf "$folder"
mkdir -p "$folder"
cp "$picture" "$folder/picture.jpg"
cd "$folder"

# -noreset: it would begin anew, and drop who connects, whenever its last client leaves.
Xvfb -noreset -displayfd 3 -screen 0 1400x900x24 3>display >xvfb.log 2>&1 &
trap 'jobs -p | xargs -r kill -9 2>/dev/null || true' EXIT
# await WHAT COMMAND...: within a minute.
await() {
  local what=$1
  shift
  for _ in {1..600}; do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 0.1
  done
  echo "$what never came" >&2
  exit 1
}
await "the screen" test -s display
DISPLAY=:$(<display)
export DISPLAY

"$label" picture.jpg >out 2>err &
window=$!
await "the window" xdotool search --onlyvisible --name 'picture.labels.json'
id=$(xdotool search --onlyvisible --name 'picture.labels.json' | tail -1)
xdotool windowmove --sync "$id" 0 0 || true
sleep 1

# A body, within the part of the window that shows the picture.
# shellcheck disable=SC2054  # x,y
clicks=(590,350 620,265 625,198 648,274 588,272 618,313 577,300 571,286 575,307 613,371 585,364
  590,457 512,347 595,545 419,354)
for click in "${clicks[@]}"; do
  xdotool mousemove --sync "${click%,*}" "${click#*,}" click 1
  sleep 0.1
done
count() { grep -o '"state"' .picture.labels.json.journal | wc -l; }
await "the last click" grep -q right_ankle .picture.labels.json.journal
xdotool mousemove --sync 590 457 mousedown 1 mousemove --sync 600 440 mousemove --sync 620 420 mouseup 1
sleep 0.3
xdotool key ctrl+z
sleep 0.3
xdotool key ctrl+s
await "the saved labels" grep -q right_ankle picture.labels.json
kill "$window"

# Places are those of the clicks, but for a scale and a shift.
joints=(pelvis neck head_top left_shoulder right_shoulder left_elbow right_elbow left_wrist
  right_wrist left_hip right_hip left_knee right_knee left_ankle right_ankle)
for i in "${!joints[@]}"; do
  place=$(grep -o "\"${joints[i]}\": {\"x\": [-0-9.e]*, \"y\": [-0-9.e]*" picture.labels.json |
    sed 's/.*"x": //; s/, "y":/ /')
  echo "${clicks[i]/,/ } $place"
done | awk '
  NF != 4 {print "a label is missing"; exit wrong = 1}
  {wx[NR] = $1; wy[NR] = $2; px[NR] = $3; py[NR] = $4}
  END {
    if (wrong) exit 1
    scale = (px[13] - px[2]) / (wx[13] - wx[2])
    if (scale <= 0) {print "mirrored"; exit 1}
    for (i = 1; i <= NR; ++i) {
      dx = px[i] - px[1] - scale * (wx[i] - wx[1]); dy = py[i] - py[1] - scale * (wy[i] - wy[1])
      if (dx * dx + dy * dy > 4 * scale * scale) {print "label " i " is off by " dx ", " dy; exit 1}
    }
    exit NR != 15
  }'
"$poselift" lift picture.jpg --out lifted >lift.log
grep -q ^MOTION lifted/poses.bvh
echo "fifteen clicks became a BVH"
