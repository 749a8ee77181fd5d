// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/ik/inverse_kinematics.h"

#include <ceres/cost_function.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kMinJoints = 3;
// A target wider than this many times the body is in another unit.
constexpr double kMaxReaches = 20.0;
// Far from exact, so that steps may cross a limit; what is left outside is
// held at the limit afterwards.
constexpr double kLimitStiffness_m_per_rad = 0.1;

double Reach_m(const Skeleton& skeleton) {
  std::vector<double> reaches_m;
  for (const Bone& bone : skeleton.bones) {
    const double parent_m = bone.parent < 0 ? 0.0 : reaches_m[bone.parent];
    reaches_m.push_back(parent_m + std::max(bone.offset_m.norm(), bone.tip_m.norm()));
  }
  return *std::max_element(reaches_m.begin(), reaches_m.end());
}

// Zero where the target or the skeleton has no joint.
Eigen::VectorXd PresentWeights(const JointSites& sites, const Pose3& target_m,
                               const Eigen::VectorXd& joint_weights) {
  Eigen::VectorXd weights = joint_weights;
  if (weights.size() == 0) weights.setOnes(kNumJoints);
  for (int j = 0; j < kNumJoints; ++j)
    if (sites[j].bone < 0 || !target_m.col(j).allFinite()) weights[j] = 0.0;
  return weights;
}

Eigen::Vector3d Middle(const Pose3& target_m, const Eigen::VectorXd& weights) {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  for (int j = 0; j < kNumJoints; ++j)
    if (weights[j] > 0.0) sum_m += target_m.col(j);
  return sum_m / static_cast<double>((weights.array() > 0.0).count());
}

// Squared distances of two poses, joint by joint; 0 for joints of no weight.
Eigen::VectorXd SquaredDistances(const Pose3& a_m, const Pose3& b_m,
                                 const Eigen::VectorXd& weights) {
  const Eigen::VectorXd squared = (a_m - b_m).colwise().squaredNorm();
  return (weights.array() > 0.0).select(squared, 0.0);
}

std::unique_ptr<ceres::CostFunction> MakeTargetCost(
    const Articulation& body, const Pose3& target_m, const Eigen::VectorXd& weights,
    const std::vector<ObservedBonePose>& bone_poses) {
  std::vector<TargetPoint> points;
  for (int j = 0; j < kNumJoints; ++j)
    if (weights[j] > 0.0) points.push_back({{{j, 1.0}}, target_m.col(j), std::sqrt(weights[j])});
  return MakeSpaceCost(body, std::move(points), false, bone_poses);
}

IkResult BadInput(std::string message) {
  IkResult result;
  result.status = IkStatus::kBadInput;
  result.message = std::move(message);
  return result;
}

}  // namespace

std::string IkOptions::Validate() const {
  if (!(pull_m_per_rad > 0.0 && pull_m_per_rad <= 1.0))
    return fmt::format("IkOptions::pull_m_per_rad = {}, wanted above 0 and at most 1",
                       pull_m_per_rad);
  if (max_iterations < 1)
    return fmt::format("IkOptions::max_iterations = {}, wanted at least 1", max_iterations);
  if (!(function_tolerance > 0.0 && function_tolerance < 1.0))
    return fmt::format("IkOptions::function_tolerance = {}, wanted between 0 and 1",
                       function_tolerance);
  return "";
}

std::string IkResult::BriefReport() const {
  if (!IsUsable(status))
    return fmt::format("inverse kinematics: {}: {}", IkStatusName(status), message);
  return fmt::format("inverse kinematics: {}, {} iterations, rms {:.2f} mm, max {:.2f} mm",
                     IkStatusName(status), iterations, 1e3 * rms_m, 1e3 * max_m);
}

InverseKinematics::InverseKinematics(Skeleton skeleton, const IkOptions& options)
    : body_(std::move(skeleton)),
      options_(options),
      limits_(body_, options.enforce_limits),
      initial_pose_(body_),
      reach_m_(Reach_m(body_.skeleton)) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  if (body_.num_dofs == 0)
    throw InputError(body_.skeleton.name,
                     "found no degrees of freedom, wanted a skeleton that can move");
}

