// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lift/rotation.h"
#include "lift/view_search.h"
#include "src/observation.h"
#include "src/pose3.h"

namespace poselift {

// The plain lookup that any model must beat: of all stored poses, seen from all
// views of a grid, the one that looks most like the labels, with its rotation
// then estimated (P1b).
struct NearestExemplarOptions {
  RotationOptions rotation{.prior_weight = {2.5, 0.0, 2.5}};
  ViewSearchOptions views{.num_starts = 1};
};

class NearestExemplar {
 public:
  // exemplars_m: 69 x N, body frame.
  explicit NearestExemplar(Eigen::MatrixXd exemplars_m, NearestExemplarOptions options = {});

  // The joints in cam, metres; nothing when the observation cannot be lifted.
  std::optional<Pose3> Lift(const Observation& observation) const;

 private:
  Eigen::MatrixXd exemplars_m_;
  NearestExemplarOptions options_;
};

}  // namespace poselift
