// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/path_reconstruction.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr size_t kPastFrames = 31;  // what PathSearch looks back on
constexpr double kLeastWeight = 1e-12;

// A Gaussian by its mean and the inverse of its covariance.
struct Gaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd precision;
};

// Of weighted columns, the weights of sum 1. Deviations are from the mean of the
// other columns: that of a column weighed w is 1 / (1 - w) times that from the mean.
Gaussian GaussianOf(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weights,
                    const PathReconstructionOptions& options) {
  Gaussian gaussian;
  gaussian.mean = columns * weights;
  const Eigen::VectorXd scales =
      weights.cwiseSqrt().cwiseQuotient((1.0 - weights.array()).max(kLeastWeight).matrix());
  const Eigen::MatrixXd scaled = (columns.colwise() - gaussian.mean) * scales.asDiagonal();
  Eigen::MatrixXd covariance = (1.0 - options.shrinkage) * scaled * scaled.transpose();
  covariance.diagonal() =
      scaled.rowwise().squaredNorm().cwiseMax(options.least_stddev * options.least_stddev);
  gaussian.precision =
      covariance.llt().solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
  return gaussian;
}

Eigen::Vector3d Turned(const Eigen::Vector3d& x, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()) * x;
}

// The level velocity of features, in another heading.
void TurnVelocity(double yaw_rad, Eigen::Ref<Eigen::VectorXd> features) {
  const Eigen::Vector3d turned =
      Turned({features[feature::kVelocity], 0.0, features[feature::kVelocity + 1]}, yaw_rad);
  features[feature::kVelocity] = turned.x();
  features[feature::kVelocity + 1] = turned.z();
}

}  // namespace

std::string PathReconstructionOptions::Validate() const {
  const auto wrong = [](const char* name, double value, const char* wanted) {
    return fmt::format("PathReconstructionOptions::{} = {}, wanted {}", name, value, wanted);
  };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(bandwidth)) return wrong("bandwidth", bandwidth, "more than 0");
  if (!(shrinkage > 0.0 && shrinkage <= 1.0))
    return wrong("shrinkage", shrinkage, "more than 0, at most 1");
  if (!positive(change_sigma_factor))
    return wrong("change_sigma_factor", change_sigma_factor, "more than 0");
  if (!positive(least_stddev)) return wrong("least_stddev", least_stddev, "more than 0");
  return "";
}

PathReconstruction::PathReconstruction(const MotionDatabase& database, const PathSearch& search,
                                       const PathReconstructionOptions& options)
    : database_(database), search_(search), options_(options), body_(database.skeleton) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
}

void PathReconstruction::Begin(const std::vector<SkeletonPose>& first) {
  if (first.size() < 2)
    throw std::invalid_argument(
        fmt::format("path reconstruction: {} first poses, wanted 2", first.size()));
  const size_t count = std::min(first.size(), kPastFrames);
  past_.assign(first.end() - static_cast<std::ptrdiff_t>(count), first.end());
  paths_.reset();
}

SkeletonPose PathReconstruction::Next(const std::vector<TargetPoint>& observed) {
  if (past_.empty()) throw std::invalid_argument("path reconstruction: Next before Begin");
  Follow(observed);
  search_.FindNearest(query_, &*paths_, &matches_);
  Predict();
  past_.push_back(MostProbablePose(body_, prediction_, observed, database_.frame_time_s));
  if (past_.size() > kPastFrames) past_.erase(past_.begin());
  return past_.back();
}

// The query: the points' places so far.
void PathReconstruction::Follow(const std::vector<TargetPoint>& observed) {
  std::vector<std::vector<Landmark::Part>> parts;
  for (const TargetPoint& point : observed) parts.push_back(point.parts);
  auto& points_m = query_.points_in_world_m;
  const auto count = static_cast<Eigen::Index>(observed.size());
  const auto same = [](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
      return p.joint == q.joint && p.weight == q.weight;
    });
  };
  if (!paths_ || !std::equal(parts.begin(), parts.end(), parts_.begin(), parts_.end(), same)) {
    paths_ = search_.Paths(parts);
    parts_ = parts;
    points_m.clear();
    for (const SkeletonPose& pose : past_) {
      const Pose3 joints_m = JointPositions(body_, pose);
      points_m.emplace_back(3, count);
      for (Eigen::Index i = 0; i < count; ++i)
        points_m.back().col(i) = SumOfJoints(parts[static_cast<size_t>(i)], joints_m);
    }
  }
  points_m.emplace_back(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    points_m.back().col(i) = observed[static_cast<size_t>(i)].x;
  if (points_m.size() > kPastFrames) points_m.erase(points_m.begin());
  query_.pose = past_.back();
  query_.features =
      MotionFeatures(
          {database_.skeleton, database_.frame_time_s, {past_[past_.size() - 2], past_.back()}})
          .rightCols<1>();
}

void PathReconstruction::SetNeighbours() {
  const double frame_time_s = database_.frame_time_s;
  const double yaw_rad = Yaw(query_.pose.world_from_root);
  const auto count = static_cast<Eigen::Index>(matches_.size());
  poses_.resize(kNumFeatures, count);
  weights_.resize(count);
  changed_.resize(kNumFeatures, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const PathMatch& match = matches_[static_cast<size_t>(k)];
    const FeatureVector now = database_.features.col(match.frame).cast<double>();
    const FeatureVector before = database_.features.col(match.frame - 1).cast<double>();
    const Eigen::Vector3d step_m =
        Turned(match.root_in_world_m - query_.pose.root_in_world_m, -yaw_rad);
    poses_.col(k) = now;
    poses_.col(k).tail<3>() << step_m.x() / frame_time_s, step_m.z() / frame_time_s,
        std::remainder(match.yaw_rad - yaw_rad, 2.0 * std::numbers::pi) / frame_time_s;
    changed_.col(k) = query_.features + now - before;
    changed_.col(k).tail<3>() = now.tail<3>();
    TurnVelocity(now[feature::kYawRate] * frame_time_s, changed_.col(k));
    weights_[k] = match.energy;
  }
  const double nearest = weights_.minCoeff(), farthest = weights_.maxCoeff();
  const double twice_h_2 = 2.0 * std::pow(options_.bandwidth, 2) * std::max(farthest, 1e-9);
  weights_ = (-(weights_.array() - nearest) / twice_h_2).exp().max(kLeastWeight);
  weights_ /= weights_.sum();
}

void PathReconstruction::Predict() {
  if (matches_.empty()) {  // a database of no segments: as it was, roughly
    prediction_ = {past_.back(), Eigen::MatrixXd::Identity(kNumFeatures, kNumFeatures)};
    return;
  }
  SetNeighbours();
  const Gaussian pose = GaussianOf(poses_, weights_, options_);
  Gaussian change = GaussianOf(changed_, weights_, options_);
  change.precision /= options_.change_sigma_factor * options_.change_sigma_factor;
  const Eigen::LLT<Eigen::MatrixXd> both(pose.precision + change.precision);
  FeatureVector mean = both.solve(pose.precision * pose.mean + change.precision * change.mean);
  TurnVelocity(-mean[feature::kYawRate] * database_.frame_time_s, mean);
  prediction_.pose = PoseFromFeatures(mean, past_.back(), database_.frame_time_s);
  prediction_.whitening = both.matrixU();
}

}  // namespace poselift
