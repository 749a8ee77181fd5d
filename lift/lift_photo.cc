// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lift_photo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lift/body_proportions.h"
#include "lift/normalize.h"
#include "lift/perspective.h"

namespace poselift {
namespace {

// Different codes may end in one pose: of those the best stays.
void KeepDistinct(double distinct_m, std::vector<LiftedPose>* sorted) {
  std::vector<LiftedPose> distinct;
  for (LiftedPose& pose : *sorted) {
    const bool is_new = std::all_of(distinct.begin(), distinct.end(), [&](const LiftedPose& d) {
      return (d.joints_in_cam_m - pose.joints_in_cam_m).norm() >=
             distinct_m * std::sqrt(kNumJoints);
    });
    if (is_new) distinct.push_back(std::move(pose));
  }
  *sorted = std::move(distinct);
}

// Of pins that are points, as UnmetHints has them of relations.
void AddUnmetPins(const Observation& observation, LiftedPose* lifted) {
  constexpr double kMetWithin_sigmas = 2.0;
  for (size_t i = 0; i < observation.points.size(); ++i) {
    const ObservedPoint& point = observation.points[i];
    if (point.hint >= 0 &&
        !(lifted->point_errors[static_cast<Eigen::Index>(i)] <= kMetWithin_sigmas * point.sigma))
      lifted->unmet_hints.push_back(point.hint);
  }
  std::ranges::sort(lifted->unmet_hints);
}

}  // namespace

Eigen::Vector3d MeanShift_m(const Observation& observation, const Pose3& joints_in_cam_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const ObservedPoint& point : observation.points) {
    if (point.kind != ObservedPoint::Kind::k3D) continue;
    const double weight = 1.0 / (point.sigma * point.sigma);
    sum += weight * (point.x - SumOfJoints(point.parts, joints_in_cam_m));
    weights += weight;
  }
  return weights > 0.0 ? Eigen::Vector3d(sum / weights) : sum;
}

void MeasureErrors(const Observation& observation, LiftedPose* lifted) {
  const Eigen::Vector3d shift_m = MeanShift_m(observation, lifted->joints_in_cam_m);
  lifted->point_errors.resize(static_cast<Eigen::Index>(observation.points.size()));
  double squared_px = 0.0;
  for (size_t i = 0; i < observation.points.size(); ++i) {
    const ObservedPoint& point = observation.points[i];
    const Eigen::Vector3d x_in_cam_m = SumOfJoints(point.parts, lifted->joints_in_cam_m);
    double error = (x_in_cam_m + shift_m - point.x).norm();
    if (point.kind == ObservedPoint::Kind::k2D) {
      const Eigen::Vector2d x_px =
          observation.pinhole
              ? ProjectInPerspective(*observation.pinhole, lifted->camera, x_in_cam_m)
              : lifted->camera.Project(x_in_cam_m);
      error = (x_px - point.x.head<2>()).norm();
      squared_px += error * error;
    }
    lifted->point_errors[static_cast<Eigen::Index>(i)] = error;
  }
  if (const int count = observation.Count(ObservedPoint::Kind::k2D); count > 0)
    lifted->reprojection_rms_px = std::sqrt(squared_px / count);
}

std::string LiftPhotoOptions::Validate() const {
  for (const std::string& error : {lifter.Validate(), refinement.Validate()})
    if (!error.empty()) return error;
  if (perspective_rounds < 0)
    return fmt::format("LiftPhotoOptions::perspective_rounds = {}, wanted at least 0",
                       perspective_rounds);
  if (max_solutions < 1)
    return fmt::format("LiftPhotoOptions::max_solutions = {}, wanted at least 1", max_solutions);
  return "";
}

std::string LiftResult::BriefReport() const {
  if (!IsUsable()) return message;
  const size_t num_alternatives = poses.size() - 1;
  const size_t num_unmet = poses.front().unmet_hints.size();
  const double rms_px = poses.front().reprojection_rms_px;
  return (rms_px < 0.0 ? "" : fmt::format("reprojection {:.1f} px RMS, ", rms_px)) +
         fmt::format("{} atoms, {} alternative{}", poses.front().code.atoms.size(),
                     num_alternatives, num_alternatives == 1 ? "" : "s") +
         (num_unmet == 0
              ? ""
              : fmt::format(", {} hint{} not met", num_unmet, num_unmet == 1 ? "" : "s"));
}

