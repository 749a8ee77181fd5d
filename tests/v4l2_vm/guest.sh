#!/usr/bin/env bash
# What capture makes of the kernel's virtual cameras: run by run.sh, in the virtual machine.
#   guest.sh PROBE POSELIFT CLIP [WINDOW_TESTS]
# vivid, /dev/video0, is a webcam with controls, faults at request among them; what a program
# writes into v4l2loopback, /dev/video10, comes out of it as from a camera. PROBE is
# poselift_capture_probe, CLIP of poselift_make_clip, WINDOW_TESTS poselift_window_tests, where Qt is
# installed. A line a check; exits with 1 when one failed.
set -uo pipefail
probe=$1
poselift=$2
clip=$3
window_tests=${4-}
camera=/dev/video0
loopback=/dev/video10

work=$(mktemp -d /dev/shm/check.XXXX)
chmod 777 "$work"
cd "$work" || exit 1
modprobe -d "$POSELIFT_VM_CACHE" vivid n_devs=1 node_types=0x1 || exit 1
modprobe -d "$POSELIFT_VM_CACHE" v4l2loopback video_nr=${loopback#/dev/video} card_label=loop || exit 1

# check WORDS...: runs the function check_WORDS and says how it went; when it failed, with its last
# commands and what the probe printed. It may leave a reason in the file `skipped`, and in `told`
# what is to be printed with it.
failures=0
check() {
  local words=$* begin=${EPOCHREALTIME/./} code seconds
  rm -f out err skipped told
  (
    trap 'exec 2>&-; jobs -p | xargs -r kill -9' EXIT
    set -ex
    "check_${words// /_}"
  ) >trace 2>&1
  code=$?
  seconds=$(((${EPOCHREALTIME/./} - begin) / 1000000))
  if [[ -e skipped ]]; then
    echo "skipped  $words: $(<skipped)"
  elif ((code == 0)); then
    echo "ok       $words ($seconds s)"
    if [[ -e told ]]; then sed 's/^/         /' told; fi
  else
    echo "FAILED   $words ($seconds s)"
    tail -n 6 trace out err 2>/dev/null | cut -c1-300
    failures=$((failures + 1))
  fi
}

# probe ARGUMENTS...: what it prints goes to the files out and err, its exit code to $code.
probe() {
  code=0
  "$probe" "$@" >out 2>err || code=$?
}
# has PATTERN [FILE]: whether a line of the file (out) holds it.
has() { grep -Eq -- "$1" "${2:-out}" || { echo "wanted '$1' in ${2:-out}"; return 1; }; }
# refused PATTERN: the last probe ended with that message, one line.
refused() { ((code == 3)) && has "$1" err && (($(wc -l <err) == 1)); }
# value KEY: of a line KEY=VALUE of the last probe.
value() { sed -n "s/^$1=//p" out; }
# control NAME=VALUE[,...]: of vivid
control() { v4l2-ctl -d $camera -c "$1"; }
# in_background ARGUMENTS...: a probe that goes on while others work, once three frames came.
in_background() {
  "$probe" "$@" >out 2>err &
  background=$!
  await 'frame=2 '
}
# ended: the probe in the background has ended by itself.
ended() {
  code=0
  wait "$background" || code=$?
}
# await PATTERN: a line of out, within ten seconds.
await() {
  for _ in {1..200}; do
    grep -q -- "$1" out && return
    sleep 0.05
  done
  echo "'$1' never came"
  return 1
}

# Every frame came, whole, in the size of its format, and is as bright as vivid's white.
stream() { # stream FORMAT BYTES GREY
  control test_pattern=6,osd_text_mode=2
  probe $camera --format "$1" --size 640x480 --rate 25 --frames 10
  ((code == 0))
  [[ $(value asked) == "640x480 $1 25 Hz" && $(value given) == "$(value asked)" ]]
  (($(value num_given) == 10 && $(value num_bad) == 0 && $(value num_undecodable) == 0))
  (($(grep -c "frame=.* bytes=$2 mean=$3.*flaw=''" out) == 10))
  probe $camera --format "$1" --size 640x480 --frames 2 --bgr
  (($(grep -c "frame=.* mean=254" out) == 2))
  control test_pattern=0,osd_text_mode=0
}
check_YUYV_streams() { stream YUYV 614400 234; }
check_NV12_streams() { stream NV12 460800 234; }
check_GREY_streams() { stream GREY 307200 254; }

check_cameras_are_listed() {
  probe --list
  ((code == 0))
  has "camera=$camera name='vivid' driver=vivid .* problem=''"
  has "camera=$loopback name='loop'"
  for format in YUYV NV12 GREY; do
    has "format=$format size=640x480 .* rates=25.000,15.000"
    has "format=$format size=1280x720 .* rates=12.500,10.000"
  done
}

check_what_is_given_is_told_from_what_was_asked() {
  probe $camera --format YUYV --size 1000x700 --rate 100 --frames 2
  [[ $(value asked) == "1000x700 YUYV 100 Hz" && $(value given) == "1280x720 YUYV 12.5 Hz" ]]
  probe $camera --format MJPG --size 640x360 --rate 30 --frames 2
  [[ $(value asked) == "640x360 MJPG 30 Hz" && $(value given) == "640x360 "[!M]*" 30 Hz" ]]
}

# The frames that are counted as lost are those missing in the driver's count.
check_lost_frames_are_counted() {
  control percentage_of_dropped_buffers=50
  probe $camera --format YUYV --size 320x180 --rate 30 --frames 20
  control percentage_of_dropped_buffers=0
  ((code == 0 && $(value num_given) == 20 && $(value num_lost) > 0))
  awk -F'[= ]' '/^frame=/ {if (n++) {lost += $6; if ($4 - last != $6 + 1) wrong = 1}
    last = $4} END {exit wrong || lost == 0}' out
}

