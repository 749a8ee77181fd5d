// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/ik/pose_costs.h"
#include "lift/temporal/motion_features.h"

namespace ceres {
class CostFunction;
}

namespace poselift {

// p(q_t | q_{t-1}, ..., q_{t-m}) of Eq. (1) of the motion paper as a Gaussian:
// where the next pose of a motion is expected, and how surely.
struct PosePrediction {
  SkeletonPose pose;          // the mean
  Eigen::MatrixXd whitening;  // r x 46, of differences of features
};

// E_prior of Eq. (2): whitening delta(q), r rows, where delta is PoseDifference(q,
// mean) with the frame time dt: rows 43, 44 and 45 divided by it.
// Parameter blocks: root_in_world_m, world_from_root (x y z w), dofs, as in
// lift/ik/pose_costs.h.
std::unique_ptr<ceres::CostFunction> MakePredictionCost(const PosePrediction& prediction,
                                                        double frame_time_s);

// E_prior and E_likelihood, Eq. (2) and (11), by Levenberg-Marquardt from the mean:
//   argmin_q  sum_k |m_k f(q) - c_k|^2 / sigma_k^2 + tags + |whitening delta(q)|^2
// bone_poses: the tags (observation.h), in the world of the poses. The mean where
// the solver breaks down.
SkeletonPose MostProbablePose(const Articulation& body, const PosePrediction& prediction,
                              const std::vector<TargetPoint>& observed, double frame_time_s,
                              const std::vector<ObservedBonePose>& bone_poses = {});

}  // namespace poselift