PhotoLifter::PhotoLifter(const Dictionary& dictionary, const LiftPhotoOptions& options)
    : dictionary_(dictionary),
      options_(options),
      lifter_(dictionary, options.lifter),
      refinement_(dictionary.skeleton, options.refinement, dictionary.prior),
      bone_lengths_m_(BoneLengths(dictionary.skeleton)) {}

double SizeOf(const Observation& observation, const Skeleton& skeleton) {
  return observation.stature_m ? *observation.stature_m / Stature_m(skeleton) : 1.0;
}

LiftResult PhotoLifter::LiftPhoto(const Observation& observation) const {
  if (!observation.stature_m) return LiftAtSkeletonSize(observation);
  const double size = SizeOf(observation, dictionary_.skeleton);
  LiftResult result = LiftAtSkeletonSize(AtSkeletonSize(observation, size));
  for (LiftedPose& lifted : result.poses) lifted.size = size;
  return result;
}

LiftResult PhotoLifter::LiftAtSkeletonSize(const Observation& observation) const {
  LiftResult result;
  if (const std::string reason = CanLift(observation); !reason.empty()) {
    result.status = LiftStatus::kCannotLift;
    result.message = reason;
    return result;
  }
  const bool in_perspective =
      observation.pinhole && observation.Count(ObservedPoint::Kind::k2D) > 0;
  const std::vector<LiftSolution> solutions = lifter_.Solve(observation);  // (P1)
  const auto finish = [&](const LiftSolution& solution) {
    std::optional<LiftedPose> lifted =
        in_perspective ? FinishInPerspective(solution, observation) : Finish(solution, observation);
    if (lifted) Judge(observation, &*lifted);
    return lifted;
  };
  const auto wanted = static_cast<size_t>(options_.max_solutions);
  for (size_t first = 0; first < solutions.size() && result.poses.size() < wanted;) {
    std::vector<std::optional<LiftedPose>> finished(
        std::min(wanted - result.poses.size(), solutions.size() - first));
#pragma omp parallel for schedule(dynamic) if (finished.size() > 1)
    for (size_t i = 0; i < finished.size(); ++i) finished[i] = finish(solutions[first + i]);
    first += finished.size();
    for (auto& lifted : finished)
      if (lifted) result.poses.push_back(std::move(*lifted));
  }
  std::stable_sort(result.poses.begin(), result.poses.end(),
                   [](const LiftedPose& a, const LiftedPose& b) { return a.cost < b.cost; });
  KeepDistinct(options_.lifter.distinct_m, &result.poses);
  result.status = result.poses.empty() ? LiftStatus::kFailed : LiftStatus::kOk;
  result.message = result.poses.empty() ? "no pose of the skeleton fits the points" : "";
  return result;
}

LiftResult PhotoLifter::LiftPhotoFrom(const Observation& observation,
                                      const LiftedPose& start) const {
  const double size = SizeOf(observation, dictionary_.skeleton);
  std::optional<LiftedPose> lifted =
      Follow(start, observation.stature_m ? AtSkeletonSize(observation, size) : observation);
  if (!lifted) return LiftPhoto(observation);
  lifted->size = size;
  return {LiftStatus::kOk, "", {std::move(*lifted)}};
}

// In perspective too one round: drags go on from where the last answer ended.
std::optional<LiftedPose> PhotoLifter::Follow(const LiftedPose& start,
                                              const Observation& observation) const {
  const bool has_2d = observation.Count(ObservedPoint::Kind::k2D) > 0;
  const bool in_perspective = has_2d && observation.pinhole;
  if (start.code.Empty() || has_2d != (start.camera.scale_px_per_m > 0.0)) return std::nullopt;
  const Observation weak = in_perspective
                               ? AsWeakPerspective(observation, start.joints_in_cam_m, start.camera)
                               : observation;
  if (!CanLift(weak).empty()) return std::nullopt;
  LiftSolution solution;
  solution.code = start.code;
  solution.tau_rad = start.code_tau_rad;
  solution.scale_px_per_m = start.code_scale_px_per_m;
  auto lifted = Finish(lifter_.Follow(weak, std::move(solution)), weak, start.pose);
  if (!lifted) return lifted;
  if (in_perspective) lifted->pelvis_in_cam_m = PelvisInCam_m(*observation.pinhole, lifted->camera);
  Judge(observation, &*lifted);
  return lifted;
}

