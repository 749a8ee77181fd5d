// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Labels from the pose of somebody who wears tags: places by a camera with a lens, states by which
// tags are seen. And the rates of pictures whose times are made up.
#include "ui/live/live_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/support.h"
#include "ui/live/live_rates.h"

namespace poselift {
namespace {

const LandmarkLabel* Find(const std::vector<LandmarkLabel>& labels, std::string_view name) {
  const auto found = std::ranges::find(labels, name, &LandmarkLabel::name);
  return found == labels.end() ? nullptr : &*found;
}

class LiveViewTest : public ::testing::Test {
 protected:
  LiveViewTest() {
    person_.status = "ok";
    person_.joints_in_cam_m = 0.3 * Pose3::Random(3, kNumJoints);
    person_.joints_in_cam_m.col(0).setZero();
    person_.pelvis_in_cam_m << 0.1, -0.2, 3.0;
    tags_.tags = {{.id = 1, .on_joint = TagOnJoint{.joint = "left_knee"}},
                  {.id = 2, .on_bone = TagOnBone{.bone = "rtibia"}},
                  {.id = 3, .on_joint = TagOnJoint{.joint = "head_top"}}};
    person_.tags = {{.id = 1}, {.id = 2}, {.id = 3, .believed = false}};
    camera_.distortion.k1 = -0.1;
  }

  PersonPose person_;
  BodyTags tags_;
  Camera camera_{640, 480, 500.0, 500.0, 319.5, 239.5};
};

TEST_F(LiveViewTest, LandmarksAreWhereTheCameraSeesThem) {
  const auto pose = LivePoseOf(person_, tags_, camera_, -Eigen::Vector3d::UnitY());
  ASSERT_TRUE(pose);
  const auto labels = LabelsOf(*pose, *FindLayout("joints23"));
  ASSERT_EQ(labels.size(), 23U);
  const Eigen::Matrix2Xd joints_px = pose->JointsInPicture_px();
  for (int j = 0; j < kNumJoints; ++j) {
    const Eigen::Vector2d wanted_px =
        camera_.Project(person_.joints_in_cam_m.col(j) + person_.pelvis_in_cam_m);
    EXPECT_EQ(labels[static_cast<size_t>(j)].x_px, wanted_px);
    EXPECT_EQ(joints_px.col(j), wanted_px);
  }
}

TEST_F(LiveViewTest, JointsOfTagsThatFitAreVisibleOthersGuessed) {
  const auto pose = LivePoseOf(person_, tags_, camera_, -Eigen::Vector3d::UnitY());
  const auto labels = LabelsOf(*pose, *FindLayout("joints23"));
  for (const char* name : {"left_knee", "left_hip", "right_knee", "right_ankle"})
    EXPECT_EQ(Find(labels, name)->state, LabelState::kVisible) << name;
  for (const char* name : {"head_top", "left_wrist", "left_ankle"})
    EXPECT_EQ(Find(labels, name)->state, LabelState::kOccluded) << name;
}

TEST_F(LiveViewTest, WhatIsOutsideThePictureHasNoLabel) {
  person_.joints_in_cam_m.col(joint::kLeftWrist) << 5.0, 0.0, 0.0;
  person_.joints_in_cam_m.col(joint::kRightWrist) << 0.0, 0.0, -4.0;  // behind the camera
  const auto pose = LivePoseOf(person_, tags_, camera_, -Eigen::Vector3d::UnitY());
  const auto labels = LabelsOf(*pose, *FindLayout("joints23"));
  EXPECT_EQ(Find(labels, "left_wrist"), nullptr);
  EXPECT_EQ(Find(labels, "right_wrist"), nullptr);
  EXPECT_NE(Find(labels, "left_knee"), nullptr);
}

TEST_F(LiveViewTest, NobodyKnownIsNoPose) {
  EXPECT_FALSE(LivePoseOf(PersonPose(), tags_, camera_, -Eigen::Vector3d::UnitY()));
}

TEST(LiveRates, AreOfTheLastTwoSeconds) {
  LiveRates rates;
  EXPECT_EQ(rates.Rate_hz(), 0.0);
  EXPECT_TRUE(std::isnan(rates.Latency_s()));
  for (int i = 0; i < 40; ++i) rates.Add(i * 0.1, i * 0.1 - 0.5);
  EXPECT_NEAR(rates.Rate_hz(), 10.0, 1e-6);
  EXPECT_NEAR(rates.Latency_s(), 0.5, 1e-9);
  for (int i = 0; i < 100; ++i) rates.Add(4.0 + i * 0.025, std::nan(""));
  EXPECT_NEAR(rates.Rate_hz(), 40.0, 1e-6);
  EXPECT_TRUE(std::isnan(rates.Latency_s()));
}

}  // namespace
}  // namespace poselift
