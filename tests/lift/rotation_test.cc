// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Angles, their inverse and derivatives by central differences; the rotation of
// planted poses; the slip of the printed Eq. (13).
#include "lift/rotation.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

const Eigen::Vector3d kNoPrior = Eigen::Vector3d::Zero();

// Rotation that differs by the angle from tau.
double AngleBetween(const Eigen::Vector3d& tau_a, const Eigen::Vector3d& tau_b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(CamFromBody(tau_a).transpose() * CamFromBody(tau_b)))
      .angle();
}

TEST(Rotation, FacingBodyLooksIntoTheCamera) {
  const Eigen::Matrix3d R = CamFromBody(Eigen::Vector3d::Zero());
  EXPECT_EQ(R * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX());   // its left: our right
  EXPECT_EQ(R * Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitY());  // up
  EXPECT_EQ(R * Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ());  // towards the camera
}

TEST(Rotation, IsARotationAndYawTurnsAboutTheBodysOwnAxis) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d tau = 3.0 * RandomMatrix(3, 1, &rng);
    const Eigen::Matrix3d R = CamFromBody(tau);
    EXPECT_TRUE(MatrixNear(R * R.transpose(), Eigen::Matrix3d::Identity(), 1e-14));
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
    const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()));
    EXPECT_TRUE(MatrixNear(R * turn, CamFromBody(tau + 0.7 * Eigen::Vector3d::UnitY()), 1e-14));
  }
}

TEST(Rotation, DerivativesAreTheCentralDifferences) {
  std::mt19937_64 rng = TestRng();
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d tau = 3.0 * RandomMatrix(3, 1, &rng);
    const auto derivatives = CamFromBodyDerivatives(tau);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      const Eigen::Matrix3d difference =
          (CamFromBody(tau + step) - CamFromBody(tau - step)) / (2 * kStep);
      EXPECT_TRUE(MatrixNear(derivatives[i], difference, 1e-9));
    }
  }
}

// Eq. (13) uses the rotation by tau + pi/2 e_i as the derivative. It keeps the
// constant entry of the rotation about axis i, whose derivative is zero.
TEST(Rotation, DerivativeOfThePrintedEq13IsOffByTheConstantEntry) {
  const Eigen::Vector3d tau(0.2, -0.9, 0.4);
  const auto derivatives = CamFromBodyDerivatives(tau);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix3d printed = CamFromBody(tau + M_PI / 2 * Eigen::Vector3d::Unit(i));
    const Eigen::Matrix3d extra = printed - derivatives[i];
    EXPECT_NEAR(extra.norm(), 1.0, 1e-12);  // a rotated e_i e_i^T
    EXPECT_NEAR(Eigen::JacobiSVD<Eigen::Matrix3d>(extra).singularValues()[0], 1.0, 1e-12);
  }
}

// The gradient of Eq. (12) by differences, against Eq. (13) with its three
// corrections, and as printed.
TEST(Rotation, GradientNeedsAllThreeCorrectionsOfEq13) {
  std::mt19937_64 rng = TestRng();
  const auto dictionary = testing::RandomDictionary(20, &rng);
  const auto planted = testing::PlantPose(dictionary, 4, &rng);
  const ProjectionOperator op(testing::ObserveInPicture(planted, 5.0));
  const Eigen::Matrix3Xd points = op.CentredPoints(planted.pose_in_body_m);
  const double scale = planted.camera.scale_px_per_m;
  const RotationOptions options{.prior_tau_rad = {0.1, 0.2, 0.3}, .prior_weight = {3, 4, 5}};
  const Eigen::Vector3d tau = planted.tau_rad + Eigen::Vector3d(0.2, 0.1, -0.1);
  const auto objective = [&](const Eigen::Vector3d& at) {
    return (op.Rows(CamFromBody(at), scale, points) - op.target()).squaredNorm() +
           RotationPriorCost(at, options);
  };
  const Eigen::VectorXd residual = op.Rows(CamFromBody(tau), scale, points) - op.target();
  const auto derivatives = CamFromBodyDerivatives(tau);
  Eigen::Vector3d gradient, data, data_printed;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    gradient[i] = (objective(tau + 1e-5 * axis) - objective(tau - 1e-5 * axis)) / 2e-5;
    data[i] = residual.dot(op.Rows(derivatives[i], scale, points));
    data_printed[i] = residual.dot(op.Rows(CamFromBody(tau + M_PI / 2 * axis), scale, points));
  }
  const Eigen::Vector3d from_prior = tau - options.prior_tau_rad;
  const Eigen::Vector3d prior_printed = options.prior_weight.cwiseProduct(from_prior);
  const Eigen::Vector3d prior = options.prior_weight.cwiseProduct(prior_printed);
  const auto is_gradient = [&](const Eigen::Vector3d& g) {
    return (g - gradient).norm() < 1e-6 * gradient.norm();
  };
  EXPECT_TRUE(is_gradient(2 * (data + prior)));
  EXPECT_FALSE(is_gradient(data + prior));                  // the factor 2
  EXPECT_FALSE(is_gradient(2 * (data + prior_printed)));    // W for W squared
  EXPECT_FALSE(is_gradient(2 * (data_printed + prior)));    // the constant entry
  EXPECT_FALSE(is_gradient(data_printed + prior_printed));  // Eq. (13)
}

TEST(Rotation, TauIsRecoveredFromTheRotation) {
  std::mt19937_64 rng = TestRng();
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d tau(0.49 * angle(rng), angle(rng), angle(rng));
    EXPECT_TRUE(MatrixNear(TauFromRotation(CamFromBody(tau)), tau, 1e-12));
  }
}

