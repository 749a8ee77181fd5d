// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up gaits with planted noise, smoothed by a codebook of their like: on its own
// skeleton, on a rig's, as a BVH file. Real motion, when there is any, with the
// codebook that ships. The property: nearer to the truth than before and than a
// filter, on the skeleton that it was on.
#include "lift/model_smoother.h"

#include <gtest/gtest.h>

#include <random>

#include "lift/baselines/butterworth.h"
#include "lift/default_dictionary.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/bvh.h"
#include "src/io/motion_file.h"
#include "src/retarget.h"
#include "src/units.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/rig_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr double kNoise = 0.03;  // radians and metres

MotionSmoother Filter() {
  return SmootherOfCurves(GapFill::kLinear, [](const Eigen::MatrixXd& curves, double rate_hz) {
    return ButterworthLowPass(curves, rate_hz, {.cutoff_hz = 6.0});
  });
}

// Of angles and rotations in radians, of places in metres times place_unit.
Motion WithNoise(Motion motion, double sigma, double place_unit = 1.0) {
  auto rng = testing::TestRng();
  std::normal_distribution<double> noise(0.0, sigma);
  for (SkeletonPose& pose : motion.frames) {
    Eigen::Index d = 0;
    for (const Bone& bone : motion.skeleton.bones)
      for (const Dof& dof : bone.dofs)
        pose.dofs[d++] += (dof.IsRotation() ? 1.0 : place_unit) * noise(rng);
    for (double& x : pose.root_in_world_m) x += place_unit * noise(rng);
    const Eigen::Vector3d turn_rad(noise(rng), noise(rng), noise(rng));
    pose.world_from_root =
        Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()) * pose.world_from_root;
  }
  return motion;
}

// Of the tips of all bones.
double BonesError_mm(const Motion& truth, const Motion& motion) {
  double sum_m = 0.0;
  BoneFrames a, b;
  for (size_t t = 0; t < truth.frames.size(); ++t) {
    ForwardKinematics(truth.skeleton, truth.frames[t], &a);
    ForwardKinematics(motion.skeleton, motion.frames[t], &b);
    sum_m += (a.tip_in_world_m - b.tip_in_world_m).colwise().norm().mean();
  }
  return 1000.0 * sum_m / static_cast<double>(truth.frames.size());
}

class ModelSmootherTest : public ::testing::Test {
 protected:
  ModelSmootherTest()
      : walk_(testing::MadeUpGaits().Gait(160, 0.55)), noisy_(WithNoise(walk_, kNoise)) {
    codebook_ =
        std::make_shared<MotionCodebook>(SegmentsOf(testing::MadeUpGaits().Database(5, 160), 3));
  }

  Motion Smooth(const Motion& motion, int max_gap_frames = 0) const {
    return SmootherByModel(codebook_, Filter())(motion, max_gap_frames);
  }

  double Error_mm(const Motion& motion, size_t first, size_t last) const {
    double sum_m = 0.0;
    for (size_t t = first; t <= last; ++t)
      sum_m += (JointPositions(walk_.skeleton, motion.frames[t]) -
                JointPositions(walk_.skeleton, walk_.frames[t]))
                   .colwise()
                   .norm()
                   .mean();
    return 1000.0 * sum_m / static_cast<double>(last - first + 1);
  }

  Motion walk_, noisy_;
  std::shared_ptr<MotionCodebook> codebook_;
};

TEST_F(ModelSmootherTest, IsNearerToTheTruthThanAFilter) {
  const double by_model_mm = Error_mm(Smooth(noisy_), 0, 159);
  EXPECT_LT(by_model_mm, 0.8 * Error_mm(Filter()(noisy_, 0), 0, 159));
  EXPECT_LT(by_model_mm, 0.4 * Error_mm(noisy_, 0, 159));
}

TEST_F(ModelSmootherTest, SoItIsOnASkeletonOfAnotherKind) {
  const Motion truth = testing::OnRig(walk_);
  const Motion noisy = WithNoise(truth, kNoise);
  const Motion smooth = Smooth(noisy);
  const double by_model_mm = BonesError_mm(truth, smooth);
  EXPECT_LT(by_model_mm, 0.8 * BonesError_mm(truth, Filter()(noisy, 0)));
  EXPECT_LT(by_model_mm, 0.4 * BonesError_mm(truth, noisy));
  ASSERT_EQ(smooth.skeleton.bones.size(), truth.skeleton.bones.size());
  for (size_t b = 0; b < truth.skeleton.bones.size(); ++b) {
    EXPECT_EQ(smooth.skeleton.bones[b].name, truth.skeleton.bones[b].name);
    EXPECT_EQ(smooth.skeleton.bones[b].offset_m, truth.skeleton.bones[b].offset_m);
    EXPECT_EQ(smooth.skeleton.bones[b].dofs.size(), truth.skeleton.bones[b].dofs.size());
  }
}

TEST_F(ModelSmootherTest, WhatTheModelDoesNotKnowIsFiltered) {
  const Motion noisy = WithNoise(testing::OnRig(walk_), kNoise);
  const Motion smooth = Smooth(noisy), filtered = Filter()(noisy, 0);
  const int finger = noisy.skeleton.DofStarts()[*noisy.skeleton.FindBone("rig:LeftHandIndex1")];
  for (size_t t = 0; t < noisy.frames.size(); ++t)
    EXPECT_EQ(smooth.frames[t].dofs[finger], filtered.frames[t].dofs[finger]);
}

