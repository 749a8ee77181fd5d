// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Poses made of a planted curve in the plane, bent into ten features of different
// sizes. Gradients against differences, the model against what planted it and
// against the textbook's formulas.
#include "lift/baselines/scaled_gplvm.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "src/input_error.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

constexpr int kNumPoses = 40;
constexpr int kDim = 10;

// Once around a circle, bent.
struct Planted {
  explicit Planted(int num_poses = kNumPoses) : rng(TestRng()), y(kDim, num_poses) {
    const MatrixXd mixture = RandomMatrix(kDim, 3, &rng);
    sizes = VectorXd::LinSpaced(kDim, 0.05, 3.0);
    for (int i = 0; i < num_poses; ++i) {
      const double phase = 2.0 * M_PI * i / num_poses;
      const Eigen::Vector3d bent(std::sin(phase), std::cos(phase),
                                 std::sin(phase) * std::cos(phase));
      y.col(i) = sizes.asDiagonal() * (mixture * bent);
    }
    noise = 0.02;
    y += noise * sizes.asDiagonal() * RandomMatrix(kDim, num_poses, &rng);
  }

  MatrixXd Centred() const { return y.colwise() - y.rowwise().mean(); }

  std::mt19937_64 rng;
  VectorXd sizes;
  double noise;
  MatrixXd y;
};

TEST(ScaledGplvm, GradientEqualsDifferences) {
  Planted planted(12);
  const MatrixXd y = planted.Centred();
  const VectorXd parameters = 0.5 * RandomMatrix(2 * 12 + 3 + kDim, 1, &planted.rng);
  double cost = 0.0, ahead = 0.0, behind = 0.0;
  VectorXd gradient;
  ASSERT_TRUE(ScaledGplvmCost(y, 2, 0.1, parameters, &cost, &gradient));
  ASSERT_EQ(gradient.size(), parameters.size());
  for (Eigen::Index i = 0; i < parameters.size(); ++i) {
    constexpr double kStep = 1e-5;
    const VectorXd step = kStep * VectorXd::Unit(parameters.size(), i);
    ASSERT_TRUE(ScaledGplvmCost(y, 2, 0.1, parameters + step, &ahead, nullptr));
    ASSERT_TRUE(ScaledGplvmCost(y, 2, 0.1, parameters - step, &behind, nullptr));
    EXPECT_NEAR((ahead - behind) / (2 * kStep), gradient[i], 1e-6 * (1.0 + std::abs(gradient[i])))
        << i;
  }
}

// The formula of the header, by inverse and determinant.
TEST(ScaledGplvm, CostIsTheNegativeLogarithmOfThePosterior) {
  Planted planted(6);
  const MatrixXd y = planted.Centred();
  const VectorXd parameters = 0.5 * RandomMatrix(2 * 6 + 3 + kDim, 1, &planted.rng);
  const MatrixXd x = parameters.head(12).reshaped(2, 6);
  const double alpha = std::exp(parameters[12]), beta = std::exp(parameters[13]),
               gamma = std::exp(parameters[14]), least = 0.1;
  MatrixXd K(6, 6);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      K(i, j) = alpha * std::exp(-0.5 * gamma * (x.col(i) - x.col(j)).squaredNorm()) +
                (i == j ? 1.0 / beta : 0.0);
  double expected = 0.5 * kDim * std::log(K.determinant()) + 0.5 * x.squaredNorm() +
                    std::log(alpha) + std::log(beta) + std::log(gamma);
  for (int d = 0; d < kDim; ++d) {
    const double w = std::exp(parameters[15 + d]);
    const double fit = (y.row(d) * K.inverse() * y.row(d).transpose()).value();
    expected += 0.5 * w * w * (fit + 6 * least * least) - 6 * std::log(w);
  }
  double cost = 0.0;
  ASSERT_TRUE(ScaledGplvmCost(y, 2, least, parameters, &cost, nullptr));
  EXPECT_NEAR(cost, expected, 1e-9 * std::abs(expected));
}

