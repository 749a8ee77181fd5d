// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up motions that are hard on angles: bodies that turn round and round,
// shoulders that pass through gimbal lock, angles written with jumps of a turn.
// The filter is the real one; what it should do is known by symmetry.
#include "lift/baselines/motion_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lift/baselines/butterworth.h"
#include "lift/baselines/interpolation.h"
#include "src/dof_angles.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::DofOf;
using testing::ExpectSamePlaces;
using testing::MatrixNear;
using testing::RandomMotion;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kRate_hz = 60.0;

Motion AtRest(int num_frames) {
  Motion motion{TrimmedCmuLikeSkeleton(), 1.0 / kRate_hz, {}};
  motion.frames.assign(num_frames, SkeletonPose::Rest(motion.skeleton));
  return motion;
}

Motion Filtered(const Motion& motion, double cutoff_hz) {
  const MotionCurves curves(motion);
  return curves.ToMotion(ButterworthLowPass(curves.curves(), kRate_hz, {.cutoff_hz = cutoff_hz}));
}

double LargestStep(const Eigen::MatrixXd& curves) {
  return (curves.rightCols(curves.cols() - 1) - curves.leftCols(curves.cols() - 1))
      .cwiseAbs()
      .maxCoeff();
}

Eigen::MatrixXd DofsOf(const Motion& motion) {
  Eigen::MatrixXd dofs(motion.skeleton.NumDofs(), std::ssize(motion.frames));
  for (Eigen::Index t = 0; t < dofs.cols(); ++t) dofs.col(t) = motion.frames[t].dofs;
  return dofs;
}

TEST(MotionCurves, TheWayBackIsTheMotion) {
  auto rng = TestRng();
  for (const Skeleton& skeleton : {TrimmedCmuLikeSkeleton(), testing::CmuLikeSkeleton()}) {
    const Motion motion = RandomMotion(skeleton, 50, &rng);
    const MotionCurves curves(motion);
    const Motion back = curves.ToMotion(curves.curves());
    EXPECT_EQ(back.frame_time_s, motion.frame_time_s);
    ExpectSamePlaces(motion, back, 1e-9);
  }
}

TEST(MotionCurves, ABodyThatTurnsRoundAndRoundComesOutAsItWas) {
  Motion motion = AtRest(400);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()));
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    // Five turns; quaternions with signs as they happen to come.
    motion.frames[t].world_from_root =
        Eigen::AngleAxisd(std::numbers::pi * t / 40.0, Eigen::Vector3d(0.0, 0.8, 0.6)) * tilt;
    if (t % 7 < 3) motion.frames[t].world_from_root.coeffs() *= -1.0;
  }
  EXPECT_LT(LargestStep(MotionCurves(motion).curves()), 0.1);
  const Motion smooth = Filtered(motion, 2.0);
  for (size_t t = 60; t + 60 < motion.frames.size(); ++t)
    EXPECT_LT(smooth.frames[t].world_from_root.angularDistance(motion.frames[t].world_from_root),
              1e-5)
        << t;
}

TEST(MotionCurves, FilteringDoesNotDependOnTheWorldsAxes) {
  auto rng = TestRng();
  Motion motion = RandomMotion(TrimmedCmuLikeSkeleton(), 90, &rng);
  const Eigen::Quaterniond turn = testing::RandomRotation(&rng);
  Motion turned = motion;
  for (SkeletonPose& pose : turned.frames) {
    pose.root_in_world_m = turn * pose.root_in_world_m;
    pose.world_from_root = turn * pose.world_from_root;
  }
  const Motion smooth = Filtered(motion, 3.0);
  const Motion smooth_turned = Filtered(turned, 3.0);
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    EXPECT_LT((turn * smooth.frames[t].world_from_root)
                  .angularDistance(smooth_turned.frames[t].world_from_root),
              1e-7);
    EXPECT_TRUE(MatrixNear(smooth.frames[t].dofs, smooth_turned.frames[t].dofs, 1e-9));
  }
}

