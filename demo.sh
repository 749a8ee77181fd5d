#!/usr/bin/env bash
# Installs what is missing, builds, lifts the sample photos, and says how far the
# result is from the truth and where it lies. Fresh Debian 12, as root or with sudo.
set -euo pipefail
cd "$(dirname "$0")"
source scripts/packages.sh

install_packages "${build_packages[@]}"
build_release poselift poselift-label poselift_bench

lift_sample() { # lift_sample NAME: into out/demo/NAME
  local sample=samples/photo/$1
  build/poselift lift "$sample.jpg" --labels "$sample.labels.json" --out "out/demo/$1" \
    --camera "$sample.camera.yaml" --truth "$sample.truth.json"
}

say "lifting the sample photos"
shopt -s nullglob
photos=(samples/photo/*.jpg)
if ((${#photos[@]} == 0)); then
  echo "no photo in samples/photo: the checkout is not complete" >&2
  exit 1
fi
for photo in "${photos[@]}"; do lift_sample "$(basename "$photo" .jpg)"; done

say "done: look at"
find out/demo -type f | sort