TEST(ScaledGplvm, LearnsThePlantedCurve) {
  const Planted planted;
  const ScaledGplvm model = TrainScaledGplvm(planted.y, {.latent_dim = 2});
  GplvmPrediction prediction;
  const double least_sigma = std::sqrt(1.0 / model.beta);
  for (int i = 0; i < kNumPoses; ++i) {
    Predict(model, model.latent.col(i), &prediction);
    const VectorXd misfit =
        planted.sizes.cwiseInverse().asDiagonal() * (prediction.mean - planted.y.col(i));
    EXPECT_LT(misfit.norm() / std::sqrt(kDim), 2.0 * planted.noise);
    EXPECT_LT(std::sqrt(prediction.variance), 1.5 * least_sigma);
    // Of a ring the two nearest are the neighbours.
    VectorXd distances = (model.latent.colwise() - model.latent.col(i)).colwise().squaredNorm();
    distances[i] = std::numeric_limits<double>::infinity();
    Eigen::Index nearest = 0;
    distances.minCoeff(&nearest);
    const auto apart = std::abs(nearest - i);
    EXPECT_LE(std::min<Eigen::Index>(apart, kNumPoses - apart), 3);
  }
  // Far from all poses it knows nothing.
  Predict(model, VectorXd::Constant(2, 100.0), &prediction);
  EXPECT_TRUE(MatrixNear(prediction.mean, model.mean, 1e-9));
  EXPECT_NEAR(prediction.variance, model.alpha + 1.0 / model.beta, 1e-9);
}

// The sigmas of the noise, not of the features, are what the scales undo.
TEST(ScaledGplvm, ScalesAreInverseToTheSizesOfTheFeatures) {
  const Planted planted;
  MatrixXd larger = planted.y;
  larger.row(4) *= 10.0;
  const ScaledGplvmOptions options{.latent_dim = 2, .least_stddev = 1e-6};
  const ScaledGplvm a = TrainScaledGplvm(planted.y, options), b = TrainScaledGplvm(larger, options);
  EXPECT_NEAR(b.scales[4] / a.scales[4], 0.1, 1e-3);
  EXPECT_NEAR(b.scales[3] / a.scales[3], 1.0, 1e-2);
}

TEST(ScaledGplvm, DerivativesOfThePredictionEqualDifferences) {
  Planted planted;
  const ScaledGplvm model = TrainScaledGplvm(planted.y, {.latent_dim = 3, .max_iterations = 20});
  const VectorXd x = 0.7 * RandomMatrix(3, 1, &planted.rng);
  GplvmPrediction here, ahead, behind;
  Predict(model, x, &here);
  for (int q = 0; q < 3; ++q) {
    constexpr double kStep = 1e-5;
    const VectorXd step = kStep * VectorXd::Unit(3, q);
    Predict(model, x + step, &ahead);
    Predict(model, x - step, &behind);
    EXPECT_TRUE(MatrixNear((ahead.mean - behind.mean) / (2 * kStep), here.mean_by_x.col(q), 1e-5));
    EXPECT_NEAR((ahead.variance - behind.variance) / (2 * kStep), here.variance_by_x[q], 1e-5);
  }
}

TEST(ScaledGplvm, TrainingLowersTheCostAndGivesTheSameEveryTime) {
  const Planted planted;
  const ScaledGplvm one = TrainScaledGplvm(planted.y, {.latent_dim = 2, .max_iterations = 1});
  const ScaledGplvm a = TrainScaledGplvm(planted.y, {.latent_dim = 2});
  const ScaledGplvm b = TrainScaledGplvm(planted.y, {.latent_dim = 2});
  EXPECT_LT(a.cost, one.cost);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.latent, b.latent);
  EXPECT_EQ(a.coefficients, b.coefficients);
}

TEST(ScaledGplvm, TakesFeaturesThatDoNotVary) {
  Planted planted;
  planted.y.row(2).setConstant(0.5);
  const ScaledGplvm model = TrainScaledGplvm(planted.y, {.latent_dim = 2, .least_stddev = 0.01});
  GplvmPrediction prediction;
  Predict(model, model.latent.col(7), &prediction);
  EXPECT_NEAR(prediction.mean[2], 0.5, 1e-12);
  EXPECT_NEAR(model.scales[2], 100.0, 1.0);
}

TEST(ScaledGplvm, SaysWhatIsWrong) {
  const Planted planted;
  EXPECT_THROW(TrainScaledGplvm(planted.y, {.latent_dim = 0}), InputError);
  EXPECT_THROW(TrainScaledGplvm(planted.y, {.latent_dim = kDim + 1}), InputError);
  EXPECT_THROW(TrainScaledGplvm(planted.y, {.max_iterations = 0}), InputError);
  EXPECT_THROW(TrainScaledGplvm(planted.y, {.least_stddev = 0.0}), InputError);
  EXPECT_THROW(TrainScaledGplvm(planted.y.leftCols(3), {.latent_dim = 3}), InputError);
  MatrixXd broken = planted.y;
  broken(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TrainScaledGplvm(broken, {}), InputError);
}

}  // namespace
}  // namespace poselift