check_times_grow() {
  probe $camera --format GREY --size 320x180 --rate 60 --frames 40
  awk -F'[= ]' '/^frame=/ {if (n++ && $8 <= last) wrong = 1; last = $8}
    END {exit wrong || n != 40}' out
}

check_broken_frames_are_counted_and_passed_over() {
  in_background $camera --format YUYV --size 320x180 --rate 30 --frames 40
  control inject_v4l2_buf_flag_error=1
  ended
  ((code == 0 && $(value num_given) == 40 && $(value num_bad) >= 1))
  has "frame=.* lost=1 .*flaw=''"
}

check_an_error_of_the_driver_ends_the_stream() {
  in_background $camera --format YUYV --size 320x180 --rate 30 --frames 400
  control inject_fatal_streaming_error=1
  ended
  refused "$camera: "
  (($(grep -c ^frame= out) < 400))
}

check_a_driver_that_does_not_start_is_told_and_left_usable() {
  for fault in reqbufs qbuf streamon; do
    control inject_vidioc_${fault}_error=1
    probe $camera --size 320x180 --frames 2
    refused "$camera: cannot (share memory with it|start streaming)"
    probe $camera --size 320x180 --frames 2
    ((code == 0))
  done
}

check_a_busy_camera_is_told() {
  in_background $camera --format YUYV --size 320x180 --rate 30 --frames 400
  code=0
  "$probe" $camera --frames 2 >second 2>err || code=$?
  refused "$camera: is used by another program"
  "$probe" --list >list
  has "camera=$camera .*problem=''" list
  await "frame=$(($(grep -c ^frame= out) + 5)) " # the first one goes on
}

check_a_format_that_another_program_set_is_set_anew() {
  v4l2-ctl -d $camera --set-fmt-video=width=320,height=180,pixelformat=NV12
  probe $camera --format YUYV --size 640x480 --rate 15 --frames 2
  [[ $(value given) == "640x480 YUYV 15 Hz" ]]
  (($(grep -c 'bytes=614400 ' out) == 2))
}

check_controls_are_listed_and_set() {
  control gain_automatic=1
  probe --controls $camera
  has '^control=brightness lowest=0 highest=255 step=1 preset=128 value=128 inactive=false'
  has '^control=gain .*inactive=true' # the automatic has it
  has "^control=menu .*menu=1:'Menu Item 1',3:"
  probe $camera --size 320x180 --frames 1 --set brightness=77 --set gain=50
  has '^control=brightness asked=77 given=77'
  has '^control=gain asked=50 given=50'
  v4l2-ctl -d $camera -C brightness,gain_automatic,gain >values
  [[ $(sort values | tr '\n' ' ') == 'brightness: 77 gain: 50 gain_automatic: 0 ' ]]
  probe $camera --frames 1 --set brigtness=77
  refused brightness
  probe $camera --frames 1 --set brightness=777
  refused 'brightness = 777, wanted 0 to 255'
  control brightness=128,gain_automatic=1
}

