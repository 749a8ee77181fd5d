// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/local_pose.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "lift/temporal/pose_difference.h"
#include "src/level_camera.h"

namespace poselift {
namespace {

constexpr int kNumPoseRows = kNumAngles + 3;  // angles and a rotation vector
using PoseRows = Eigen::Matrix<double, kNumPoseRows, 1>;
using Eigen::Quaterniond;

SkeletonPose MiddlePoseInCam(const MotionCodebook& codebook, const SegmentView& view) {
  SkeletonPose pose = PoseOfSample(codebook.segments.col(view.segment)
                                       .segment<kNumFeatures>(kMiddleSample * kNumFeatures)
                                       .cast<double>());
  const Quaterniond turned(Eigen::AngleAxisd(view.psi_rad, Eigen::Vector3d::UnitY()));
  pose.world_from_root = kLevelFromCam * turned * pose.world_from_root;
  pose.root_in_world_m.setZero();
  return pose;
}

Eigen::VectorXd Weights(const std::vector<SegmentView>& views, double bandwidth_m) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(views.size()));
  for (Eigen::Index k = 0; k < weights.size(); ++k)
    weights[k] =
        std::exp(-(views[static_cast<size_t>(k)].mean_squared_m2 - views.front().mean_squared_m2) /
                 (2.0 * bandwidth_m * bandwidth_m));
  return weights / weights.sum();
}

// The rotation whose squared sines to all are least (Markley et al. 2007).
Quaterniond MeanRotation(const std::vector<SkeletonPose>& poses, const Eigen::VectorXd& weights) {
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    const Eigen::Vector4d q = poses[static_cast<size_t>(k)].world_from_root.coeffs();
    moments += weights[k] * q * q.transpose();
  }
  Quaterniond mean;
  mean.coeffs() = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(moments).eigenvectors().col(3);
  return mean;
}

// Without the root's place.
PoseRows Difference(const SkeletonPose& pose, const SkeletonPose& mean) {
  const FeatureVector features = PoseDifference(pose, mean);
  PoseRows difference;
  difference << features.head<kNumAngles>(), features[feature::kTilt], features[feature::kYawRate],
      features[feature::kTilt + 1];
  return difference;
}

// Columns of the rows of Difference, put where the features have them.
Eigen::MatrixXd ByFeatures(const Eigen::MatrixXd& whitening) {
  Eigen::MatrixXd by_features = Eigen::MatrixXd::Zero(kNumPoseRows, kNumFeatures);
  by_features.leftCols<kNumAngles>() = whitening.leftCols<kNumAngles>();
  by_features.col(feature::kTilt) = whitening.col(kNumAngles);
  by_features.col(feature::kYawRate) = whitening.col(kNumAngles + 1);
  by_features.col(feature::kTilt + 1) = whitening.col(kNumAngles + 2);
  return by_features;
}

double Mismatch_rad(const std::vector<SegmentView>& views, const Eigen::VectorXd& weights,
                    double depth_weight, const LocalPoseOptions& options) {
  double squared_m2 = 0.0;
  for (Eigen::Index k = 0; k < weights.size(); ++k)
    squared_m2 += weights[k] * views[static_cast<size_t>(k)].mean_squared_m2;
  squared_m2 /= 2.0 + depth_weight * depth_weight;  // of a coordinate
  const double delta_m =
      std::sqrt(std::max(0.0, squared_m2 - options.label_sigma_m * options.label_sigma_m));
  return options.least_sigma_rad +
         options.sigma_per_m * delta_m * (1.0 + std::pow(delta_m / options.far_m, 4));
}

}  // namespace

std::string LocalPoseOptions::Validate() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(bandwidth_m))
    return fmt::format("LocalPoseOptions::bandwidth_m = {}, wanted > 0", bandwidth_m);
  if (!positive(least_sigma_rad))
    return fmt::format("LocalPoseOptions::least_sigma_rad = {}, wanted > 0", least_sigma_rad);
  if (!positive(far_m)) return fmt::format("LocalPoseOptions::far_m = {}, wanted > 0", far_m);
  if (!(sigma_per_m >= 0.0))
    return fmt::format("LocalPoseOptions::sigma_per_m = {}, wanted >= 0", sigma_per_m);
  if (!(label_sigma_m >= 0.0))
    return fmt::format("LocalPoseOptions::label_sigma_m = {}, wanted >= 0", label_sigma_m);
  if (!(shrinkage >= 0.0 && shrinkage <= 1.0))
    return fmt::format("LocalPoseOptions::shrinkage = {}, wanted 0 to 1", shrinkage);
  return "";
}

LocalPose MakeLocalPose(const MotionCodebook& codebook, const std::vector<SegmentView>& views,
                        double depth_weight, const LocalPoseOptions& options) {
  const Eigen::VectorXd weights = Weights(views, options.bandwidth_m);
  std::vector<SkeletonPose> poses;
  for (const SegmentView& view : views) poses.push_back(MiddlePoseInCam(codebook, view));

  LocalPose local;
  SkeletonPose& mean = local.prediction.pose;
  mean.world_from_root = MeanRotation(poses, weights);
  mean.dofs = Eigen::VectorXd::Zero(kNumAngles);
  local.rate_rad_per_s = Eigen::VectorXd::Zero(kNumAngles);
  local.acceleration = local.acceleration_deviation = Eigen::VectorXd::Zero(kNumAngles);
  PoseRows variances = PoseRows::Zero();  // within what each segment stands for
  for (size_t k = 0; k < views.size(); ++k) {
    const double weight = weights[static_cast<Eigen::Index>(k)];
    mean.dofs += weight * poses[k].dofs;
    const auto angles_of = [&](const auto& columns) -> Eigen::VectorXd {
      return columns.col(views[k].segment).template head<kNumAngles>().template cast<double>();
    };
    local.rate_rad_per_s += weight * angles_of(codebook.rates);
    const Eigen::VectorXd acceleration = angles_of(codebook.accelerations.means);
    local.acceleration += weight * acceleration;
    local.acceleration_deviation +=
        weight *
        (acceleration.cwiseAbs2() + angles_of(codebook.accelerations.deviations).cwiseAbs2());
    variances.head<kNumAngles>() += weight * angles_of(codebook.deviations).cwiseAbs2();
  }
  local.acceleration_deviation =
      (local.acceleration_deviation - local.acceleration.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  Eigen::Matrix<double, kNumPoseRows, kNumPoseRows> covariance = variances.asDiagonal();
  for (size_t k = 0; k < views.size(); ++k) {
    const PoseRows difference = Difference(poses[k], mean);
    covariance += weights[static_cast<Eigen::Index>(k)] * difference * difference.transpose();
  }
  const PoseRows diagonal = covariance.diagonal();
  covariance *= 1.0 - options.shrinkage;
  const double sigma_rad = Mismatch_rad(views, weights, depth_weight, options);
  local.doubt = sigma_rad / options.least_sigma_rad;
  covariance.diagonal() = diagonal.array() + sigma_rad * sigma_rad;
  const Eigen::MatrixXd whitening = covariance.llt().matrixL().solve(
      Eigen::MatrixXd(Eigen::MatrixXd::Identity(kNumPoseRows, kNumPoseRows)));
  local.prediction.whitening = ByFeatures(whitening);
  return local;
}

}  // namespace poselift
