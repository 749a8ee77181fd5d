// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up gaits (tests/support/made_up_gaits.h), a style learned from some frames
// of them, and another gait of that kind seen at its wrists and ankles.
#include "lift/baselines/gplvm_motion.h"

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "lift/baselines/frame_ik.h"
#include "lift/eval/evaluate_motion.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectToMoveAlong;
using testing::MadeUpGaits;
using testing::MatrixNear;
using testing::ObserveHandAndFoot;

StyleOptions SmallStyle() {
  StyleOptions options;
  options.num_frames = 80;
  options.gplvm.max_iterations = 100;
  return options;
}

struct World {
  explicit World(const StyleOptions& options = SmallStyle())
      : database(gaits.Database(8, 60)), style(LearnStyle(database, options)) {}

  std::unique_ptr<MotionMethod> Make(const GplvmMotionOptions& options = {}) const {
    return std::make_unique<GplvmMotion>(style, database.skeleton, database.frame_time_s,
                                         RowWeights(database), options);
  }

  std::vector<MotionEvaluation> Evaluate(const NamedMotionMethod& method) const {
    EvaluateMotionOptions options;
    options.control_points = {PaperControlPoints()[2]};
    return EvaluateMotion({method}, {{"walking", "another", gaits.Gait(60, 0.47)}}, options, {});
  }

  MadeUpGaits gaits;
  MotionDatabase database;
  Style style;
};

TEST(Style, LearnsFramesOfTheDatabaseWithTheirChanges) {
  const World world;
  const Style& style = world.style;
  ASSERT_EQ(style.poses.cols(), 80);
  ASSERT_EQ(style.gplvm.mean.size(), kNumFeatures + kNumPoseFeatures);
  std::set<int> found;
  GplvmPrediction prediction;
  for (Eigen::Index i = 0; i < style.poses.cols(); ++i) {
    Eigen::Index frame = 0;
    const auto misses =
        (world.database.features.cast<double>().colwise() - style.poses.col(i)).colwise();
    EXPECT_EQ(misses.squaredNorm().minCoeff(&frame), 0.0);
    found.insert(static_cast<int>(frame));
    Predict(style.gplvm, style.gplvm.latent.col(i), &prediction);
    EXPECT_TRUE(MatrixNear(prediction.mean.head<kNumAngles>(),
                           style.poses.col(i).head<kNumAngles>(), 0.02));
    const FeatureVector change =
        style.poses.col(i) - world.database.features.col(frame - 1).cast<double>();
    EXPECT_TRUE(MatrixNear(prediction.mean.tail<kNumPoseFeatures>().head<kNumAngles>(),
                           change.head<kNumAngles>(), 0.02));
  }
  EXPECT_EQ(found.size(), 80u);  // each once
}