check_permission_denied_is_told() {
  chmod 600 $camera
  code=0
  setpriv --reuid 65534 --regid 65534 --clear-groups "$probe" $camera >out 2>err || code=$?
  refused "$camera: no permission"
  setpriv --reuid 65534 --regid 65534 --clear-groups "$probe" --list >out
  has "camera=$camera .*problem='.*no permission"
}

check_what_is_no_camera_is_told() {
  probe /dev/video77
  refused '/dev/video77: no such device'
  probe /dev/null
  refused '/dev/null: is no video device'
  probe "$work"
  refused "$work: "
}

check_an_unplugged_camera_is_told() {
  in_background $camera --format YUYV --size 320x180 --rate 30 --frames 400
  echo vivid.0 >/sys/bus/platform/drivers/vivid/unbind
  ended
  refused "$camera: is gone: unplugged"
  probe $camera
  refused "$camera: no such device"
  echo vivid.0 >/sys/bus/platform/drivers/vivid/bind
  probe $camera --size 320x180 --frames 2
  ((code == 0))
}

check_a_camera_that_disconnects_is_told() {
  in_background $camera --format YUYV --size 320x180 --rate 30 --frames 400
  control disconnect=1
  ended
  refused "$camera: is gone: unplugged"
}

# A program that writes into the loopback device, as those do that make a webcam of a desktop; the
# first of its frames is kept for the checks below.
check_MJPG_streams_from_ffmpeg() {
  ffmpeg -hide_banner -loglevel error -re -f lavfi -i color=white:size=640x480:rate=15 \
    -pix_fmt yuvj422p -c:v mjpeg -f v4l2 $loopback \
    -pix_fmt yuvj422p -c:v mjpeg -frames:v 1 "$work/white.jpg" </dev/null &
  for _ in {1..300}; do
    v4l2-ctl -d $loopback --get-fmt-video 2>&1 | grep -q MJPG && break
    sleep 0.1
  done
  sleep 1
  probe $loopback --format MJPG --size 640x480 --frames 10 --bgr
  ((code == 0 && $(value num_given) == 10 && $(value num_undecodable) == 0))
  [[ $(value given) == "640x480 MJPG"* ]]
  (($(grep -c "frame=.* mean=25[45].*flaw=''" out) == 10))
}

# write FORMAT SIZE FILE...: the files by turns, a frame each, until the check ends.
write() {
  local format=$1 size=$2
  shift 2
  v4l2-ctl -d $loopback -c keep_format=0
  v4l2-ctl -d $loopback -c keep_format=1 \
    --set-fmt-video-out=width="${size%x*}",height="${size#*x}",pixelformat="$format"
  (
    set +x
    while :; do
      for frame in "$@"; do
        dd if="$frame" bs=1M status=none # by one write
        sleep 0.05
      done
    done >$loopback
  ) &
  writer=$!
  sleep 0.5
}

check_damaged_MJPG_is_told_frame_by_frame() {
  head -c 1500 white.jpg >cut.jpg
  head -c 9000 /dev/urandom >noise.jpg
  write MJPG 640x480 white.jpg cut.jpg white.jpg noise.jpg
  probe $loopback --format MJPG --size 640x480 --frames 20 --bgr
  ((code == 0 && $(value num_given) == 20))
  local good
  good=$(grep -c "frame=.* mean=25[45].*flaw=''" out)
  ((good > 3 && good < 17 && good + $(value num_undecodable) == 20))
}

check_the_format_of_a_writer_is_taken_as_it_is() {
  head -c $((320 * 240 * 2)) /dev/zero | tr '\0' '\200' >grey.yuyv
  write YUYV 320x240 grey.yuyv
  probe $loopback --format MJPG --size 640x480 --frames 5
  ((code == 0 && $(value num_given) == 5))
  [[ $(value given) == "320x240 YUYV"* ]]
  (($(grep -c "frame=.* bytes=153600 mean=128.00 flaw=''" out) == 5))
}

check_a_camera_that_stops_sending_is_told() {
  write MJPG 640x480 white.jpg
  in_background $loopback --frames 400 --timeout 3
  kill -STOP "$writer"
  ended
  kill -CONT "$writer"
  has '^timeout=3'
}

