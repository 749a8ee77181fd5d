// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/ik/pose_refinement.h"

#include <ceres/cost_function.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "src/input_error.h"

namespace poselift {
namespace {

// As in inverse kinematics (0.1 m), for joints known to 5 cm.
constexpr double kLimitStiffness_per_rad = 2.0;

// A scale that falls by this factor (1e-4) falls to zero.
constexpr double kLeastLogScale = -9.2;

// The start needs no more accuracy than the code has.
IkOptions StartOptions(const RefinementOptions& options) {
  return {.enforce_limits = options.enforce_limits, .function_tolerance = 1e-2};
}

// The observed points of a kind that the skeleton can show.
std::vector<TargetPoint> PointsOfKind(const Observation& observation, ObservedPoint::Kind kind,
                                      const JointSites& sites) {
  std::vector<TargetPoint> points;
  for (const ObservedPoint& point : observation.points) {
    if (!(point.sigma > 0.0 && std::isfinite(point.sigma)))
      throw std::invalid_argument("pose refinement: the sigma of a point is above 0 and finite");
    const bool known = std::all_of(point.parts.begin(), point.parts.end(),
                                   [&](const auto& part) { return sites[part.joint].bone >= 0; });
    if (point.kind == kind && known && !point.parts.empty() && point.x.allFinite())
      points.push_back({point.parts, point.x, 1.0 / point.sigma});
  }
  return points;
}

std::vector<JointRelation> RelationsThatShow(const Observation& observation,
                                             const JointSites& sites) {
  std::vector<JointRelation> relations = observation.relations;
  std::erase_if(relations, [&](const JointRelation& relation) {
    return std::any_of(relation.parts.begin(), relation.parts.end(),
                       [&](const auto& part) { return sites[part.joint].bone < 0; });
  });
  return relations;
}

Eigen::Vector2d PosedPoint(const TargetPoint& point, const Pose3& joints_m) {
  return SumOfJoints(point.parts, joints_m).head<2>();
}

// The weighted least-squares scale and translation of posed points. Where that
// scale would be negative (a start seen from behind), the ratio of the spreads.
WeakCamera FitCamera(const std::vector<TargetPoint>& points, const Pose3& joints_m) {
  Eigen::Vector2d mean_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();
  double total_weight = 0.0;
  for (const TargetPoint& point : points) {
    const double weight = point.root_weight * point.root_weight;
    mean_m += weight * PosedPoint(point, joints_m);
    mean_px += weight * point.x.head<2>();
    total_weight += weight;
  }
  mean_m /= total_weight;
  mean_px /= total_weight;
  double product = 0.0;
  double spread_m2 = 0.0;
  double spread_px2 = 0.0;
  for (const TargetPoint& point : points) {
    const double weight = point.root_weight * point.root_weight;
    const Eigen::Vector2d x_m = PosedPoint(point, joints_m) - mean_m;
    const Eigen::Vector2d x_px = point.x.head<2>() - mean_px;
    product += weight * x_m.dot(x_px);
    spread_m2 += weight * x_m.squaredNorm();
    spread_px2 += weight * x_px.squaredNorm();
  }
  WeakCamera camera;
  const double ratio = std::sqrt(spread_px2 / spread_m2);
  camera.scale_px_per_m = std::max(product / spread_m2, 0.1 * ratio);
  camera.translation_px = mean_px - camera.scale_px_per_m * mean_m;
  return camera;
}

double ReprojectionRms_px(const std::vector<TargetPoint>& points, const Pose3& joints_m,
                          const WeakCamera& camera) {
  double sum_px2 = 0.0;
  for (const TargetPoint& point : points)
    sum_px2 += (camera.scale_px_per_m * PosedPoint(point, joints_m) + camera.translation_px -
                point.x.head<2>())
                   .squaredNorm();
  return std::sqrt(sum_px2 / static_cast<double>(points.size()));
}

std::vector<TargetPoint> CodePoints(const Pose3& code_m, const JointSites& sites,
                                    double gamma_per_m2) {
  std::vector<TargetPoint> points;
  for (int j = 0; j < kNumJoints; ++j)
    if (sites[j].bone >= 0 && code_m.col(j).allFinite())
      points.push_back({{{j, 1.0}}, code_m.col(j), std::sqrt(gamma_per_m2)});
  return points;
}

double Rms_m(const Pose3& a_m, const Pose3& b_m) {
  double sum_m2 = 0.0;
  int count = 0;
  for (int j = 0; j < kNumJoints; ++j) {
    const double squared_m2 = (a_m.col(j) - b_m.col(j)).squaredNorm();
    if (!std::isfinite(squared_m2)) continue;
    sum_m2 += squared_m2;
    ++count;
  }
  return std::sqrt(sum_m2 / count);
}

RefinementResult Report(const PoseProblemOutcome& outcome, const Articulation& body,
                        const SkeletonPose& pose, const Eigen::Vector3d& camera,
                        const Pose3& code_in_cam_m, const std::vector<TargetPoint>& seen_px) {
  RefinementResult result;
  result.status = outcome.status;
  result.message = outcome.message;
  result.iterations = outcome.iterations;
  result.pose = pose;
  result.joints_in_cam_m = JointPositions(body, pose);
  result.code_rms_m = Rms_m(result.joints_in_cam_m, code_in_cam_m);
  result.camera.cam_from_body = pose.world_from_root.toRotationMatrix();
  result.has_camera = !seen_px.empty();
  if (!result.has_camera) return result;
  result.camera.scale_px_per_m = std::exp(camera[0]);
  result.camera.translation_px = camera.tail<2>();
  result.reprojection_rms_px = ReprojectionRms_px(seen_px, result.joints_in_cam_m, result.camera);
  return result;
}

RefinementResult Unusable(IkStatus status, std::string message) {
  RefinementResult result;
  result.status = status;
  result.message = std::move(message);
  return result;
}

}  // namespace

std::string RefinementOptions::Validate() const {
  if (!(gamma_per_m2 >= 0.0 && std::isfinite(gamma_per_m2)))
    return fmt::format("RefinementOptions::gamma_per_m2 = {}, wanted >= 0", gamma_per_m2);
  if (!(prior_weight >= 0.0 && std::isfinite(prior_weight)))
    return fmt::format("RefinementOptions::prior_weight = {}, wanted >= 0", prior_weight);
  if (!(pull_per_rad > 0.0 && std::isfinite(pull_per_rad)))
    return fmt::format("RefinementOptions::pull_per_rad = {}, wanted > 0", pull_per_rad);
  if (max_iterations < 1)
    return fmt::format("RefinementOptions::max_iterations = {}, wanted at least 1", max_iterations);
  if (!(function_tolerance > 0.0 && function_tolerance < 1.0))
    return fmt::format("RefinementOptions::function_tolerance = {}, wanted between 0 and 1",
                       function_tolerance);
  return "";
}

std::string RefinementResult::BriefReport() const {
  if (!IsUsable(status))
    return fmt::format("pose refinement: {}: {}", IkStatusName(status), message);
  std::string report =
      fmt::format("pose refinement: {}, {} iterations, {:.1f} mm from the code's pose",
                  IkStatusName(status), iterations, 1e3 * code_rms_m);
  if (has_camera)
    report += fmt::format(", {:.2f} px from the labels, {:.1f} px per metre", reprojection_rms_px,
                          camera.scale_px_per_m);
  return report;
}

PoseRefinement::PoseRefinement(Skeleton skeleton, const RefinementOptions& options, PosePrior prior)
    : start_ik_(std::move(skeleton), StartOptions(options)),
      prior_(std::move(prior)),
      options_(options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  if (prior_.Empty()) return;
  for (const JointSite& site : start_ik_.body().sites)
    if (site.bone < 0)
      throw std::invalid_argument("pose refinement: a pose prior wants a skeleton with all joints");
  prior_.whitening *= options.prior_weight;
}

RefinementResult PoseRefinement::Solve(const Pose3& code_in_cam_m, const Observation& observation,
                                       const std::optional<SkeletonPose>& start) const {
  const Articulation& body = start_ik_.body();
  const auto seen_px = PointsOfKind(observation, ObservedPoint::Kind::k2D, body.sites);
  const auto seen_m = PointsOfKind(observation, ObservedPoint::Kind::k3D, body.sites);
  const IkResult first = start_ik_.Solve(code_in_cam_m, {.start = start});
  if (!IsUsable(first.status)) return Unusable(first.status, "the code's pose: " + first.message);
  SkeletonPose start_in_cam = first.pose;
  start_in_cam.root_in_world_m.setZero();

  const DofLimits limits(body, options_.enforce_limits);
  PoseProblem problem(body, start_in_cam,
                      {.limits = limits,
                       .rest = limits.Clamp(Eigen::VectorXd::Zero(body.num_dofs)),
                       .pull = options_.pull_per_rad,
                       .stiffness = kLimitStiffness_per_rad});
  // The picture fixes the translation, the prior is root-centred.
  problem.HoldRootPosition();
  if (options_.gamma_per_m2 > 0.0)
    problem.AddPoseTerm(
        MakeSpaceCost(body, CodePoints(code_in_cam_m, body.sites, options_.gamma_per_m2), false));
  if (!prior_.Empty()) problem.AddDofsTerm(MakePriorCost(body, prior_));
  if (!seen_m.empty() || !observation.bone_poses.empty())
    problem.AddPoseTerm(MakeSpaceCost(body, seen_m, true, observation.bone_poses));
  if (auto relations = RelationsThatShow(observation, body.sites); !relations.empty())
    problem.AddPoseTerm(MakeRelationCost(body, std::move(relations)));
  double log_start_scale = 0.0;
  if (!seen_px.empty()) {
    const WeakCamera camera = FitCamera(seen_px, JointPositions(body, problem.pose()));
    if (!(camera.scale_px_per_m > 0.0 && std::isfinite(camera.scale_px_per_m)))
      return Unusable(IkStatus::kBadInput,
                      "the 2D points, or the code's, show no scale: they lie at one place, or "
                      "absurdly far apart");
    log_start_scale = std::log(camera.scale_px_per_m);
    problem.camera() << log_start_scale, camera.translation_px;
    problem.AddCameraTerm(MakeReprojectionCost(body, seen_px));
  }
  const PoseProblemOutcome outcome =
      problem.Solve(options_.max_iterations, options_.function_tolerance);
  if (!IsUsable(outcome.status)) return Unusable(outcome.status, outcome.message);
  if (!seen_px.empty() && !(problem.camera()[0] - log_start_scale > kLeastLogScale))
    return Unusable(IkStatus::kFailed,
                    "the 2D points contradict the code's pose: the scale vanishes");
  return Report(outcome, body, problem.pose(), problem.camera(), code_in_cam_m, seen_px);
}

}  // namespace poselift
