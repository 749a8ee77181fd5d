// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/projection_operator.h"
#include "lift/rotation.h"

namespace poselift {

// Where to start the alternation: it ends in the nearest local minimum, and
// from a frontal start that is wrong for most views. So every atom is looked at
// from every view of a grid over yaw and pitch, and the views from which some
// atom looks most like the labels are the starts.
//
// For an atom with centred points B (3 x P), a view with rows r1, r2 of its
// rotation (roll 0) and the target b (2 x P), the best in-plane rotation, scale
// z = s e^(i roll) leaves the residual |b|^2 - |<a, b>|^2 / |a|^2, where the
// complex product and norm need only the 3 x 2 matrix B b^T and the 3 x 3 matrix
// B B^T: a view costs O(1) however many points there are.
struct ViewSearchOptions {
  int num_yaws = 24;
  std::vector<double> pitches_rad = {-0.6, -0.3, 0.0, 0.3, 0.6};
  int num_starts = 8;
  double min_separation_rad = 0.6;  // starts closer than this in rotation are one

  std::string Validate() const;
};

struct ViewStart {
  Eigen::Vector3d tau_rad;
  // px per unit of the atom's norm; 1 where the 2D points leave it open.
  double scale_px_per_unit = 1.0;
  int atom = 0;
  double cost = 0.0;
};

// Starts in order of their cost (residual of the best atom + prior of tau).
// centred_atoms: op.CentredPointsOfAll(). Of a mixture the kind with more points
// is looked at, the 2D points when there are as many.
std::vector<ViewStart> SearchViews(const ProjectionOperator& op,
                                   const Eigen::MatrixXd& centred_atoms,
                                   const RotationOptions& prior, const ViewSearchOptions& options);

}  // namespace poselift