void PhotoLifter::Judge(const Observation& observation, LiftedPose* lifted) const {
  MeasureErrors(observation, lifted);
  lifted->cost = Cost(*lifted, observation);
  lifted->unmet_hints = UnmetHints(observation.relations, lifted->joints_in_cam_m);
  AddUnmetPins(observation, lifted);
}

std::optional<LiftedPose> PhotoLifter::Finish(const LiftSolution& solution,
                                              const Observation& observation,
                                              const std::optional<SkeletonPose>& start) const {
  const Pose3 pose_in_cam = CamFromBody(solution.tau_rad) * Unstacked(solution.pose_in_body_m);
  const Pose3 normalized_m = NormalizePose(pose_in_cam, bone_lengths_m_);
  const RefinementResult refined = refinement_.Solve(normalized_m, observation, start);
  if (!IsUsable(refined.status)) return std::nullopt;
  LiftedPose lifted;
  lifted.pose = refined.pose;
  lifted.joints_in_cam_m = refined.joints_in_cam_m;
  lifted.camera = refined.camera;
  if (!refined.has_camera) lifted.camera.scale_px_per_m = 0.0;
  lifted.code = solution.code;
  lifted.code_tau_rad = solution.tau_rad;
  lifted.code_scale_px_per_m = solution.scale_px_per_m;
  return lifted;
}

std::optional<LiftedPose> PhotoLifter::FinishInPerspective(const LiftSolution& solution,
                                                           const Observation& observation) const {
  std::optional<LiftedPose> lifted = Finish(solution, observation);
  LiftSolution last = solution;
  ViewStart start{solution.tau_rad, solution.scale_px_per_m * dictionary_.typical_norm_m};
  for (int i = 0; i < options_.perspective_rounds && lifted; ++i) {
    const Observation weak =
        AsWeakPerspective(observation, lifted->joints_in_cam_m, lifted->camera);
    std::vector<LiftSolution> closer;
    if (observation.relations.empty())
      closer = lifter_.SolveFrom(weak, {start});
    else if (CanLift(weak).empty())  // a limb that a hint has flipped stays so
      closer = {lifter_.GoOnFrom(weak, last)};
    if (closer.empty()) break;
    last = closer.front();
    start.tau_rad = last.tau_rad;
    lifted = Finish(last, weak);
  }
  if (lifted) lifted->pelvis_in_cam_m = PelvisInCam_m(*observation.pinhole, lifted->camera);
  return lifted;
}

double PhotoLifter::Cost(const LiftedPose& lifted, const Observation& observation) const {
  double cost =
      RotationPriorCost(TauFromRotation(lifted.camera.cam_from_body), options_.lifter.rotation);
  for (size_t i = 0; i < observation.points.size(); ++i) {
    const double sigmas =
        lifted.point_errors[static_cast<Eigen::Index>(i)] / observation.points[i].sigma;
    cost += sigmas * sigmas;
  }
  for (const JointRelation& relation : observation.relations) {
    const double sigmas = relation.Residual(lifted.joints_in_cam_m);
    cost += sigmas * sigmas;
  }
  if (dictionary_.prior.Empty()) return cost;
  const Pose3 in_body_m = lifted.camera.cam_from_body.transpose() * lifted.joints_in_cam_m;
  const Eigen::VectorXd whitened =
      dictionary_.prior.whitening * (Stacked(in_body_m) - dictionary_.prior.mean_m);
  const double weight = options_.lifter.prior_weight;
  return cost + weight * weight * whitened.squaredNorm();
}

}  // namespace poselift