// The upper arm turns at an even rate along a path that leads almost through the
// lock, where its angles swing by pi within a few frames.
TEST(MotionCurves, GimbalLockDoesNotDisturbABallJoint) {
  Motion motion = AtRest(180);
  const int bone = *motion.skeleton.FindBone("lhumerus");
  const std::vector<Dof>& dofs = motion.skeleton.bones[bone].dofs;
  const int first = motion.skeleton.DofStarts()[bone];
  const auto rotation_at = [](size_t t) -> Eigen::Matrix3d {
    return (Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitX()) *
            Eigen::AngleAxisd(0.02 * t, Eigen::Vector3d::UnitY()))
        .toRotationMatrix();
  };
  for (size_t t = 0; t < motion.frames.size(); ++t)
    FitDofAngles(rotation_at(t), dofs, motion.frames[t].dofs.data() + first);  // each from 0
  EXPECT_GT(LargestStep(DofsOf(motion)), 0.4);

  Motion by_angles = motion;
  const Eigen::MatrixXd angles = ButterworthLowPass(DofsOf(motion), kRate_hz, {.cutoff_hz = 3.0});
  const Motion smooth = Filtered(motion, 3.0);
  double worst = 0.0, worst_by_angles = 0.0;
  for (size_t t = 40; t + 40 < motion.frames.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    worst = std::max(
        worst,
        AngleBetween(rotation_at(t), RotationOfDofs(dofs, smooth.frames[t].dofs.data() + first)));
    worst_by_angles = std::max(
        worst_by_angles,
        AngleBetween(rotation_at(t), RotationOfDofs(dofs, angles.col(column).data() + first)));
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(worst_by_angles, 0.01);
}

TEST(MotionCurves, JumpsOfAWholeTurnAreNoMovement) {
  Motion motion = AtRest(60);
  for (int t = 0; t < 60; ++t) {
    DofOf(motion.skeleton, "ltibia", Dof::Kind::kRx, &motion.frames[t]) = 0.01 * t;
    if (t >= 20 && t < 40)
      DofOf(motion.skeleton, "ltibia", Dof::Kind::kRx, &motion.frames[t]) += 2.0 * std::numbers::pi;
  }
  const MotionCurves curves(motion);
  EXPECT_LT(LargestStep(curves.curves()), 0.011);
  EXPECT_LT(LargestStep(DofsOf(curves.ToMotion(curves.curves()))), 0.011);
}

TEST(MotionCurves, LimitsHoldUnlessTheMotionWasBeyondThem) {
  Motion motion = AtRest(60);
  const auto knee = [&](SkeletonPose* pose) -> double& {
    return DofOf(motion.skeleton, "ltibia", Dof::Kind::kRx, pose);
  };
  const double lowest = -10.0 * std::numbers::pi / 180.0;
  const auto lowest_after_spline = [&](double low) {
    // A spline through a sharp corner at the limit swings beyond it.
    for (int t = 0; t < 60; ++t)
      knee(&motion.frames[t]) = t < 25 ? 1.0 - (1.0 - low) * t / 25 : low;
    for (int t = 26; t < 34; ++t) motion.frames[t] = UnknownPose(motion.skeleton);
    const MotionCurves curves(motion);
    const Motion filled = curves.ToMotion(FillGaps(curves.curves()).curves);
    double lowest_angle = 10.0;
    for (SkeletonPose pose : filled.frames) lowest_angle = std::min(lowest_angle, knee(&pose));
    for (int t = 26; t < 34; ++t) motion.frames[t] = SkeletonPose::Rest(motion.skeleton);
    return lowest_angle;
  };
  EXPECT_NEAR(lowest_after_spline(lowest), lowest, 1e-12);
  EXPECT_NEAR(lowest_after_spline(lowest - 0.3), lowest - 0.3, 1e-12);
  EXPECT_LT(lowest_after_spline(lowest + 0.1), lowest + 0.1 - 1e-4);  // swings where it may
}

TEST(MotionCurves, AnUnknownFrameIsAColumnOfNaNAndSignsHoldAcrossIt) {
  auto rng = TestRng();
  Motion motion = RandomMotion(TrimmedCmuLikeSkeleton(), 30, &rng);
  const Eigen::MatrixXd whole = MotionCurves(motion).curves();
  motion.frames[10] = UnknownPose(motion.skeleton);
  for (size_t t = 11; t < 30; ++t) motion.frames[t].world_from_root.coeffs() *= -1.0;
  const MotionCurves curves(motion);
  EXPECT_TRUE(curves.curves().col(10).array().isNaN().all());
  EXPECT_TRUE(MatrixNear(curves.curves().leftCols(10), whole.leftCols(10), 0.0));
  EXPECT_TRUE(MatrixNear(curves.curves().rightCols(19), whole.rightCols(19), 1e-12));
  const Motion back = curves.ToMotion(curves.curves());
  for (int t = 0; t < 30; ++t) EXPECT_EQ(IsKnown(back.frames[t]), t != 10);
}

TEST(MotionCurves, CurvesOfAnotherSizeAreRefused) {
  const MotionCurves curves(AtRest(5));
  EXPECT_THROW(curves.ToMotion(curves.curves().leftCols(4)), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