TEST(Rotation, TauOfAnyAnglesIsTheSameRotationInRange) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Matrix3d R = CamFromBody(10.0 * RandomMatrix(3, 1, &rng));
    const Eigen::Vector3d tau = TauFromRotation(R);
    EXPECT_TRUE(MatrixNear(CamFromBody(tau), R, 1e-13));
    EXPECT_LE(std::abs(tau.x()), M_PI / 2);
  }
}

TEST(Rotation, TauIsTheSameRotationWhenLookingAlongTheBody) {
  for (const double sign : {-1.0, 1.0})
    for (const double off : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-4}) {
      const Eigen::Matrix3d R = CamFromBody({sign * (M_PI / 2 - off), 0.7, -1.9});
      const Eigen::Vector3d tau = TauFromRotation(R);
      EXPECT_TRUE(tau.allFinite());
      EXPECT_TRUE(MatrixNear(CamFromBody(tau), R, 2e-9)) << "off by " << off;
    }
}

TEST(Rotation, PriorCostIsQuadraticAndPeriodic) {
  const RotationOptions options{.prior_tau_rad = {0.1, 0.0, -0.1}, .prior_weight = {2, 0, 3}};
  EXPECT_NEAR(RotationPriorCost({0.3, 99.0, 0.1}, options), 4 * 0.04 + 9 * 0.04, 1e-12);
  const Eigen::Vector3d tau(0.4, 1.0, -2.0);
  EXPECT_NEAR(RotationPriorCost(tau + Eigen::Vector3d(2, -4, 6) * M_PI, options),
              RotationPriorCost(tau, options), 1e-9);
}

TEST(EstimateRotation, FindsAPlantedRotation) {
  std::mt19937_64 rng = TestRng();
  const auto dictionary = testing::RandomDictionary(30, &rng);
  for (int trial = 0; trial < 40; ++trial) {
    const auto planted = testing::PlantPose(dictionary, 4, &rng);
    const Observation observation = trial % 2 == 0 ? testing::ObserveInPicture(planted, 2.0)
                                                   : testing::ObserveInSpace(planted, 0.01);
    const ProjectionOperator op(testing::Masked(observation, 0.3, &rng));
    const Eigen::Vector3d start = planted.tau_rad + 0.3 * RandomMatrix(3, 1, &rng);
    const RotationEstimate estimate = EstimateRotation(
        op, op.CentredPoints(planted.pose_in_body_m), planted.camera.scale_px_per_m, start,
        {.prior_weight = kNoPrior, .max_iterations = 200});
    EXPECT_LT(AngleBetween(estimate.tau_rad, planted.tau_rad), 1e-7);
    EXPECT_LT(estimate.objective, 1e-9);
  }
}

TEST(EstimateRotation, IsNeverWorseThanItsStart) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 200; ++trial) {
    const ProjectionOperator op(testing::RandomMixture(&rng));
    const Eigen::Matrix3Xd points = op.CentredPoints(RandomMatrix(3 * kNumJoints, 1, &rng));
    const Eigen::Vector3d start = 2.0 * RandomMatrix(3, 1, &rng);
    const RotationOptions options{.prior_tau_rad = RandomMatrix(3, 1, &rng),
                                  .prior_weight = 10.0 * RandomMatrix(3, 1, &rng).cwiseAbs(),
                                  .max_iterations = 1 + trial % 20};
    const double before = (op.Rows(CamFromBody(start), 50.0, points) - op.target()).squaredNorm() +
                          RotationPriorCost(start, options);
    const RotationEstimate estimate = EstimateRotation(op, points, 50.0, start, options);
    EXPECT_LE(estimate.objective, before);
    const double after =
        (op.Rows(CamFromBody(estimate.tau_rad), 50.0, points) - op.target()).squaredNorm() +
        RotationPriorCost(estimate.tau_rad, options);
    EXPECT_NEAR(estimate.objective, after, 1e-12 * before);
  }
}

TEST(EstimateRotation, GoesToThePriorWhereNoPointSpeaks) {
  std::mt19937_64 rng = TestRng();
  const ProjectionOperator op(testing::RandomMixture(&rng));
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, op.NumPoints());
  const Eigen::Vector3d tau_0(0.1, -0.4, 0.2);
  const RotationEstimate estimate = EstimateRotation(
      op, points, 50.0, {0.5, 0.5, 0.5}, {.prior_tau_rad = tau_0, .prior_weight = {100, 100, 100}});
  EXPECT_TRUE(MatrixNear(estimate.tau_rad, tau_0, 1e-4));
}

TEST(EstimateRotation, StaysWhereNothingCanBeGained) {
  std::mt19937_64 rng = TestRng();
  const ProjectionOperator op(testing::RandomMixture(&rng));
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, op.NumPoints());
  const Eigen::Vector3d start(0.3, 0.2, 0.1);
  const RotationEstimate estimate =
      EstimateRotation(op, points, 50.0, start, {.prior_weight = kNoPrior});
  EXPECT_EQ(estimate.tau_rad, start);
}

TEST(RotationOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(RotationOptions().Validate(), "");
  EXPECT_THAT((RotationOptions{.prior_weight = {1, -1, 1}}.Validate()),
              ::testing::HasSubstr("prior_weight"));
  EXPECT_THAT((RotationOptions{.prior_weight = {1, std::nan(""), 1}}.Validate()),
              ::testing::HasSubstr("prior_weight"));
  EXPECT_THAT((RotationOptions{.prior_tau_rad = {1, INFINITY, 1}}.Validate()),
              ::testing::HasSubstr("prior_tau_rad"));
  EXPECT_THAT((RotationOptions{.max_iterations = 0}.Validate()),
              ::testing::HasSubstr("max_iterations = 0"));
}

}  // namespace
}  // namespace poselift
