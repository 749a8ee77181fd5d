#!/usr/bin/env bash
# scripts/fuzz.sh [SECONDS [READER...]]: each reader, or those named, under libFuzzer for so long
# (60). What it finds stays in build-fuzz/found, what it has learnt in build-fuzz/corpus.
# Needs clang-14 and libomp-14-dev.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
readers=("${@:2}")
cmake --preset fuzz
cmake --build --preset fuzz
((${#readers[@]})) || mapfile -t readers < <(build-fuzz/poselift_fuzz)
mkdir -p build-fuzz/found

failed=()
for reader in "${readers[@]}"; do
  echo "== $reader"
  mkdir -p "build-fuzz/corpus/$reader"
  POSELIFT_READER=$reader build-fuzz/poselift_fuzz -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=2048 -max_len=20000 -artifact_prefix="build-fuzz/found/$reader-" \
    "build-fuzz/corpus/$reader" 2>"build-fuzz/$reader.log" || failed+=("$reader")
  tail -n 1 "build-fuzz/$reader.log"
done

if ((${#failed[@]})); then
  echo "found something: ${failed[*]} (build-fuzz/READER.log, build-fuzz/found)" >&2
  exit 1
fi
