// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A planted pose of the made-up CMU skeleton seen by a planted camera, labels
// through a real layout, with and without noise; priors that are the truth,
// disturbed, or wrong.
#include "lift/ik/pose_refinement.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "lift/normalize.h"
#include "src/input_error.h"
#include "src/units.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomPoseWithinLimits;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

struct Scene {
  Skeleton skeleton = TrimmedCmuLikeSkeleton();
  SkeletonPose pose;
  Pose3 joints_in_cam_m;
  WeakCamera camera;
};

// Standing, bent at random, about facing the camera.
Scene RandomScene(std::mt19937_64* rng) {
  Scene scene;
  scene.pose = RandomPoseWithinLimits(scene.skeleton, 0.5, rng);
  scene.pose.root_in_world_m.setZero();
  scene.pose.world_from_root = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY());
  scene.joints_in_cam_m = JointPositions(scene.skeleton, scene.pose);
  scene.camera.scale_px_per_m = 183.0;
  scene.camera.translation_px << 320.0, 240.0;
  return scene;
}

Observation Seen(const Scene& scene, const char* layout, double sigma_px) {
  const Eigen::Matrix2Xd x_px = scene.camera.Project(scene.joints_in_cam_m);
  Observation observation;
  for (const Landmark& landmark : FindLayout(layout)->landmarks) {
    if (landmark.parts.empty()) continue;
    ObservedPoint point{.name = std::string(landmark.name), .parts = landmark.parts};
    point.sigma = sigma_px;
    for (const Landmark::Part& part : landmark.parts)
      point.x.head<2>() += part.weight * x_px.col(part.joint);
    observation.points.push_back(point);
  }
  return observation;
}

Pose3 Disturbed(const Pose3& pose, double sigma_m, std::mt19937_64* rng) {
  std::normal_distribution<double> normal(0.0, sigma_m);
  Pose3 disturbed = pose;
  for (int j = 1; j < kNumJoints; ++j)
    for (double& x : disturbed.col(j)) x += normal(*rng);
  return disturbed;
}

double Rms(const Pose3& a, const Pose3& b) { return (a - b).norm() / std::sqrt(kNumJoints); }

TEST(PoseRefinement, FindsThePlantedPoseAndCamera) {
  auto rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = RandomScene(&rng);
    const PoseRefinement refinement(scene.skeleton);
    const RefinementResult result =
        refinement.Solve(scene.joints_in_cam_m, Seen(scene, "openpose25", 1.0));
    ASSERT_EQ(result.status, IkStatus::kConverged) << result.message;
    EXPECT_TRUE(MatrixNear(result.joints_in_cam_m, scene.joints_in_cam_m, 5e-3));
    EXPECT_NEAR(result.camera.scale_px_per_m, 183.0, 0.5);
    EXPECT_TRUE(MatrixNear(result.camera.translation_px, Eigen::Vector2d(320.0, 240.0), 0.5));
    EXPECT_LT(result.reprojection_rms_px, 0.1);
    EXPECT_LT(result.code_rms_m, 2e-3);
  }
}

TEST(PoseRefinement, BoneLengthsHoldExactlyUnderAnyLabelsAndPrior) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const PoseRefinement refinement(scene.skeleton);
  Observation wild = Seen(scene, "body15", 2.0);
  for (ObservedPoint& point : wild.points) point.x.x() *= 1.5;
  const RefinementResult result =
      refinement.Solve(Disturbed(scene.joints_in_cam_m, 0.1, &rng), wild);
  ASSERT_TRUE(IsUsable(result.status));
  const Eigen::VectorXd lengths_m = BoneLengths(scene.skeleton);
  for (int j = 1; j < kNumJoints; ++j)
    EXPECT_NEAR(
        (result.joints_in_cam_m.col(j) - result.joints_in_cam_m.col(Joints()[j].parent)).norm(),
        lengths_m[j], 1e-12);
  EXPECT_TRUE(MatrixNear(result.joints_in_cam_m.col(joint::kPelvis), Eigen::Vector3d::Zero(), 0.0));
}

TEST(PoseRefinement, LabelsCorrectADisturbedPrior) {
  auto rng = TestRng();
  double prior_sum = 0.0, refined_sum = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene = RandomScene(&rng);
    const Pose3 prior = Disturbed(scene.joints_in_cam_m, 0.05, &rng);
    const RefinementResult result =
        PoseRefinement(scene.skeleton).Solve(prior, Seen(scene, "joints23", 1.0));
    ASSERT_TRUE(IsUsable(result.status));
    prior_sum += Rms(prior, scene.joints_in_cam_m);
    refined_sum += Rms(result.joints_in_cam_m, scene.joints_in_cam_m);
  }
  EXPECT_LT(refined_sum, 0.6 * prior_sum);
}