TEST_F(ModelSmootherTest, TheUnitOfTheFileDoesNotMatter) {
  const Motion in_m = Smooth(WithNoise(testing::OnRig(walk_), kNoise));
  const Motion in_cm = Smooth(WithNoise(testing::OnRig(walk_, 100.0), kNoise, 100.0));
  const int knee = in_m.skeleton.DofStarts()[*in_m.skeleton.FindBone("rig:LeftLeg")];
  for (size_t t = 0; t < in_m.frames.size(); ++t)
    EXPECT_TRUE(testing::MatrixNear(in_m.frames[t].dofs.segment<3>(knee),
                                    in_cm.frames[t].dofs.segment<3>(knee), 1e-5));
}

TEST_F(ModelSmootherTest, TheSameMotionFromABvhFileComesOutNearlyTheSame) {
  const auto path = testing::ScratchDir() / "noisy.bvh";
  WriteBvh(noisy_, path);
  const Motion from_bvh = RebaseMotion(Smooth(ReadBvh(path)), walk_.skeleton);
  EXPECT_LT(BonesError_mm(Smooth(noisy_), from_bvh), 0.1 * BonesError_mm(walk_, noisy_));
  EXPECT_LT(Error_mm(from_bvh, 0, 159), 1.05 * Error_mm(Smooth(noisy_), 0, 159));
}

TEST_F(ModelSmootherTest, AGapOfARigIsFilled) {
  const Motion truth = testing::OnRig(walk_);
  Motion noisy = WithNoise(truth, kNoise);
  for (size_t t = 60; t < 72; ++t) noisy.frames[t] = UnknownPose(truth.skeleton);
  for (size_t t = 110; t < 140; ++t) noisy.frames[t] = UnknownPose(truth.skeleton);
  const Motion smooth = Smooth(noisy, 12);
  for (size_t t = 0; t < smooth.frames.size(); ++t)
    EXPECT_EQ(IsKnown(smooth.frames[t]), t < 110 || t >= 140) << t;
}

TEST_F(ModelSmootherTest, FillsShortGapsAndLeavesLongOnes) {
  for (size_t t = 60; t < 72; ++t) noisy_.frames[t] = UnknownPose(walk_.skeleton);
  for (size_t t = 110; t < 140; ++t) noisy_.frames[t] = UnknownPose(walk_.skeleton);
  const Motion smooth = Smooth(noisy_, 12);
  for (size_t t = 0; t < smooth.frames.size(); ++t)
    EXPECT_EQ(IsKnown(smooth.frames[t]), t < 110 || t >= 140) << t;
  EXPECT_LT(Error_mm(smooth, 60, 71), 40.0);
}

TEST_F(ModelSmootherTest, KnowsTheNoise) {
  const FeatureVector noise = PoseNoise(noisy_);
  EXPECT_NEAR(noise.head<kNumAngles>().mean(), kNoise, 0.15 * kNoise);
  EXPECT_NEAR(noise[feature::kHeight], kNoise, 0.15 * kNoise);
  EXPECT_NEAR(noise[feature::kTilt], kNoise, 0.25 * kNoise);  // of fewer numbers
}

TEST_F(ModelSmootherTest, TooShortToKnowTheNoiseIsNoError) {
  for (const size_t count : {1U, 2U, 3U}) {
    Motion few = noisy_;
    few.frames.resize(count);
    EXPECT_EQ(PoseNoise(few), FeatureVector::Zero());
    const Motion smooth = Smooth(few);
    ASSERT_EQ(smooth.frames.size(), count);
    EXPECT_TRUE(IsKnown(smooth.frames[0]));
  }
}

TEST_F(ModelSmootherTest, RefusesWhatIsNoBody) {
  noisy_.skeleton.bones[joint::kLeftAnkle].name = "something else";
  EXPECT_THROW(Smooth(noisy_), InputError);
  EXPECT_THROW(SmootherByModel(codebook_, Filter(), {.num_neighbours = 0}), InputError);
}

// A walk of the CMU database as it is, and motions as others rigged them.
TEST(ModelSmoother, RealMotionWithNoiseComesNearerToWhatItWas) {
  POSELIFT_DATA_OR_SKIP(data);
  const auto codebook =
      std::make_shared<MotionCodebook>(WithMirrored(ReadMotionCodebook(DefaultMotionModelPath())));
  for (const char* file :
       {"cmu/07/07_05.amc", "cmu/13/13_41.bvh", "cmu/94/94_01.bvh", "other/golf.bvh"}) {
    Motion truth = ReadMotion(data / "mocap" / file);
    truth.frames.resize(120);
    constexpr double kNoPlace = 0.0;
    const Motion noisy = WithNoise(truth, 5.0 * kRadFromDeg, kNoPlace);
    const Motion smooth = SmootherByModel(codebook, Filter())(noisy, 0);
    const double by_model_mm = BonesError_mm(truth, smooth);
    EXPECT_LT(by_model_mm, 0.4 * BonesError_mm(truth, noisy)) << file;
    EXPECT_LT(by_model_mm, BonesError_mm(truth, Filter()(noisy, 0))) << file;
  }
}

}  // namespace
}  // namespace poselift
