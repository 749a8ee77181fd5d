#!/usr/bin/env bash
# Installs what is missing, builds, runs every check and every test.
#   ./test.sh          on a fresh Debian 12, as root or with sudo
#   ./test.sh --all    also installs Blender (393 MB), qemu and ffmpeg, as CI does, for the tests
#                      that need them
# Real motion capture for the tests that want it: ../shared, or POSELIFT_DATA=DIR.
set -euo pipefail
cd "$(dirname "$0")"
source scripts/packages.sh

all=${CI:+yes}
case "${1:-}" in
  '') ;;
  --all) all=yes ;;
  *)
    sed -n '2,6s/^# \?//p' "$0" >&2
    exit 2
    ;;
esac

install_packages "${build_packages[@]}" "${check_packages[@]}"
if [[ -n $all ]]; then
  install_packages "${optional_test_packages[@]}" ||
    echo "not installed: ${optional_test_packages[*]}; its tests will be skipped" >&2
fi

failed=()
say "checking format, spelling and scripts"
scripts/check.sh || failed+=(scripts/check.sh)

build_release all

if command -v qemu-system-x86_64 >/dev/null; then
  say "fetching a kernel for the virtual machine with cameras"
  tests/v4l2_vm/fetch_kernel.sh || echo "no kernel: its test will be skipped" >&2
fi

say "running the tests"
ctest --preset release --parallel "$(nproc)" --no-tests=error || failed+=(ctest)

if ((${#failed[@]})); then
  echo "failed: ${failed[*]}; see above" >&2
  exit 1
fi
