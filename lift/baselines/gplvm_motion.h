// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lift/baselines/feature_points.h"
#include "lift/baselines/scaled_gplvm.h"
#include "lift/ik/articulation.h"
#include "lift/temporal/motion_database.h"
#include "lift/temporal/motion_method.h"

namespace ceres {
class CostFunction;
}

namespace poselift {

// A scaled GPLVM of the poses of a database: its rows are the 46 features and, as
// the paper has velocities among its own, the change of each pose feature (0..42)
// since the frame before.
inline constexpr int kNumPoseFeatures = feature::kVelocity;

struct StyleOptions {
  // The active set: the frames that are learned, drawn by the seed from all that
  // have a frame before them. Training costs its cube.
  int num_frames = 200;
  uint64_t seed = 1;
  bool changes = true;
  ScaledGplvmOptions gplvm;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct Style {
  ScaledGplvm gplvm;
  FeatureMatrix poses;  // 46 x N: the active set
  bool has_changes = true;
};

// Throws InputError when the options are invalid or the database has too few frames.
Style LearnStyle(const MotionDatabase& database, const StyleOptions& options = {});

// L_IK below as residuals: blocks y (46) and x (Q); `last` is the features of the
// frame before. Rows, each times the weight:
//   w_d (y_d - f_d(x)) / sigma(x)     for each of the model's features
//   sqrt(D ln(2 beta sigma^2(x)))
//   x
// The style must outlive it; for one thread at a time.
std::unique_ptr<ceres::CostFunction> MakeStyleCost(const Style& style, const FeatureVector& last,
                                                   double weight);

struct GplvmMotionOptions {
  // Solves start at the last frame's latent point and at those of so many learned
  // poses, the nearest to the last pose and the observed points.
  int num_starts = 1;
  double observed_scale_per_m = 20.0;  // a metre there, beside weighted features
  double prior_sigma_factor = 10.0;    // L_IK is divided by its square

  std::string Validate() const;  // empty, or which option is wrong and why
};

// Motion reconstruction by style-based inverse kinematics (Grochow et al. 2004): at
// each frame
//
//   min_{y, x}  sum_i |m_i f(q(y)) - c_i|^2 / (2 sigma_i^2) + L_IK(x, y)
//   L_IK = |W (y - f(x))|^2 / (2 sigma^2(x)) + D/2 ln sigma^2(x) + |x|^2 / 2
//
// with f, sigma and W = diag(w) of the GPLVM (scaled_gplvm.h). As sigma^2 >= 1/beta
// the logarithm is a square too, D ln(2 beta sigma^2) / 2 up to a constant, and
// Levenberg-Marquardt solves it as it stands.
class GplvmMotion : public MotionMethod {
 public:
  // row_weights: of distances between features (RowWeights). The style, which may
  // be shared, must outlive this. Throws InputError when the options are invalid.
  GplvmMotion(const Style& style, const Skeleton& skeleton, double frame_time_s,
              const FeatureVector& row_weights, const GplvmMotionOptions& options = {});

  // At least two poses. Throws std::invalid_argument for fewer.
  void Begin(const std::vector<SkeletonPose>& first) override;
  SkeletonPose Next(const std::vector<TargetPoint>& observed) override;

 private:
  struct Solution {
    FeatureVector features;
    Eigen::VectorXd latent;
    double cost;
  };

  // Learned poses, the nearest to the last one and what is observed first.
  std::vector<Eigen::Index> NearestPoses(int count);
  Solution Solve(const FeatureVector& features, const Eigen::VectorXd& latent);

  const Style& style_;
  GplvmMotionOptions options_;
  Articulation body_;
  double frame_time_s_;
  FeatureVector row_weights_;
  FeaturePoints points_;
  SkeletonPose last_pose_;
  FeatureVector last_;      // its features
  Eigen::VectorXd latent_;  // its latent point; empty before Begin
  GplvmPrediction prediction_;
};

}  // namespace poselift