TEST(Style, DependsOnTheSeedAlone) {
  const World world;
  StyleOptions options = SmallStyle();
  const Style again = LearnStyle(world.database, options);
  EXPECT_EQ(world.style.gplvm.latent, again.gplvm.latent);
  options.seed = 2;
  EXPECT_NE(LearnStyle(world.database, options).poses, again.poses);
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Coarse: the finer the style, the less do differences say of its derivatives.
StyleOptions CoarseStyle() {
  StyleOptions options = SmallStyle();
  options.gplvm.least_stddev = 0.1;
  options.gplvm.max_iterations = 5;
  return options;
}

struct AtSomePoint {
  AtSomePoint()
      : world(CoarseStyle()), last(world.style.poses.col(3)), y(world.style.poses.col(4)) {
    y.head<kNumAngles>().array() += 0.01;
    x = 0.9 * world.style.gplvm.latent.col(4).array() + 0.1;
    cost = MakeStyleCost(world.style, last, 0.7);
  }

  Eigen::VectorXd Residuals(double** jacobians = nullptr) const {
    const double* blocks[] = {y.data(), x.data()};
    Eigen::VectorXd residuals(cost->num_residuals());
    EXPECT_TRUE(cost->Evaluate(blocks, residuals.data(), jacobians));
    return residuals;
  }

  World world;
  FeatureVector last, y;
  Eigen::VectorXd x;
  std::unique_ptr<ceres::CostFunction> cost;
};

TEST(StyleCost, IsTheNegativeLogarithmOfTheStyle) {
  const AtSomePoint at;
  const ScaledGplvm& gplvm = at.world.style.gplvm;
  GplvmPrediction f;
  Predict(gplvm, at.x, &f);
  Eigen::VectorXd all(kNumFeatures + kNumPoseFeatures);
  all << at.y, (at.y - at.last).head<kNumPoseFeatures>();
  const auto dim = static_cast<double>(all.size());
  const double l_ik = 0.5 * gplvm.scales.cwiseProduct(all - f.mean).squaredNorm() / f.variance +
                      0.5 * dim * std::log(2.0 * gplvm.beta * f.variance) +
                      0.5 * at.x.squaredNorm();
  EXPECT_NEAR(0.5 * at.Residuals().squaredNorm(), 0.7 * 0.7 * l_ik, 1e-9 * l_ik);
}

TEST(StyleCost, JacobiansEqualDifferences) {
  AtSomePoint at;
  const auto rows = at.cost->num_residuals();
  RowMajor by_y(rows, kNumFeatures), by_x(rows, at.x.size());
  double* jacobians[] = {by_y.data(), by_x.data()};
  at.Residuals(jacobians);
  const auto expect_column = [&](double& parameter, const Eigen::VectorXd& column) {
    constexpr double kStep = 1e-4;
    const double start = parameter;
    parameter = start + kStep;
    const Eigen::VectorXd ahead = at.Residuals();
    parameter = start - kStep;
    const Eigen::VectorXd behind = at.Residuals();
    parameter = start;
    EXPECT_TRUE(MatrixNear((ahead - behind) / (2 * kStep), column, 1e-5 * (1.0 + column.norm())));
  };
  for (int i = 0; i < kNumFeatures; ++i) expect_column(at.y[i], by_y.col(i));
  for (int i = 0; i < at.x.size(); ++i) expect_column(at.x[i], by_x.col(i));
}

TEST(GplvmMotion, BeatsInverseKinematicsOnMotionsOfItsKind) {
  const World world;
  const auto gplvm = world.Evaluate({"", [&] { return world.Make(); }});
  const auto ik = world.Evaluate({"", [&] {
                                    return std::make_unique<FrameIk>(world.database.skeleton,
                                                                     world.database.frame_time_s,
                                                                     FeatureVector::Constant(0.05));
                                  }});
  EXPECT_LT(gplvm[0].position_mm, 0.5 * ik[0].position_mm);
  EXPECT_LT(gplvm[0].position_mm, 25.0);
  const auto again = world.Evaluate({"", [&] { return world.Make(); }});
  EXPECT_EQ(gplvm[0].position_mm, again[0].position_mm);
}

TEST(GplvmMotion, WorksWithoutTheChanges) {
  StyleOptions options = SmallStyle();
  options.changes = false;
  const World world(options);
  ASSERT_EQ(world.style.gplvm.mean.size(), kNumFeatures);
  EXPECT_LT(world.Evaluate({"", [&] { return world.Make(); }})[0].position_mm, 40.0);
}

TEST(GplvmMotion, DoesNotDependOnPlaceAndHeading) {
  const World world;
  ExpectToMoveAlong(world.gaits.Gait(12, 0.3), world.Make().get(), world.Make().get());
}

TEST(GplvmMotion, GoesOnWithoutObservations) {
  const World world;
  const auto method = world.Make();
  const Motion motion = world.gaits.Gait(30, 0.3);
  method->Begin({motion.frames.begin(), motion.frames.begin() + 4});
  for (int t = 4; t < 30; ++t) EXPECT_TRUE(method->Next({}).dofs.allFinite());
}

TEST(GplvmMotion, SaysWhatIsWrong) {
  const World world;
  StyleOptions style;
  style.num_frames = 1000000;
  EXPECT_THROW(LearnStyle(world.database, style), InputError);
  style.num_frames = style.gplvm.latent_dim;
  EXPECT_THROW(LearnStyle(world.database, style), InputError);
  style = {};
  style.gplvm.least_stddev = -1.0;
  EXPECT_THROW(LearnStyle(world.database, style), InputError);
  EXPECT_THROW(world.Make({.num_starts = -1}), InputError);
  EXPECT_THROW(world.Make({.observed_scale_per_m = NAN}), InputError);
  EXPECT_THROW(world.Make({.prior_sigma_factor = 0.0}), InputError);
  const auto method = world.Make();
  EXPECT_THROW(method->Next({}), std::invalid_argument);
  EXPECT_THROW(method->Begin(world.gaits.Gait(1, 0.5).frames), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
