#!/usr/bin/env bash
# Installs what is missing, builds, runs every check and every test.
#   ./test.sh          on a fresh Debian 12, as root or with sudo
#   ./test.sh --all    also installs Blender (393 MB), as CI does, for the tests that need it
# Real motion capture for the tests that want it: ../shared, or POSELIFT_DATA=DIR.
set -euo pipefail
cd "$(dirname "$0")"
source scripts/packages.sh

all=${CI:+yes}
case "${1:-}" in
  '') ;;
  --all) all=yes ;;
  *)
    sed -n '2,5s/^# \?//p' "$0" >&2
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

say "running the tests"
ctest --preset release --parallel "$(nproc)" --no-tests=error || failed+=(ctest)

if ((${#failed[@]})); then
  echo "failed: ${failed[*]}; see above" >&2
  exit 1
fi
