// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "src/labels.h"
#include "src/layout.h"
#include "src/pose3.h"

namespace poselift {

// A hint as the solvers take it: one row over the joints x_k in cam,
//   v = axis^T sum_k weight_k x_k,
// that is bound_m, or at least bound_m. The weights sum to 0: no place of the body is
// in it. Its residual is (v - bound_m) / sigma_m; of a lower bound 0 where it holds.
struct JointRelation {
  int hint = 0;  // of PersonLabels::hints
  std::vector<Landmark::Part> parts;
  Eigen::Vector3d axis_in_cam = Eigen::Vector3d::UnitZ();
  double bound_m = 0.0;
  double sigma_m = 0.02;
  bool is_lower_bound = false;

  double Residual(const Pose3& joints_in_cam_m) const;
};

struct RelationOptions {
  double sigma_m = 0.02;
  // What a hint of depth says that does not say by how much.
  double least_depth_m = 0.04;
  // The floor is level in a level camera, and cameras are not quite level.
  double floor_sigma_m = 0.05;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// With z the depth and y the height down, x_0 the pelvis and h_j how high a joint is over
// what it touches:
//   nearer    z_other - z_joint                        >= metres_m
//   towards   z_start - z_end                          >= metres_m, away the other way round
//   floor     (y_i + h_i) - (y_j + h_j)                 = 0 of two joints on it,
//             (y_i + h_i) - (y_k + h_k)                >= 0 of every other joint k
//   pin       x_joint - x_0                             = x_in_cam_m, three rows, known to
//                                                         metres_m where it is said
// The stature gives none. Throws InputError for a joint that neither the layout nor the
// body has, a bone that ends at none of the 23 joints or at the pelvis, and numbers
// that are not finite or negative.
std::vector<JointRelation> RelationsOf(const std::vector<LabelHint>& hints, const Layout& layout,
                                       const RelationOptions& options = {});

// What a hint names: a landmark of the layout or, where that has none of the name, one of the 23
// joints; empty when it is neither.
std::vector<Landmark::Part> PartsNamed(const std::string& name, const Layout& layout);

// Empty, or what RelationsOf would throw.
std::string WhatIsWrongWith(const LabelHint& hint, const Layout& layout);

// The hints that a pose does not meet: a row of theirs is off by more than two standard
// deviations. In their order.
std::vector<int> UnmetHints(const std::vector<JointRelation>& relations,
                            const Pose3& joints_in_cam_m);

// A hint in words: a format of fmt and the names, or the number, that it takes.
struct HintWords {
  const char* english = "";
  std::string first = {}, second = {};
};
HintWords WordsOf(const LabelHint& hint);
// "left_wrist nearer than right_wrist", for messages.
std::string Describe(const LabelHint& hint);

}  // namespace poselift
