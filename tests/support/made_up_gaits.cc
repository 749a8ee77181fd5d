// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/made_up_gaits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/forward_kinematics.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift::testing {
namespace {

constexpr double kFrameTime_s = 1.0 / 60.0;
constexpr size_t kNumFirst = 4;

}  // namespace

MadeUpGaits::MadeUpGaits() {
  auto rng = TestRng();
  mixture_ = 0.15 * RandomMatrix(kNumAngles, 4, &rng);
}

Motion MadeUpGaits::Gait(int num_frames, double share) const {
  Motion motion{TrimmedCmuLikeSkeleton(), kFrameTime_s, {}};
  for (int t = 0; t < num_frames; ++t) {
    const double phase = 6.0 * t * kFrameTime_s + 6.0 * share;
    const Eigen::Vector4d waves(std::sin(phase), std::cos(phase), std::sin(2 * phase) * share,
                                share);
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    pose.dofs += mixture_ * waves;
    pose.root_in_world_m << 0.0, 0.9 + 0.03 * std::sin(2 * phase), 1.2 * t * kFrameTime_s;
    pose.world_from_root = Eigen::AngleAxisd(0.3 * std::sin(phase), Eigen::Vector3d::UnitY());
    motion.frames.push_back(pose);
  }
  return motion;
}

MotionDatabase MadeUpGaits::Database(int num_gaits, int num_frames) const {
  MotionDatabase database{TrimmedCmuLikeSkeleton(), kFrameTime_s, {}, {}};
  for (int i = 0; i < num_gaits; ++i)
    database.Append("gait", MotionFeatures(Gait(num_frames, (i + 0.5) / num_gaits)));
  return database;
}

std::vector<TargetPoint> ObserveHandAndFoot(const Motion& motion, size_t frame) {
  const Pose3 joints_m = JointPositions(motion.skeleton, motion.frames[frame]);
  std::vector<TargetPoint> observed;
  for (int j : {joint::kLeftHand, joint::kRightAnkle})
    observed.push_back({{{j, 1.0}}, joints_m.col(j), 200.0});
  return observed;
}

void ExpectToMoveAlong(const Motion& motion, MotionMethod* here, MotionMethod* there,
                       double tolerance) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d shift_m(3.0, 0.0, -2.0);
  Motion moved = motion;
  for (SkeletonPose& pose : moved.frames) {
    pose.world_from_root = turn * pose.world_from_root;
    pose.root_in_world_m = turn * pose.root_in_world_m + shift_m;
  }
  here->Begin({motion.frames.begin(), motion.frames.begin() + kNumFirst});
  there->Begin({moved.frames.begin(), moved.frames.begin() + kNumFirst});
  for (size_t t = kNumFirst; t < motion.frames.size(); ++t) {
    const SkeletonPose a = here->Next(ObserveHandAndFoot(motion, t));
    const SkeletonPose b = there->Next(ObserveHandAndFoot(moved, t));
    EXPECT_TRUE(MatrixNear(a.dofs, b.dofs, tolerance));
    EXPECT_TRUE(MatrixNear(turn * a.root_in_world_m + shift_m, b.root_in_world_m, tolerance));
  }
}

}  // namespace poselift::testing