# From pictures that a camera gives to angles in files. By emulation a frame may take a second.
check_tags_are_tracked() {
  write MJPG 640x480 "$clip"/*.jpg
  "$poselift" track --device $loopback --size 640x480 --camera "$clip/camera.yaml" \
    --tags "$clip/tags.toml" --seconds 15 --record --out run --json report.json >out 2>err
  local frames ok tags
  grep 'frames in' out >told # the latency: of an emulated machine
  frames=$(sed -n 's/^ *"frames": \([0-9]*\),$/\1/p' report.json)
  ok=$(sed -n 's/^ *"ok": \([0-9]*\),$/\1/p' report.json)
  tags=$(sed -n 's/^ *"tags_per_frame": \([0-9]*\).*/\1/p' report.json)
  ((frames >= 2 && 10 * ok > 8 * frames && tags > 5)) # 7 to 9 are seen, of a few frames
  has '^MOTION' run/poses.bvh
  (($(wc -l <run/angles.csv) > 3))
  # Every frame that was tracked is in the raw video, and can be decoded.
  (($(ffprobe -loglevel error -count_frames -select_streams v -show_entries \
    stream=nb_read_frames -of csv=p=0 run/video.mkv | tr -d ,) == frames))
}

check_the_window_watches_a_camera() {
  [[ -n $window_tests ]] || { echo "there is no window without Qt" >skipped && return; }
  write MJPG 640x480 "$clip"/*.jpg
  POSELIFT_CAMERA=$loopback POSELIFT_CAMERA_CLIP=$clip QT_QPA_PLATFORM=offscreen \
    "$window_tests" --gtest_filter='LiveCamera.*' >out 2>err
  has 'PASSED  . 1 test'
}

check_a_camera_is_examined() {
  control gain_automatic=1
  "$poselift" doctor $camera --size 640x480 --rate 25 --seconds 1 --json doctor.json >out 2>err
  has "asked for +640x480 .*25 Hz"
  has "given +640x480 .*25 Hz"
  has 'YUYV' doctor.json
  has '"gain": ' doctor.json
}

# What came before is whole.
check_an_unplugged_camera_ends_a_recording() {
  "$poselift" track $camera --size 320x180 --rate 15 --tags "$clip/tags.toml" --record \
    --out gone --json report.json >out 2>err &
  background=$!
  for _ in {1..400}; do
    [[ -e gone/video.mkv && $(stat -c %s gone/video.mkv) -gt 1000000 ]] && break
    kill -0 $background
    sleep 0.1
  done
  echo vivid.0 >/sys/bus/platform/drivers/vivid/unbind
  ended
  echo vivid.0 >/sys/bus/platform/drivers/vivid/bind
  ((code != 0))
  has "$camera: is gone: unplugged" err
  local frames
  frames=$(sed -n 's/^ *"frames": \([0-9]*\),$/\1/p' report.json)
  ((frames > 5))
  (($(grep -c '"people"' gone/poses.json) >= 1))
  (($(ffprobe -loglevel error -count_frames -select_streams v -show_entries \
    stream=nb_read_frames -of csv=p=0 gone/video.mkv | tr -d ,) == frames))
}

# A board that is held still for some frames in each of its views.
check_a_camera_is_calibrated() {
  local held=() picture
  for picture in "$clip"/board/*.jpg; do
    for _ in {1..20}; do held+=("$picture"); done
  done
  write MJPG 640x480 "${held[@]}"
  "$poselift" calibrate $loopback --board aprilgrid --target "$clip/board/target.yaml" --lens none \
    --size 640x480 --seconds 22 --no-picture --out found.yaml --json report.json >out 2>err
  has 'camera: asked for 640x480 .*, got 640x480 MJPG' err
  grep 'focal\|rms over' out >told
  local fx
  fx=$("$poselift" info found.yaml | sed -n 's/^ *focal_length_px *\[\([0-9]*\).*/\1/p')
  ((fx > 686 && fx < 714)) # planted: 700
}

check cameras are listed
check YUYV streams
check NV12 streams
check GREY streams
check what is given is told from what was asked
check lost frames are counted
check times grow
check broken frames are counted and passed over
check an error of the driver ends the stream
check a driver that does not start is told and left usable
check a busy camera is told
check a format that another program set is set anew
check controls are listed and set
check permission denied is told
check what is no camera is told
check a camera is examined
check an unplugged camera is told
check an unplugged camera ends a recording
check a camera that disconnects is told
check MJPG streams from ffmpeg
check damaged MJPG is told frame by frame
check the format of a writer is taken as it is
check a camera that stops sending is told
check tags are tracked
check the window watches a camera
check a camera is calibrated
((failures == 0)) || { echo "$failures checks failed"; exit 1; }
