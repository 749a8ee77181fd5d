// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk before a fixed camera: the labels' noise and gaps are measured.
#include "lift/eval/synthetic_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift/rotation.h"
#include "src/forward_kinematics.h"
#include "src/units.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;

const Layout& Joints23() { return *FindLayout("joints23"); }

Motion Walk() { return testing::PlantWalk(120, 0.6, 0.0).motion; }

SequenceView View(double noise_px, double missing_share, unsigned seed = 7) {
  std::mt19937_64 rng(seed);
  return MakeSequenceView(Walk(), Joints23(),
                          {.noise_px = noise_px, .missing_share = missing_share}, &rng);
}

TEST(SequenceView, CleanLabelsAreTheWalkBeforeOneCamera) {
  const SequenceView view = View(0.0, 0.0);
  const Motion walk = Walk();
  const Eigen::Vector3d tau_deg = TauFromRotation(view.cam_from_world) * kDegFromRad;
  EXPECT_GE(tau_deg.x(), -10.0);
  EXPECT_LE(tau_deg.x(), 20.0);
  EXPECT_LE(std::abs(tau_deg.z()), 3.0);
  const Pose3 rest = JointPositions(walk.skeleton, SkeletonPose::Rest(walk.skeleton));
  const double scale_px_per_m = 300.0 / (rest.row(1).maxCoeff() - rest.row(1).minCoeff());
  ASSERT_EQ(view.labels.size(), walk.frames.size());
  for (size_t t = 0; t < walk.frames.size(); ++t) {
    const Pose3 in_cam_m = view.cam_from_world * JointPositions(walk.skeleton, walk.frames[t]);
    EXPECT_TRUE(MatrixNear(view.joints_in_cam_m[t],
                           in_cam_m.colwise() - in_cam_m.col(joint::kPelvis), 1e-12));
    for (int j = 0; j < kNumJoints; ++j)  // the root's path is in the picture
      EXPECT_TRUE(MatrixNear(view.labels[t].landmarks[static_cast<size_t>(j)].x_px,
                             scale_px_per_m * in_cam_m.col(j).head<2>(), 1e-9));
  }
}

TEST(SequenceView, NoiseAndGapsAreAsLargeAsAskedFor) {
  const SequenceView clean = View(0.0, 0.1), noisy = View(5.0, 0.1);
  double squared = 0.0, count = 0.0, missing = 0.0;
  for (size_t t = 0; t < clean.labels.size(); ++t)
    for (size_t i = 0; i < kNumJoints; ++i) {
      const LandmarkLabel& label = noisy.labels[t].landmarks[i];
      squared += (label.x_px - clean.labels[t].landmarks[i].x_px).squaredNorm();
      missing += label.state == LabelState::kAbsent ? 1.0 : 0.0;
      EXPECT_EQ(label.state, clean.labels[t].landmarks[i].state);
      ++count;
    }
  EXPECT_NEAR(std::sqrt(squared / (2.0 * count)), 5.0, 0.2);  // 5520 numbers: sigma 0.05
  EXPECT_NEAR(missing / count, 0.1, 0.02);                    // 2760 labels: sigma 0.006
}

TEST(SequenceView, NoiseGrowsWithItsSizeAloneAndTheSeedDecidesTheView) {
  const SequenceView clean = View(0.0, 0.1), some = View(2.0, 0.1), more = View(4.0, 0.1);
  for (size_t i = 0; i < kNumJoints; ++i)
    EXPECT_TRUE(MatrixNear(more.labels[9].landmarks[i].x_px - some.labels[9].landmarks[i].x_px,
                           some.labels[9].landmarks[i].x_px - clean.labels[9].landmarks[i].x_px,
                           1e-9));
  EXPECT_EQ(some.cam_from_world, more.cam_from_world);
  EXPECT_FALSE(MatrixNear(View(2.0, 0.1, 8).cam_from_world, some.cam_from_world, 1e-3));
}

}  // namespace
}  // namespace poselift
