// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/made_up_asf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/forward_kinematics.h"

namespace poselift::testing {

Motion RandomMotion(const Skeleton& skeleton, int num_frames, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  const int num_curves = 6 + skeleton.NumDofs();
  Eigen::MatrixXd waves(num_curves, 3);  // size, speed, phase
  for (double& value : waves.reshaped()) value = normal(*rng);
  Motion motion{skeleton, 1.0 / 60.0, {}};
  for (int f = 0; f < num_frames; ++f) {
    const Eigen::VectorXd curves =
        1.5 * waves.col(0).array() * (0.2 * f * waves.col(1).array() + waves.col(2).array()).sin();
    SkeletonPose pose;
    pose.root_in_world_m = curves.head<3>();
    const Eigen::Vector3d turn = 2.0 * curves.segment<3>(3);
    pose.world_from_root = Eigen::AngleAxisd(turn.norm(), turn.normalized());
    pose.dofs = curves.tail(skeleton.NumDofs());
    motion.frames.push_back(pose);
  }
  return motion;
}

void ExpectSamePlaces(const Motion& a, const Motion& b, double tolerance_m) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  EXPECT_NEAR(a.frame_time_s, b.frame_time_s, 1e-9);
  BoneFrames frames_a, frames_b;
  size_t num_compared = 0;
  for (size_t f = 0; f < a.frames.size(); ++f) {
    ForwardKinematics(a.skeleton, a.frames[f], &frames_a);
    ForwardKinematics(b.skeleton, b.frames[f], &frames_b);
    for (int i = 0; i < static_cast<int>(a.skeleton.bones.size()); ++i) {
      const auto j = b.skeleton.FindBone(a.skeleton.bones[i].name);
      if (!j) continue;
      ++num_compared;
      EXPECT_LT((frames_a.start_in_world_m.col(i) - frames_b.start_in_world_m.col(*j)).norm(),
                tolerance_m)
          << "start of " << a.skeleton.bones[i].name << ", frame " << f;
      if (i > 0) {
        EXPECT_LT((frames_a.tip_in_world_m.col(i) - frames_b.tip_in_world_m.col(*j)).norm(),
                  tolerance_m)
            << "tip of " << a.skeleton.bones[i].name << ", frame " << f;
      }
    }
  }
  EXPECT_GE(num_compared, 2 * a.frames.size());
}

}  // namespace poselift::testing
