// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <benchmark/benchmark.h>

#include <random>

#include "lift/temporal/local_regression.h"
#include "tests/support/planted_pose.h"

namespace poselift {
namespace {

// One step with K = 50 neighbours of m = 2 poses of 46 dofs, at the defaults, with
// the whitening.
void RegressionStep(benchmark::State& state) {
  constexpr int kDofs = 46, kNeighbours = 50;
  std::mt19937_64 rng(1);
  const Eigen::MatrixXd x = testing::RandomMatrix(2 * kDofs, kNeighbours, &rng);
  const Eigen::MatrixXd y =
      x.topRows(kDofs) + 0.1 * testing::RandomMatrix(kDofs, kNeighbours, &rng);
  const Eigen::VectorXd query = 0.3 * testing::RandomMatrix(2 * kDofs, 1, &rng);
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
BENCHMARK(RegressionStep)->Name("regression_step")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace poselift
