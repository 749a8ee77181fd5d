#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the poselift authors
#
# Makes the clip of what make_clip.py rendered: encode.sh RENDERED CLIP.mp4
# The columns with the person go before the empty room; then comes a sensor's noise.
set -euo pipefail
(($# == 2)) || { echo "usage: $0 RENDERED CLIP.mp4" >&2; exit 2; }
ffmpeg -v error -y -framerate 30 -loop 1 -i "$1/room.png" -framerate 30 -i "$1/frames/%04d.png" \
  -filter_complex '[0][1]overlay=380:0:shortest=1,noise=c0_strength=3:c0_flags=t:c0_seed=1,format=yuv420p' \
  -c:v libx264 -preset veryslow -crf 23 -threads 1 -fflags +bitexact -flags:v +bitexact \
  -map_metadata -1 -movflags +faststart "$2"
