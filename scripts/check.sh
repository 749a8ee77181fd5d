#!/usr/bin/env bash
# The checks that need no compiler: format, spelling, shell scripts. Runs them
# all and fails when one did.
set -euo pipefail
cd "$(dirname "$0")/.."

failed=()
check() { # check NAME COMMAND...
  local name=$1
  shift
  if "$@"; then echo "$name: ok"; else failed+=("$name"); fi
}

check format scripts/format.sh --check
check spelling codespell
check shell shellcheck demo.sh test.sh .ci/run scripts/*.sh tests/v4l2_vm/*.sh tests/ui/window/*.sh

if ((${#failed[@]})); then
  echo "checks failed: ${failed[*]} (scripts/format.sh formats)" >&2
  exit 1
fi