void InverseKinematics::CheckSizes(const Pose3& target_in_world_m, const IkHints& hints) const {
  if (target_in_world_m.cols() != kNumJoints)
    throw std::invalid_argument("inverse kinematics: a target is 3 x 23");
  const Eigen::VectorXd& weights = hints.joint_weights;
  if (weights.size() != 0 &&
      (weights.size() != kNumJoints || !weights.allFinite() || weights.minCoeff() < 0.0))
    throw std::invalid_argument("inverse kinematics: joint_weights are 23 numbers >= 0");
  if (hints.rest_dofs &&
      (hints.rest_dofs->size() != body_.num_dofs || !hints.rest_dofs->allFinite()))
    throw std::invalid_argument("inverse kinematics: rest_dofs do not fit the skeleton");
  if (hints.start && (hints.start->dofs.size() != body_.num_dofs ||
                      !hints.start->dofs.allFinite() || !hints.start->root_in_world_m.allFinite() ||
                      !(std::abs(hints.start->world_from_root.norm() - 1.0) < 1e-6)))
    throw std::invalid_argument("inverse kinematics: start is no pose of the skeleton");
}

// A start that is given wins if it is nearer than what the target suggests
// from its dofs: after a jump it is not.
SkeletonPose InverseKinematics::Start(const Pose3& target_m, const Eigen::VectorXd& weights,
                                      const DofSprings& springs, const IkHints& hints) const {
  const Eigen::VectorXd& from_dofs = hints.start ? hints.start->dofs : springs.rest;
  SkeletonPose found = initial_pose_.Find(body_, limits_, target_m, weights, from_dofs);
  if (!hints.start) return found;
  const double found_m2 =
      weights.dot(SquaredDistances(JointPositions(body_, found), target_m, weights));
  const double given_m2 =
      weights.dot(SquaredDistances(JointPositions(body_, *hints.start), target_m, weights));
  return given_m2 <= found_m2 ? *hints.start : found;
}

IkResult InverseKinematics::Solve(const Pose3& target_in_world_m, const IkHints& hints) const {
  CheckSizes(target_in_world_m, hints);
  const Eigen::VectorXd weights =
      PresentWeights(body_.sites, target_in_world_m, hints.joint_weights);
  const auto num_present = (weights.array() > 0.0).count();
  if (num_present < kMinJoints)
    return BadInput(fmt::format("found {} joints, wanted at least {}", num_present, kMinJoints));
  // Solved about the target's middle: far from the origin metres lose digits.
  const Eigen::Vector3d middle_m = Middle(target_in_world_m, weights);
  const Pose3 target_m = target_in_world_m.colwise() - middle_m;
  const double radius_m =
      std::sqrt(SquaredDistances(target_m, Pose3::Zero(3, kNumJoints), weights).maxCoeff());
  if (!(radius_m <= kMaxReaches * reach_m_))
    return BadInput(
        fmt::format("a joint is {:.3g} m from the middle, the skeleton reaches {:.3g} "
                    "m; is the target in metres?",
                    radius_m, reach_m_));
  IkHints local = hints;
  if (local.start) local.start->root_in_world_m -= middle_m;
  for (ObservedBonePose& tag : local.bone_poses) tag.cam_from_tag.pretranslate(-middle_m);

  const Eigen::VectorXd rest_dofs = hints.rest_dofs.value_or(Eigen::VectorXd::Zero(body_.num_dofs));
  const DofSprings springs{.limits = limits_,
                           .rest = limits_.Clamp(rest_dofs),
                           .pull = options_.pull_m_per_rad,
                           .stiffness = kLimitStiffness_m_per_rad};
  PoseProblem problem(body_, Start(target_m, weights, springs, local), springs);
  problem.AddPoseTerm(MakeTargetCost(body_, target_m, weights, local.bone_poses));
  const PoseProblemOutcome outcome =
      problem.Solve(options_.max_iterations, options_.function_tolerance);

  IkResult result;
  result.status = outcome.status;
  result.message = outcome.message;
  result.iterations = outcome.iterations;
  if (!IsUsable(outcome.status)) return result;
  result.pose = problem.pose();
  const Eigen::VectorXd squared_m2 =
      SquaredDistances(JointPositions(body_, result.pose), target_m, weights);
  result.rms_m = std::sqrt(squared_m2.sum() / static_cast<double>(num_present));
  result.max_m = std::sqrt(squared_m2.maxCoeff());
  result.pose.root_in_world_m += middle_m;
  return result;
}

}  // namespace poselift
