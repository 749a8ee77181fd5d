// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "src/progress.h"

namespace poselift {

// k-means (Lloyd, seeded by k-means++) on the columns of points (D x m).
// Returns the cluster of each column, [0, min(num_clusters, m)); no cluster is
// empty. m and max_iterations are at least 1. Deterministic by seed whatever the
// number of threads.
Eigen::VectorXi KMeans(const Eigen::MatrixXd& points, int num_clusters, int max_iterations,
                       std::uint64_t seed, const ProgressFn& progress = {});

}  // namespace poselift
