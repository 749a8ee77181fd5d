// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up walks of known path and heading.
#include "src/testing/studio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift::testing {
namespace {

using Eigen::Vector3d;

// Straight along a heading, 1.2 m/s, swaying sideways by 3 cm.
Motion Walk(double heading_rad) {
  Motion motion{TrimmedCmuLikeSkeleton(), 1.0 / 60.0, {}};
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(heading_rad, Vector3d::UnitY()));
  for (int t = 0; t < 240; ++t) {
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    const double sway_m = 0.03 * std::sin(2.0 * std::numbers::pi * t / 60.0);
    pose.root_in_world_m = turn * Vector3d(sway_m, 0.95, 1.2 * t / 60.0);
    pose.world_from_root = turn;
    motion.frames.push_back(pose);
  }
  return motion;
}

TEST(StudioTest, AWalkOnTheSpotKeepsItsSwayAndItsHeight) {
  const Motion spot = OnTheSpot(Walk(0.0));
  for (int t = 30; t + 30 < 240; ++t) {  // a whole second is known on both sides
    const double sway_m = 0.03 * std::sin(2.0 * std::numbers::pi * t / 60.0);
    EXPECT_TRUE(MatrixNear(spot.frames[t].root_in_world_m, Vector3d(sway_m, 0.95, 0.0), 2e-3));
  }
  for (const SkeletonPose& pose : spot.frames) EXPECT_NEAR(pose.root_in_world_m.z(), 0.0, 1e-9);
}

TEST(StudioTest, TheCameraStandsLevelBeforeTheBody) {
  for (const double heading_rad : {0.0, 0.7, -2.5}) {
    const Motion spot = OnTheSpot(Walk(heading_rad));
    const PlacedCamera placed = CameraBefore(spot, 3.0);
    const Vector3d pelvis_in_cam_m = placed.cam_from_world * Vector3d(0, 0.95, 0);
    EXPECT_TRUE(MatrixNear(pelvis_in_cam_m, Vector3d(0, 0, 3), 0.01));
    const Eigen::Matrix3d cam_from_world = placed.cam_from_world.linear();
    EXPECT_TRUE(MatrixNear(cam_from_world * Vector3d::UnitY(), Vector3d(0, -1, 0), 1e-9));
    // The body's left is seen on the right.
    const Vector3d left = spot.frames[0].world_from_root * Vector3d::UnitX();
    EXPECT_GT((cam_from_world * left).x(), 0.99);
  }
}

TEST(StudioTest, TheCameraGoesAroundToTheLeft) {
  const PlacedCamera placed = CameraBefore(OnTheSpot(Walk(0.0)), 2.0, std::numbers::pi / 2);
  EXPECT_TRUE(
      MatrixNear(placed.cam_from_world.inverse().translation(), Vector3d(2, 0.95, 0), 0.01));
}

TEST(StudioTest, PosesComeAtAnyTime) {
  const Motion walk = Walk(0.0);
  const auto pose_at = PosesOver(walk);
  EXPECT_TRUE(MatrixNear(pose_at(1.0).root_in_world_m, walk.frames[60].root_in_world_m, 1e-9));
  EXPECT_NEAR(pose_at(1.0 + 0.5 / 60).root_in_world_m.z(), 1.21, 1e-9);
  EXPECT_EQ(pose_at(-1.0).root_in_world_m, walk.frames.front().root_in_world_m);
  EXPECT_EQ(pose_at(100.0).root_in_world_m, walk.frames.back().root_in_world_m);
}

TEST(StudioTest, MotionsWithoutFramesAreRefused) {
  const Motion empty{TrimmedCmuLikeSkeleton(), 1.0 / 60.0, {}};
  EXPECT_THROW(PosesOver(empty), InputError);
  EXPECT_THROW(CameraBefore(empty, 3.0), InputError);
  EXPECT_TRUE(OnTheSpot(empty).frames.empty());
}

TEST(StudioTest, TheWebcamIsAValidOne) { EXPECT_EQ(Webcam().Validate(), ""); }

}  // namespace
}  // namespace poselift::testing