TEST(PoseRefinement, GammaTradesThePriorAgainstTheLabels) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const Pose3 prior = RandomScene(&rng).joints_in_cam_m;  // another pose: they disagree
  const Observation seen = Seen(scene, "joints23", 3.0);
  double code_rms_m = 1e9, reprojection_rms_px = 0.0;
  for (const double gamma : {1.0, 100.0, 1e4, 1e6}) {
    const RefinementResult result =
        PoseRefinement(scene.skeleton, {.gamma_per_m2 = gamma}).Solve(prior, seen);
    ASSERT_TRUE(IsUsable(result.status));
    EXPECT_LT(result.code_rms_m, code_rms_m);
    EXPECT_GT(result.reprojection_rms_px, reprojection_rms_px);
    code_rms_m = result.code_rms_m;
    reprojection_rms_px = result.reprojection_rms_px;
  }
  EXPECT_LT(code_rms_m, 2e-3);
}

// Poses of one kind, labels with noise, a code that is a little off: what the
// labels do not show comes from what such poses have in common.
TEST(PoseRefinement, PriorKeepsNoiseOfTheLabelsOutOfTheDepth) {
  auto rng = TestRng();
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  Eigen::MatrixXd poses_m(69, 400);
  for (auto column : poses_m.colwise()) {
    const SkeletonPose pose = RandomPoseWithinLimits(skeleton, 0.15, &rng);
    column = Stacked(JointPositions(skeleton, {.dofs = pose.dofs}));
  }
  const PoseRefinement without(skeleton, {.prior_weight = 0.0});
  const PoseRefinement with(skeleton, {.prior_weight = 1.0}, LearnPosePrior(poses_m));
  double error_without_m = 0.0, error_with_m = 0.0;
  std::normal_distribution<double> normal(0.0, 4.0);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = RandomScene(&rng);
    scene.pose.dofs = RandomPoseWithinLimits(skeleton, 0.15, &rng).dofs;
    scene.joints_in_cam_m = JointPositions(skeleton, scene.pose);
    Observation observation = Seen(scene, "body15", 4.0);
    for (ObservedPoint& point : observation.points)
      point.x += Eigen::Vector3d(normal(rng), normal(rng), 0.0);
    const Pose3 code_m = Disturbed(scene.joints_in_cam_m, 0.05, &rng);
    error_without_m +=
        Rms(without.Solve(code_m, observation).joints_in_cam_m, scene.joints_in_cam_m) / 20;
    error_with_m +=
        Rms(with.Solve(code_m, observation).joints_in_cam_m, scene.joints_in_cam_m) / 20;
  }
  EXPECT_LT(error_with_m, 0.8 * error_without_m);
}

TEST(PoseRefinement, RefusesAPriorOfJointsThatTheSkeletonLacks) {
  auto rng = TestRng();
  Skeleton skeleton = TrimmedCmuLikeSkeleton();
  skeleton.bones.pop_back();
  const PosePrior prior = LearnPosePrior(testing::RandomMatrix(69, 5, &rng));
  EXPECT_THROW(PoseRefinement(skeleton, {}, prior), std::invalid_argument);
}

TEST(PoseRefinement, SharperLabelsAreMetCloser) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const Pose3 prior = Disturbed(scene.joints_in_cam_m, 0.05, &rng);
  const PoseRefinement refinement(scene.skeleton);
  EXPECT_LT(refinement.Solve(prior, Seen(scene, "body15", 1.0)).reprojection_rms_px,
            refinement.Solve(prior, Seen(scene, "body15", 20.0)).reprojection_rms_px);
}

TEST(PoseRefinement, JointsSeenInSpaceCountUpToACommonShift) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const Pose3 prior = Disturbed(scene.joints_in_cam_m, 0.05, &rng);
  const PoseRefinement refinement(scene.skeleton);
  const Pose3 shifted = scene.joints_in_cam_m.colwise() + Eigen::Vector3d(0.3, -0.2, 4.0);
  const RefinementResult result = refinement.Solve(prior, ObservePose(shifted, 0.001));
  ASSERT_TRUE(IsUsable(result.status));
  EXPECT_FALSE(result.has_camera);
  EXPECT_TRUE(MatrixNear(result.joints_in_cam_m, scene.joints_in_cam_m, 2e-3));
}

