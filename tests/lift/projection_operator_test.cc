// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up mixtures of points. P as a linear map: its adjoint, its invariance to
// translations, and its agreement with a camera that projects the joints.
#include "lift/projection_operator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift/rotation.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::RandomMixture;
using testing::SomeRelations;
using testing::TestRng;

constexpr int kNumbers = 3 * kNumJoints;

Eigen::Matrix3d RandomRotation(std::mt19937_64* rng) {
  return CamFromBody(3.0 * RandomMatrix(3, 1, rng));
}

Observation Shifted(Observation observation, const Eigen::Vector3d& shift) {
  for (ObservedPoint& point : observation.points)
    point.x +=
        point.kind == ObservedPoint::Kind::k2D ? Eigen::Vector3d(shift.x(), shift.y(), 0) : shift;
  return observation;
}

TEST(ProjectionOperator, AdjointIsTheTransposed) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 100; ++trial) {
    const ProjectionOperator op(RandomMixture(&rng));
    const Eigen::Matrix3d R = RandomRotation(&rng);
    const double scale = 0.5 + trial;
    const Eigen::VectorXd y = RandomMatrix(kNumbers, 1, &rng);
    const Eigen::VectorXd v = RandomMatrix(op.NumRows(), 1, &rng);
    const double forward = op.Apply(R, scale, y).dot(v);
    EXPECT_NEAR(forward, y.dot(op.Adjoint(R, scale, v)), 1e-12 * scale * y.norm() * v.norm() * 10);
  }
}

TEST(ProjectionOperator, ApplyToAllIsApplyOnEveryColumn) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const ProjectionOperator op(RandomMixture(&rng));
    const Eigen::Matrix3d R = RandomRotation(&rng);
    const Eigen::MatrixXd atoms = RandomMatrix(kNumbers, 17, &rng);
    const Eigen::MatrixXd centred = op.CentredPointsOfAll(atoms);
    Eigen::MatrixXd rows(op.NumRows(), atoms.cols());
    op.ApplyToAll(R, 40.0, centred, rows);
    for (int k = 0; k < atoms.cols(); ++k) {
      const Eigen::VectorXd expected = op.Apply(R, 40.0, atoms.col(k));
      EXPECT_TRUE(MatrixNear(rows.col(k), expected, 1e-12 * (1.0 + expected.norm())));
    }
  }
}

TEST(ProjectionOperator, RelationsAreRowsOfTheJointsInCam) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    Observation observation = RandomMixture(&rng);
    const ProjectionOperator without(observation);
    observation.relations = SomeRelations();
    const ProjectionOperator op(observation);
    const int num_relations = static_cast<int>(observation.relations.size());
    ASSERT_EQ(op.NumRows(), without.NumRows() + num_relations);
    EXPECT_EQ(op.NumPointRows(), without.NumRows());
    const Eigen::Matrix3d R = RandomRotation(&rng);
    const Eigen::VectorXd y = RandomMatrix(kNumbers, 1, &rng);
    const Eigen::VectorXd rows = op.Apply(R, 30.0, y);
    EXPECT_EQ(rows.head(without.NumRows()), without.Apply(R, 30.0, y));
    EXPECT_EQ(op.target().head(without.NumRows()), without.target());
    const Eigen::VectorXd residual = op.Residual(R, 30.0, op.CentredPoints(y));
    const Eigen::ArrayXd active = op.ActiveRows(rows - op.target());
    const Pose3 joints_in_cam = R * Unstacked(y);
    for (int i = 0; i < num_relations; ++i) {
      const double expected = observation.relations[static_cast<size_t>(i)].Residual(joints_in_cam);
      const Eigen::Index row = without.NumRows() + i;
      EXPECT_NEAR(residual[row], expected, 1e-9);
      EXPECT_EQ(active[row], expected == 0.0 ? 0.0 : 1.0);
    }
  }
}

TEST(ProjectionOperator, AdjointAndAllColumnsHaveTheRelationsToo) {
  std::mt19937_64 rng = TestRng();
  Observation observation = RandomMixture(&rng);
  observation.relations = SomeRelations();
  const ProjectionOperator op(observation);
  const Eigen::Matrix3d R = RandomRotation(&rng);
  const Eigen::MatrixXd atoms = RandomMatrix(kNumbers, 7, &rng);
  const Eigen::VectorXd v = RandomMatrix(op.NumRows(), 1, &rng);
  Eigen::MatrixXd rows(op.NumRows(), atoms.cols());
  op.ApplyToAll(R, 40.0, op.CentredPointsOfAll(atoms), rows);
  for (int k = 0; k < atoms.cols(); ++k) {
    const Eigen::VectorXd expected = op.Apply(R, 40.0, atoms.col(k));
    EXPECT_TRUE(MatrixNear(rows.col(k), expected, 1e-12 * expected.norm()));
    EXPECT_NEAR(expected.dot(v), atoms.col(k).dot(op.Adjoint(R, 40.0, v)), 1e-9 * expected.norm());
  }
}

TEST(ProjectionOperator, IsLinearInThePose) {
  std::mt19937_64 rng = TestRng();
  const ProjectionOperator op(RandomMixture(&rng));
  const Eigen::Matrix3d R = RandomRotation(&rng);
  const Eigen::VectorXd a = RandomMatrix(kNumbers, 1, &rng), b = RandomMatrix(kNumbers, 1, &rng);
  const Eigen::VectorXd expected = 2.0 * op.Apply(R, 3.0, a) - 5.0 * op.Apply(R, 3.0, b);
  EXPECT_TRUE(MatrixNear(op.Apply(R, 3.0, 2.0 * a - 5.0 * b), expected, 1e-10));
}

// Eq. (6) is needed: what s > 0 forbids looks the same.
TEST(ProjectionOperator, NegativePoseWithTheRollTurnedIsTheSamePicture) {
  std::mt19937_64 rng = TestRng();
  const auto planted = testing::PlantPose(testing::RandomDictionary(9, &rng), 3, &rng);
  const ProjectionOperator op(testing::ObserveInPicture(planted, 1.0));
  const Eigen::Vector3d turned = planted.tau_rad + M_PI * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(MatrixNear(op.Apply(CamFromBody(turned), 50.0, -planted.pose_in_body_m),
                         op.Apply(CamFromBody(planted.tau_rad), 50.0, planted.pose_in_body_m),
                         1e-10));
}

TEST(ProjectionOperator, MovingThePoseOrThePointsChangesNothing) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const Observation observation = RandomMixture(&rng);
    const ProjectionOperator op(observation);
    const Eigen::Vector3d shift = RandomMatrix(3, 1, &rng);
    const Eigen::VectorXd y = RandomMatrix(kNumbers, 1, &rng);
    const Eigen::Matrix3d R = RandomRotation(&rng);
    EXPECT_TRUE(MatrixNear(op.Apply(R, 9.0, y + shift.replicate(kNumJoints, 1)),
                           op.Apply(R, 9.0, y), 1e-10));
    EXPECT_TRUE(
        MatrixNear(ProjectionOperator(Shifted(observation, shift)).target(), op.target(), 1e-10));
  }
}

// C C = C: what is left is orthogonal to the weights of each kind.
TEST(ProjectionOperator, CentredPointsHaveNoWeightedMean) {
  std::mt19937_64 rng = TestRng();
  const Observation observation = RandomMixture(&rng);
  const ProjectionOperator op(observation);
  const Eigen::Matrix3Xd points = op.CentredPoints(RandomMatrix(kNumbers, 1, &rng));
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, 2);  // over the 2D, over the 3D points
  Eigen::Index next[2] = {0, op.Num2D()};
  for (const ObservedPoint& point : observation.points) {
    const int kind = point.kind == ObservedPoint::Kind::k2D ? 0 : 1;
    sums.col(kind) += points.col(next[kind]++) / point.sigma;
  }
  EXPECT_TRUE(MatrixNear(sums, Eigen::Matrix3Xd::Zero(3, 2), 1e-12));
}

// Equals the least squares over an explicit translation.
TEST(ProjectionOperator, ResidualIsThatOfTheBestTranslation) {
  std::mt19937_64 rng = TestRng();
  const auto dictionary = testing::RandomDictionary(30, &rng);
  const auto planted = testing::PlantPose(dictionary, 4, &rng);
  Observation observation = testing::ObserveInPicture(planted, 2.0);
  for (ObservedPoint& point : observation.points) {
    point.x.head<2>() += 10.0 * RandomMatrix(2, 1, &rng);
    point.sigma = 1.0 + std::abs(RandomMatrix(1, 1, &rng)(0));
  }
  const ProjectionOperator op(observation);
  const WeakCamera& camera = planted.camera;
  const Eigen::Vector2d translation_px =
      op.Translation_px(camera.cam_from_body, camera.scale_px_per_m, planted.pose_in_body_m);
  const auto cost_at = [&](const Eigen::Vector2d& translation) {
    const WeakCamera moved{camera.cam_from_body, camera.scale_px_per_m, translation};
    const Eigen::Matrix2Xd joints_px = moved.Project(planted.JointsInCam_m());
    double cost = 0.0;
    for (int j = 0; j < kNumJoints; ++j) {
      const ObservedPoint& point = observation.points[j];
      cost += ((joints_px.col(j) - point.x.head<2>()) / point.sigma).squaredNorm();
    }
    return cost;
  };
  const double cost =
      (op.Apply(camera.cam_from_body, camera.scale_px_per_m, planted.pose_in_body_m) - op.target())
          .squaredNorm();
  EXPECT_NEAR(cost, cost_at(translation_px), 1e-8 * cost);
  for (int i = 0; i < 2; ++i)
    for (const double step : {-0.1, 0.1})
      EXPECT_GT(cost_at(translation_px + step * Eigen::Vector2d::Unit(i)), cost);
}

