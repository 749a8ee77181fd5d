// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/choose_alternatives.h"

#include <gtest/gtest.h>

namespace poselift {
namespace {

// A pose whose joints are all at depth z, and what it costs.
LiftedPose PoseAt(double z_m, double cost) {
  LiftedPose pose;
  pose.joints_in_cam_m = Pose3::Zero(3, kNumJoints);
  pose.joints_in_cam_m.row(2).setConstant(z_m);
  pose.cost = cost;
  return pose;
}

LiftResult Frame(std::vector<LiftedPose> poses) {
  LiftResult frame;
  frame.poses = std::move(poses);
  return frame;
}

TEST(ChooseAlternatives, AFlipOfOneFrameIsNotFollowed) {
  // The third frame likes its flip a little better.
  std::vector<LiftResult> frames(5, Frame({PoseAt(0.2, 1.0), PoseAt(-0.2, 3.0)}));
  frames[2] = Frame({PoseAt(-0.2, 1.0), PoseAt(0.2, 3.0)});
  EXPECT_EQ(ChooseAlternatives(frames, 1.0 / 30.0), (std::vector<int>{0, 0, 1, 0, 0}));
}

TEST(ChooseAlternatives, WithTimeEnoughAFrameMayBeAnother) {
  std::vector<LiftResult> frames(3, Frame({PoseAt(0.2, 1.0), PoseAt(-0.2, 30.0)}));
  frames[1] = Frame({PoseAt(-0.2, 1.0), PoseAt(0.2, 30.0)});
  EXPECT_EQ(ChooseAlternatives(frames, 10.0), (std::vector<int>{0, 0, 0}));
}

TEST(ChooseAlternatives, PassesOverFramesWithoutAny) {
  std::vector<LiftResult> frames(4, Frame({PoseAt(-0.2, 1.0), PoseAt(0.2, 0.5)}));
  frames[0] = frames[2] = {};
  EXPECT_EQ(ChooseAlternatives(frames, 1.0 / 30.0), (std::vector<int>{-1, 1, -1, 1}));
  EXPECT_EQ(ChooseAlternatives({{}, {}}, 1.0), (std::vector<int>{-1, -1}));
}

// Against all combinations.
TEST(ChooseAlternatives, IsTheBestOfAllWays) {
  std::vector<LiftResult> frames;
  for (int t = 0; t < 6; ++t)
    frames.push_back(Frame({PoseAt(0.03 * t, 1.0 + (t * 7) % 5), PoseAt(-0.05 * t, (t * 3) % 4),
                            PoseAt(0.1 - 0.02 * t, 2.0)}));
  const double frame_time_s = 1.0 / 30.0, drift = 0.7;
  const auto cost_of = [&](const std::vector<int>& way) {
    double cost = 0.0;
    for (size_t t = 0; t < way.size(); ++t) {
      const LiftedPose& now = frames[t].poses[static_cast<size_t>(way[t])];
      cost += now.cost;
      if (t == 0) continue;
      const LiftedPose& before = frames[t - 1].poses[static_cast<size_t>(way[t - 1])];
      cost += (now.joints_in_cam_m - before.joints_in_cam_m).squaredNorm() / (drift * frame_time_s);
    }
    return cost;
  };
  const double found = cost_of(ChooseAlternatives(frames, frame_time_s, drift));
  for (int code = 0; code < 729; ++code) {
    std::vector<int> way;
    for (int t = 0, rest = code; t < 6; ++t, rest /= 3) way.push_back(rest % 3);
    EXPECT_GE(cost_of(way), found - 1e-9);
  }
}

}  // namespace
}  // namespace poselift
