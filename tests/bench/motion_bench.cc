// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "src/io/amc.h"
#include "src/io/atomic_file.h"

namespace poselift {
namespace {

// Thirty bones with the dofs and the digits of a CMU file.
AsfSkeleton ThirtyBones() {
  AsfSkeleton asf;
  asf.skeleton.name = "bench";
  asf.skeleton.bones = {{.name = "root"}};
  for (int b = 1; b <= 30; ++b) {
    Bone bone{.name = "bone" + std::to_string(b), .parent = b - 1, .tip_m = {0.0, 0.1, 0.0}};
    for (const Dof::Kind kind : {Dof::Kind::kRx, Dof::Kind::kRy, Dof::Kind::kRz})
      if (static_cast<int>(bone.dofs.size()) < 1 + b % 3) bone.dofs.push_back({kind});
    asf.skeleton.bones.push_back(bone);
  }
  return asf;
}

std::string SyntheticAmc(const AsfSkeleton& asf, int num_frames) {
  std::string text = ":FULLY-SPECIFIED\n:DEGREES\n";
  char number[32];
  for (int f = 1; f <= num_frames; ++f) {
    text += std::to_string(f) + "\nroot 6.18215 17.4574 -0.62771 -4.27494 -6.84269 -0.719991\n";
    for (size_t b = 1; b < asf.skeleton.bones.size(); ++b) {
      text += asf.skeleton.bones[b].name;
      for (size_t i = 0; i < asf.skeleton.bones[b].dofs.size(); ++i) {
        const double phase = 0.01 * f + static_cast<double>(b + i);
        std::snprintf(number, sizeof number, " %.6g", 60.0 * std::sin(phase));
        text += number;
      }
      text += '\n';
    }
  }
  return text;
}

void BenchReadAmc(benchmark::State& state) {
  const AsfSkeleton asf = ThirtyBones();
  const std::string text = SyntheticAmc(asf, 10000);
  const auto path = std::filesystem::temp_directory_path() /
                    ("poselift_bench_" + std::to_string(::getpid()) + ".amc");
  WriteFileAtomically(path, text);
  for (auto _ : state) benchmark::DoNotOptimize(ReadAmc(path, asf));
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text.size()));
  std::filesystem::remove(path);
}
BENCHMARK(BenchReadAmc)->Name("read_amc")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift
