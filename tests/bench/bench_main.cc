// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <benchmark/benchmark.h>

int main(int argc, char** argv) {
  // Debian's benchmark library calls itself a debug build; what counts is ours.
  benchmark::AddCustomContext("poselift_version", POSELIFT_VERSION);
  benchmark::AddCustomContext("poselift_build_type", POSELIFT_BUILD_TYPE);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const bool any = benchmark::RunSpecifiedBenchmarks() > 0;
  benchmark::Shutdown();
  return any ? 0 : 1;
}
