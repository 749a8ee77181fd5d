#!/usr/bin/env bash
# Formats all C++ files with clang-format 14; with --check only says which are not.
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -d '' -t files < <(for folder in src calib lift ui samples tests; do
  if [[ -d $folder ]]; then find "$folder" \( -name '*.h' -o -name '*.cc' \) -print0; fi
done)

if [[ "${1:-}" == --check ]]; then
  clang-format-14 --dry-run --Werror "${files[@]}"
elif (($# == 0)); then
  clang-format-14 -i "${files[@]}"
else
  echo "usage: $0 [--check]" >&2
  exit 2
fi
