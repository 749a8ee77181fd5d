// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <benchmark/benchmark.h>

#include <random>

#include "lift/temporal/local_regression.h"
#include "tests/support/planted_pose.h"

namespace poselift {
namespace {

// One step with K neighbours of m poses of 46 dofs, at the defaults, with the
// whitening.
void RegressionStep(benchmark::State& state, int num_neighbours, int num_frames) {
  constexpr int kDofs = 46;
  std::mt19937_64 rng(1);
  const Eigen::MatrixXd x = testing::RandomMatrix(num_frames * kDofs, num_neighbours, &rng);
  const Eigen::MatrixXd y =
      x.topRows(kDofs) + 0.1 * testing::RandomMatrix(kDofs, num_neighbours, &rng);
  const Eigen::VectorXd query = 0.3 * testing::RandomMatrix(num_frames * kDofs, 1, &rng);
  LocalRegressionOptions options;
  options.whitening = true;
  LocalRegression regression;
  LocalPrediction prediction;
  for (auto _ : state) {
    regression.Solve(x, y, query, options, &prediction);
    benchmark::DoNotOptimize(prediction.mean.data());
  }
  state.SetItemsProcessed(state.iterations());
}
void SmallStep(benchmark::State& state) { RegressionStep(state, 50, 2); }
BENCHMARK(SmallStep)->Name("regression_step")->Unit(benchmark::kMicrosecond);
void LargeStep(benchmark::State& state) { RegressionStep(state, 100, 3); }
BENCHMARK(LargeStep)->Name("regression_step/K:100/m:3")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace poselift
