// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A planted pose before a pinhole camera that is near enough for it to matter.
#include "lift/perspective.h"

#include <gtest/gtest.h>

#include "lift/eval/pose_error.h"
#include "lift/lift_photo.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomDictionary;
using testing::RandomMatrix;
using testing::RandomPoseWithinLimits;
using testing::TestRng;

const Pinhole kPinhole{800.0, {320.0, 240.0}};

Eigen::Vector2d Seen(const Eigen::Vector3d& x_in_cam_m) {
  return kPinhole.centre_px + kPinhole.focal_px * x_in_cam_m.head<2>() / x_in_cam_m.z();
}

// The weak-perspective camera that has the pelvis where it is.
WeakCamera CameraOf(const Eigen::Vector3d& pelvis_in_cam_m) {
  WeakCamera camera;
  camera.scale_px_per_m = kPinhole.focal_px / pelvis_in_cam_m.z();
  camera.translation_px = Seen(pelvis_in_cam_m);
  return camera;
}

Observation Observe(const Pose3& joints_in_cam_m, const Eigen::Vector3d& pelvis_in_cam_m) {
  Observation observation{{}, {}, kPinhole};
  for (const Landmark& landmark : FindLayout("body15")->landmarks) {
    ObservedPoint point{.name = std::string(landmark.name), .parts = landmark.parts, .sigma = 4.0};
    point.x << Seen(pelvis_in_cam_m + SumOfJoints(point.parts, joints_in_cam_m)), 0.0;
    observation.points.push_back(point);
  }
  return observation;
}

void ExpectDistinct(const std::vector<LiftedPose>& poses, double distinct_m) {
  for (size_t a = 0; a < poses.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      EXPECT_GE((poses[a].joints_in_cam_m - poses[b].joints_in_cam_m).norm(),
                distinct_m * std::sqrt(kNumJoints));
}

TEST(Perspective, OfTheTrueDepthsIsExactlyAWeakPerspectivePicture) {
  auto rng = TestRng();
  const Eigen::Vector3d pelvis_m(0.3, -0.4, 2.5);
  Pose3 joints_m = 0.3 * RandomMatrix(3, kNumJoints, &rng);
  joints_m.col(0).setZero();
  const WeakCamera camera = CameraOf(pelvis_m);
  const Observation seen = Observe(joints_m, pelvis_m);
  const Observation weak = AsWeakPerspective(seen, joints_m, camera);
  EXPECT_FALSE(weak.pinhole);
  ASSERT_EQ(weak.points.size(), seen.points.size());
  for (size_t i = 0; i < weak.points.size(); ++i) {
    const Eigen::Vector3d x_m = SumOfJoints(seen.points[i].parts, joints_m);
    EXPECT_TRUE(MatrixNear(weak.points[i].x.head<2>(), camera.Project(x_m), 1e-9));
    EXPECT_NEAR(weak.points[i].sigma, seen.points[i].sigma * (1 + x_m.z() / 2.5), 1e-12);
  }
}

TEST(Perspective, ProjectsAsThePinholeDoes) {
  auto rng = TestRng();
  const Eigen::Vector3d pelvis_m(-0.5, 0.2, 3.0);
  const Pose3 joints_m = 0.4 * RandomMatrix(3, kNumJoints, &rng);
  const WeakCamera camera = CameraOf(pelvis_m);
  EXPECT_TRUE(MatrixNear(PelvisInCam_m(kPinhole, camera), pelvis_m, 1e-12));
  const Eigen::Matrix2Xd x_px = ProjectInPerspective(kPinhole, camera, joints_m);
  for (int j = 0; j < kNumJoints; ++j)
    EXPECT_TRUE(MatrixNear(x_px.col(j), Seen(pelvis_m + joints_m.col(j)), 1e-9));
}

TEST(Perspective, StaysFiniteForPointsBehindTheCamera) {
  const WeakCamera camera = CameraOf({0.0, 0.0, 1.0});
  const Eigen::Matrix3Xd behind = Eigen::Vector3d(0.1, 0.1, -5.0);
  EXPECT_TRUE(ProjectInPerspective(kPinhole, camera, behind).allFinite());
}

// The atoms are poses of the skeleton, and the planted pose is one of them.
TEST(Perspective, AKnownCameraMakesTheLiftOfANearBodyBetter) {
  auto rng = TestRng();
  Dictionary dictionary = RandomDictionary(40, &rng);
  Eigen::MatrixXd poses_m(69, 40);
  for (auto column : poses_m.colwise())
    column = Stacked(
        JointPositions(dictionary.skeleton,
                       {.dofs = RandomPoseWithinLimits(dictionary.skeleton, 0.5, &rng).dofs}));
  dictionary.atoms = poses_m.colwise().normalized();
  dictionary.prior = LearnPosePrior(poses_m);
  const PhotoLifter lifter(dictionary);
  double error_weak_mm = 0.0, error_mm = 0.0;
  for (int trial = 0; trial < 12; ++trial) {
    const Pose3 joints_m = CamFromBody({0.1, 0.5 * trial, 0.0}) * Unstacked(poses_m.col(trial));
    const Eigen::Vector3d pelvis_m(0.2, -0.1, 2.0);
    Observation observation = Observe(joints_m, pelvis_m);
    const LiftResult in_perspective = lifter.LiftPhoto(observation);
    observation.pinhole.reset();
    const LiftResult weak = lifter.LiftPhoto(observation);
    ASSERT_TRUE(in_perspective.IsUsable() && weak.IsUsable());
    error_mm += PaError_mm(in_perspective.poses[0].joints_in_cam_m, joints_m) / 12;
    error_weak_mm += PaError_mm(weak.poses[0].joints_in_cam_m, joints_m) / 12;
    EXPECT_NEAR(in_perspective.poses[0].pelvis_in_cam_m.z(), 2.0, 0.3);
    ExpectDistinct(in_perspective.poses, LifterOptions().distinct_m);
    ExpectDistinct(weak.poses, LifterOptions().distinct_m);
    EXPECT_FALSE(weak.poses[0].pelvis_in_cam_m.allFinite());
  }
  EXPECT_LT(error_mm, 0.7 * error_weak_mm);
}

}  // namespace
}  // namespace poselift