TEST(PoseRefinement, WithoutObservationsItIsInverseKinematicsOnThePrior) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const RefinementResult result =
      PoseRefinement(scene.skeleton).Solve(scene.joints_in_cam_m, Observation());
  EXPECT_EQ(result.status, IkStatus::kConverged);
  EXPECT_TRUE(MatrixNear(result.joints_in_cam_m, scene.joints_in_cam_m, 2e-3));
}

TEST(PoseRefinement, KeepsToTheLimits) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  Observation wild = Seen(scene, "body15", 0.5);
  for (ObservedPoint& point : wild.points) point.x.y() *= 0.5;
  const auto excess_rad = [&](bool enforce_limits) {
    const RefinementResult result =
        PoseRefinement(scene.skeleton, {.enforce_limits = enforce_limits})
            .Solve(scene.joints_in_cam_m, wild);
    const Articulation body(scene.skeleton);
    const Eigen::VectorXd inside = DofLimits(body, true).Clamp(result.pose.dofs);
    return (result.pose.dofs - inside).cwiseAbs().maxCoeff();
  };
  EXPECT_EQ(excess_rad(true), 0.0);
  EXPECT_GT(excess_rad(false), 1 * kRadFromDeg);
}

TEST(PoseRefinement, AnswersDegenerateInputsWithAStatusAndNoNaN) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const PoseRefinement refinement(scene.skeleton);
  Observation one_place = Seen(scene, "body15", 1.0);
  for (ObservedPoint& point : one_place.points) point.x << 50.0, 60.0, 0.0;
  Observation one_point = Seen(scene, "body15", 1.0);
  one_point.points.resize(1);
  const Pose3 none = Pose3::Constant(3, kNumJoints, std::numeric_limits<double>::quiet_NaN());
  const Observation seen = Seen(scene, "body15", 1.0);
  EXPECT_EQ(refinement.Solve(scene.joints_in_cam_m, one_place).status, IkStatus::kBadInput);
  EXPECT_EQ(refinement.Solve(scene.joints_in_cam_m, one_point).status, IkStatus::kBadInput);
  EXPECT_EQ(refinement.Solve(none, seen).status, IkStatus::kBadInput);
  EXPECT_THAT(refinement.Solve(none, seen).BriefReport(), ::testing::HasSubstr("the code's pose"));
  const auto scaled_by = [&](double factor) {
    Observation scaled = seen;
    for (ObservedPoint& point : scaled.points) point.x *= factor;
    return refinement.Solve(scene.joints_in_cam_m, scaled);
  };
  EXPECT_FALSE(IsUsable(scaled_by(1e300).status));
  for (const double factor : {1e-9, 1e12}) {
    const RefinementResult result = scaled_by(factor);
    EXPECT_TRUE(IsUsable(result.status)) << result.message;
    EXPECT_TRUE(result.joints_in_cam_m.allFinite());
    EXPECT_TRUE(std::isfinite(result.reprojection_rms_px));
    EXPECT_NEAR(result.camera.scale_px_per_m / (183.0 * factor), 1.0, 0.01);
  }
}

// Labels turned by half a turn under a prior that may not follow.
TEST(PoseRefinement, NeverAnswersWithAScaleOfZero) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  Observation turned = Seen(scene, "body15", 1.0);
  for (ObservedPoint& point : turned.points) point.x *= -1.0;
  const RefinementResult result =
      PoseRefinement(scene.skeleton, {.gamma_per_m2 = 1e9}).Solve(scene.joints_in_cam_m, turned);
  EXPECT_EQ(result.status, IkStatus::kFailed);
  EXPECT_THAT(result.message, ::testing::HasSubstr("contradict"));
}

TEST(PoseRefinement, LeavesOutPointsThatAreNotFiniteAndRefusesBadSigmas) {
  auto rng = TestRng();
  const Scene scene = RandomScene(&rng);
  const PoseRefinement refinement(scene.skeleton);
  Observation seen = Seen(scene, "body15", 1.0);
  seen.points[3].x.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LT(refinement.Solve(scene.joints_in_cam_m, seen).reprojection_rms_px, 0.1);
  seen.points[4].sigma = 0.0;
  EXPECT_THROW(refinement.Solve(scene.joints_in_cam_m, seen), std::invalid_argument);
  EXPECT_THROW(PoseRefinement(scene.skeleton, {.gamma_per_m2 = -1.0}), InputError);
  EXPECT_THROW(PoseRefinement(scene.skeleton, {.pull_per_rad = 0.0}), InputError);
}

}  // namespace
}  // namespace poselift