TEST(ProjectionOperator, FindsTheScaleAndTranslationOfTheCamera) {
  std::mt19937_64 rng = TestRng();
  const auto dictionary = testing::RandomDictionary(30, &rng);
  for (int trial = 0; trial < 20; ++trial) {
    const auto planted = testing::PlantPose(dictionary, 4, &rng);
    const ProjectionOperator op(
        testing::Masked(testing::ObserveInPicture(planted, 2.0), 0.4, &rng));
    const auto& [R, scale, translation_px] = planted.camera;
    EXPECT_NEAR(op.BestScale_px_per_m(R, op.CentredPoints(planted.pose_in_body_m), 1.0), scale,
                1e-9);
    EXPECT_TRUE(
        MatrixNear(op.Translation_px(R, scale, planted.pose_in_body_m), translation_px, 1e-9));
    EXPECT_TRUE(MatrixNear(op.Apply(R, scale, planted.pose_in_body_m), op.target(), 1e-9));
  }
}

TEST(ProjectionOperator, ScaleIsTheFallbackWhereNothingDecidesIt) {
  std::mt19937_64 rng = TestRng();
  const auto dictionary = testing::RandomDictionary(30, &rng);
  const auto planted = testing::PlantPose(dictionary, 4, &rng);
  const ProjectionOperator in_picture(testing::ObserveInPicture(planted, 2.0));
  const ProjectionOperator in_space(testing::ObserveInSpace(planted, 0.01));
  const Eigen::Matrix3d R = planted.camera.cam_from_body;
  const Eigen::Matrix3Xd points = in_picture.CentredPoints(planted.pose_in_body_m);
  EXPECT_EQ(in_space.BestScale_px_per_m(R, points, 7.0), 7.0);
  EXPECT_EQ(in_picture.BestScale_px_per_m(R, 0.0 * points, 7.0), 7.0);
  EXPECT_EQ(in_picture.BestScale_px_per_m(R, -points, 7.0), 7.0);  // no scale below zero
}

// The paper's P: 0 or 1 for each coordinate of each joint, the root at the origin.
TEST(ProjectionOperator, OfWholeJointsIsThePapersMask) {
  std::mt19937_64 rng = TestRng();
  const Eigen::VectorXd y = RandomMatrix(kNumbers, 1, &rng);
  Observation observation = ObservePose(Unstacked(y), 1.0);
  observation.points.resize(5);
  const ProjectionOperator op(observation);
  const Eigen::VectorXd rows = op.Apply(Eigen::Matrix3d::Identity(), 1.0, y);
  const Eigen::Matrix3Xd seen = Unstacked(y).leftCols(5);
  EXPECT_TRUE(MatrixNear(rows.reshaped(3, 5), seen.colwise() - seen.rowwise().mean(), 1e-13));
  EXPECT_TRUE(MatrixNear(op.target(), rows, 1e-13));
}

TEST(ProjectionOperator, CountsItsRows) {
  std::mt19937_64 rng = TestRng();
  const ProjectionOperator op(RandomMixture(&rng));
  EXPECT_EQ(op.NumPoints(), 7);
  EXPECT_EQ(op.Num2D(), 3);
  EXPECT_EQ(op.NumRows(), 3 * 2 + 4 * 3);
  EXPECT_TRUE(op.Has2D());
  EXPECT_TRUE(op.Has3D());
}

TEST(ProjectionOperator, AJointNamedTwiceInALandmarkCountsTwice) {
  std::mt19937_64 rng = TestRng();
  Observation observation = RandomMixture(&rng);
  observation.points[0].parts = {{3, 1.0}};
  const Eigen::VectorXd y = RandomMatrix(kNumbers, 1, &rng);
  const ProjectionOperator once(observation);
  observation.points[0].parts = {{3, 0.25}, {3, 0.75}};
  EXPECT_TRUE(
      MatrixNear(ProjectionOperator(observation).CentredPoints(y), once.CentredPoints(y), 1e-12));
}

}  // namespace
}  // namespace poselift
