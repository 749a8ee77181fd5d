// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/motion_reconstruction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

// Where a body has the observed points, stacked.
Eigen::VectorXd PointsOf(const Pose3& joints_m, const std::vector<TargetPoint>& observed) {
  Eigen::VectorXd points_m(3 * static_cast<Eigen::Index>(observed.size()));
  for (size_t i = 0; i < observed.size(); ++i)
    points_m.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        SumOfJoints(observed[i].parts, joints_m);
  return points_m;
}

// [q_{t-1}; ...; q_{t-m}] of columns in the order of time.
template <typename Features>
Eigen::VectorXd LatestFirst(const Features& features) {
  return features.template cast<double>().rowwise().reverse().reshaped();
}

}  // namespace

std::string MotionReconstructionOptions::Validate() const {
  if (num_neighbours < 1)
    return fmt::format("MotionReconstructionOptions::num_neighbours = {}, wanted at least 1",
                       num_neighbours);
  if (!(observed_scale_per_m >= 0.0 && std::isfinite(observed_scale_per_m)))
    return fmt::format("MotionReconstructionOptions::observed_scale_per_m = {}, wanted >= 0",
                       observed_scale_per_m);
  if (observed_scale_per_m > 0.0 && regression.velocity_scale > 0.0)
    return "MotionReconstructionOptions: a velocity_scale wants inputs that are poses alone: "
           "observed_scale_per_m = 0";
  if (!(prior_sigma_factor > 0.0 && std::isfinite(prior_sigma_factor)))
    return fmt::format("MotionReconstructionOptions::prior_sigma_factor = {}, wanted > 0",
                       prior_sigma_factor);
  return regression.Validate();
}

MotionReconstruction::MotionReconstruction(const MotionDatabase& database,
                                           const SegmentSearch& search,
                                           const MotionReconstructionOptions& options)
    : database_(database), search_(search), options_(options), body_(database.skeleton) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
  options_.regression.whitening = true;
}

void MotionReconstruction::Begin(const std::vector<SkeletonPose>& first) {
  // One more than m: the velocity of the oldest.
  const size_t wanted = static_cast<size_t>(search_.options().num_frames) + 1;
  if (first.size() < wanted)
    throw std::invalid_argument(
        fmt::format("motion reconstruction: {} first poses, wanted {}", first.size(), wanted));
  past_.assign(first.end() - static_cast<std::ptrdiff_t>(wanted), first.end());
  cursor_ = {};
}

SkeletonPose MotionReconstruction::Next(const std::vector<TargetPoint>& observed) {
  if (past_.empty()) throw std::invalid_argument("motion reconstruction: Next before Begin");
  Predict(observed);
  const SkeletonPose pose = MostProbablePose(body_, prediction_, observed, database_.frame_time_s);
  past_.erase(past_.begin());
  past_.push_back(pose);
  return past_.back();
}

void MotionReconstruction::Predict(const std::vector<TargetPoint>& observed) {
  Gather(observed);
  KeepNearest();
  regression_.Solve(x_, y_, query_, options_.regression, &local_);
  prediction_.pose = PoseFromFeatures(local_.mean, past_.back(), database_.frame_time_s);
  prediction_.whitening = local_.whitening / options_.prior_sigma_factor;
}

// The candidates' inputs, the last poses and where their next pose has the
// observed points if this body made their next step, and outputs, that pose.
void MotionReconstruction::Gather(const std::vector<TargetPoint>& observed) {
  const int m = search_.options().num_frames;
  const FeatureMatrix past =
      MotionFeatures({database_.skeleton, database_.frame_time_s, past_}).rightCols(m);
  search_.FindNearest(past, &cursor_, &matches_);
  const Eigen::Index num_coordinates =
      options_.observed_scale_per_m > 0.0 ? 3 * static_cast<Eigen::Index>(observed.size()) : 0;
  const auto count = static_cast<Eigen::Index>(matches_.size());
  x_.resize(m * kNumFeatures + num_coordinates, count);
  y_.resize(kNumFeatures, count);
  query_.resize(x_.rows());
  query_.head(m * kNumFeatures) = LatestFirst(past);
  for (size_t i = 0; 3 * i < static_cast<size_t>(num_coordinates); ++i)
    query_.segment<3>(m * kNumFeatures + 3 * static_cast<Eigen::Index>(i)) = observed[i].x;
  BoneFrames frames;
  for (Eigen::Index k = 0; k < count; ++k) {
    const int end = matches_[static_cast<size_t>(k)].end_frame;
    x_.col(k).head(m * kNumFeatures) = LatestFirst(database_.features.middleCols(end - m + 1, m));
    y_.col(k) = database_.features.col(end + 1).cast<double>();
    if (num_coordinates == 0) continue;
    ForwardKinematics(body_.skeleton,
                      PoseFromFeatures(y_.col(k), past_.back(), database_.frame_time_s), &frames);
    x_.col(k).tail(num_coordinates) = PointsOf(JointPositions(body_.sites, frames), observed);
  }
  Eigen::VectorXd& scales = options_.regression.row_scales;
  scales.resize(x_.rows());
  scales << search_.row_weights().replicate(m, 1),
      Eigen::VectorXd::Constant(num_coordinates, options_.observed_scale_per_m);
}

void MotionReconstruction::KeepNearest() {
  const Eigen::VectorXd distances =
      (options_.regression.row_scales.asDiagonal() * (x_.colwise() - query_))
          .colwise()
          .squaredNorm()
          .transpose();
  std::vector<Eigen::Index> order(static_cast<size_t>(distances.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return distances[a] < distances[b]; });
  order.resize(std::min(order.size(), static_cast<size_t>(options_.num_neighbours)));
  x_ = x_(Eigen::all, order).eval();
  y_ = y_(Eigen::all, order).eval();
}

}  // namespace poselift
