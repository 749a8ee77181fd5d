// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Segments of planted walks and of made-up motions: where the samples stand, as
// the motion itself has it, and their mirror images.
#include "lift/temporal/motion_codebook.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using testing::MatrixNear;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr int kFramesPerSample = 8;  // of 60 Hz

// Along a circle of 2 m with 1.5 m/s, more than once around, swaying and bent
// forward, the knees moving.
Motion WalkInACircle(int num_frames) {
  Motion motion{TrimmedCmuLikeSkeleton(), 1.0 / 60.0, {}};
  for (int f = 0; f < num_frames; ++f) {
    const double turn_rad = 0.75 * f / 60.0, sway_rad = 0.2 * std::sin(0.1 * f);
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    pose.root_in_world_m = {2.0 * (1.0 - std::cos(turn_rad)), 0.9 + 0.1 * sway_rad,
                            2.0 * std::sin(turn_rad)};
    pose.world_from_root =
        AngleAxisd(turn_rad, Vector3d::UnitY()) * AngleAxisd(sway_rad, Vector3d(0.6, 0.0, 0.8));
    testing::DofOf(motion.skeleton, "ltibia", Dof::Kind::kRx, &pose) = 0.5 + sway_rad;
    motion.frames.push_back(pose);
  }
  return motion;
}

MotionDatabase DatabaseOf(const std::vector<Motion>& motions) {
  MotionDatabase database{motions[0].skeleton, motions[0].frame_time_s, {}, {}};
  for (const Motion& motion : motions) database.Append("a", MotionFeatures(motion));
  return database;
}

FeatureVector SampleOf(const MotionCodebook& codebook, int segment, int sample) {
  return codebook.segments.col(segment).segment<kNumFeatures>(sample * kNumFeatures).cast<double>();
}

// Joints of a pose as seen from the floor below another one's root.
Pose3 SeenFrom(const SkeletonPose& middle, const Skeleton& skeleton, const SkeletonPose& pose) {
  Pose3 joints_m = JointPositions(skeleton, pose);
  const Vector3d place_m(middle.root_in_world_m.x(), 0.0, middle.root_in_world_m.z());
  joints_m.colwise() -= place_m;
  return AngleAxisd(-Yaw(middle.world_from_root), Vector3d::UnitY()).toRotationMatrix() * joints_m;
}

TEST(MotionCodebook, SegmentsHaveThePathRelativeToTheirMiddle) {
  const Motion walk = WalkInACircle(700);
  const MotionCodebook codebook = SegmentsOf(DatabaseOf({walk}), 5);
  ASSERT_EQ(codebook.NumSegments(), (700 - 32 + 4) / 5);
  ASSERT_EQ(codebook.rates.cols(), codebook.NumSegments());
  EXPECT_TRUE(codebook.deviations.isZero(0.0f));
  EXPECT_EQ(codebook.deviations.cols(), codebook.NumSegments());
  for (const int k : {0, 17, codebook.NumSegments() - 1})
    for (int s = 0; s < kSegmentSamples; ++s) {
      // An arc of the circle, seen from the point where the body faces along it.
      const double turn_rad = 0.75 * (s - kMiddleSample) * codebook.sample_time_s;
      const FeatureVector sample = SampleOf(codebook, k, s);
      EXPECT_NEAR(sample[segment_row::kPlace], 2.0 * (1.0 - std::cos(turn_rad)), 1e-4);
      EXPECT_NEAR(sample[segment_row::kPlace + 1], 2.0 * std::sin(turn_rad), 1e-4);
      EXPECT_NEAR(sample[segment_row::kYaw], turn_rad, 1e-4);
    }
}

TEST(MotionCodebook, SamplesArePosesOfTheMotion) {
  auto rng = TestRng();
  for (const Motion& motion : {WalkInACircle(120), [&] {
                                 Motion made_up =
                                     testing::RandomMotion(TrimmedCmuLikeSkeleton(), 120, &rng);
                                 made_up.frame_time_s = 1.0 / 60.0;
                                 return made_up;
                               }()}) {
    const MotionCodebook codebook = SegmentsOf(DatabaseOf({motion}), 1);
    for (const int k : {0, 40, codebook.NumSegments() - 1})
      for (int s = 0; s < kSegmentSamples; ++s) {
        const int middle = k + kMiddleSample * kFramesPerSample;
        const SkeletonPose& frame = motion.frames[middle + (s - kMiddleSample) * kFramesPerSample];
        const Pose3 joints_m =
            JointPositions(codebook.skeleton, PoseOfSample(SampleOf(codebook, k, s)));
        EXPECT_TRUE(
            MatrixNear(joints_m, SeenFrom(motion.frames[middle], motion.skeleton, frame), 1e-4));
      }
  }
}

TEST(MotionCodebook, RatesAreChangesPerSecond) {
  const Motion walk = WalkInACircle(200);
  const MotionCodebook codebook = SegmentsOf(DatabaseOf({walk}), 1);
  const FeatureMatrix features = MotionFeatures(walk);
  for (const int k : {0, 100, codebook.NumSegments() - 1}) {
    const int middle = k + kMiddleSample * kFramesPerSample;
    const FeatureVector rates = codebook.rates.col(k).cast<double>();
    EXPECT_NEAR(rates[segment_row::kPlace], 0.0, 1e-3);
    EXPECT_NEAR(rates[segment_row::kPlace + 1], 1.5, 1e-3);  // forward
    EXPECT_NEAR(rates[segment_row::kYaw], 0.75, 1e-3);
    const FeatureVector change = features.col(middle + 2) - features.col(middle - 2);
    EXPECT_TRUE(MatrixNear(rates.head<43>(), change.head<43>() * 15.0, 1e-4));
  }
}

TEST(MotionCodebook, SegmentsStayWithinTheirTrials) {
  const Motion walk = WalkInACircle(400);
  const auto piece = [&](int first, int count) {
    Motion part = walk;
    part.frames.assign(walk.frames.begin() + first, walk.frames.begin() + first + count);
    return part;
  };
  const MotionCodebook codebook =
      SegmentsOf(DatabaseOf({piece(0, 32), piece(50, 33), piece(10, 1), piece(90, 40)}), 3);
  const MotionCodebook alone = SegmentsOf(DatabaseOf({piece(50, 33)}), 3);
  const MotionCodebook last = SegmentsOf(DatabaseOf({piece(90, 40)}), 3);
  ASSERT_EQ(codebook.NumSegments(), 1 + 3);
  EXPECT_EQ(codebook.segments.col(0), alone.segments.col(0));
  EXPECT_EQ(codebook.segments.rightCols(3), last.segments);
  EXPECT_EQ(codebook.rates.rightCols(3), last.rates);
  EXPECT_EQ(SegmentsOf(DatabaseOf({piece(0, 32)})).NumSegments(), 0);
}

TEST(MotionCodebook, WantsAWholeNumberOfFramesASample) {
  Motion walk = WalkInACircle(200);
  walk.frame_time_s = 1.0 / 50.0;  // 6.67 frames
  EXPECT_THROW(SegmentsOf(DatabaseOf({walk})), InputError);
  walk.frame_time_s = 1.0;
  EXPECT_THROW(SegmentsOf(DatabaseOf({walk})), InputError);
  walk.frame_time_s = 1.0 / 30.0;
  EXPECT_EQ(SegmentsOf(DatabaseOf({walk}), 1).NumSegments(), 200 - 16);
}

TEST(MotionCodebook, MirrorImagesAreTheSegmentsOfTheMirroredMotion) {
  const Motion walk = WalkInACircle(150);
  Motion mirrored = walk;
  for (SkeletonPose& pose : mirrored.frames) pose = testing::MirroredPose(walk.skeleton, pose);
  const MotionCodebook both = WithMirrored(SegmentsOf(DatabaseOf({walk})));
  const MotionCodebook planted = SegmentsOf(DatabaseOf({mirrored}));
  const int count = planted.NumSegments();
  ASSERT_EQ(both.NumSegments(), 2 * count);
  EXPECT_TRUE(MatrixNear(both.segments.rightCols(count).cast<double>(),
                         planted.segments.cast<double>(), 1e-5));
  EXPECT_TRUE(
      MatrixNear(both.rates.rightCols(count).cast<double>(), planted.rates.cast<double>(), 1e-3));
  EXPECT_TRUE(MatrixNear(both.accelerations.means.rightCols(count).cast<double>(),
                         planted.accelerations.means.cast<double>(), 0.03));
}

// Of the right knee alone: what the left one does with a rate of -1 the right one's.
TEST(MotionCodebook, RegressionsAreMirroredAsWhatTheyAre) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const auto row = [&](const char* bone) {
    return skeleton.DofStarts()[static_cast<size_t>(*skeleton.FindBone(bone))];
  };
  const int left = row("ltibia"), right = row("rtibia");
  MotionCodebook codebook = SegmentsOf(DatabaseOf({WalkInACircle(150)}), 1000);
  ASSERT_EQ(codebook.NumSegments(), 1);
  AccelerationModels& models = codebook.accelerations;
  models.directions(kAccelerationInputs - kNumFeatures + left, 0) = 2.0f;
  models.responses(left, 0) = 3.0f;
  models.responses(segment_row::kPlace, 0) = 5.0f;
  const AccelerationModels both = WithMirrored(codebook).accelerations;
  EXPECT_EQ(both.directions(kAccelerationInputs - kNumFeatures + right, 1), 2.0f);
  EXPECT_EQ(both.directions(kAccelerationInputs - kNumFeatures + left, 1), 0.0f);
  EXPECT_EQ(both.responses(right, 1), 3.0f);
  EXPECT_EQ(both.responses(segment_row::kPlace, 1), -5.0f);
}

TEST(MotionCodebook, AccelerationsAreHowRatesGoOn) {
  // A knee that swings: the mean of its acceleration from t to t + 1/15 s.
  Motion motion{TrimmedCmuLikeSkeleton(), 1.0 / 60.0, {}};
  constexpr double kOmega = 4.0;
  for (int f = 0; f < 100; ++f) {
    motion.frames.push_back(SkeletonPose::Rest(motion.skeleton));
    testing::DofOf(motion.skeleton, "ltibia", Dof::Kind::kRx, &motion.frames.back()) =
        std::sin(kOmega * f / 60.0);
  }
  const MotionCodebook codebook = SegmentsOf(DatabaseOf({motion}), 7);
  const int row = motion.skeleton.DofStarts()[*motion.skeleton.FindBone("ltibia")];
  for (int k = 0; k < codebook.NumSegments(); ++k) {
    const double t_s = (16 + 7 * k) / 60.0, later_s = t_s + kAccelerationTime_s;
    const double mean =
        kOmega * (std::cos(kOmega * later_s) - std::cos(kOmega * t_s)) / kAccelerationTime_s;
    EXPECT_NEAR(codebook.accelerations.means(row, k), mean, 0.1);
  }
}

TEST(MotionCodebook, TheMirrorImageOfTheMirrorImageHasTheSameBits) {
  auto rng = TestRng();
  MotionCodebook codebook;
  codebook.skeleton = TrimmedCmuLikeSkeleton();
  codebook.segments = testing::RandomMatrix(kSegmentRows, 7, &rng).cast<float>();
  codebook.rates = testing::RandomMatrix(kNumFeatures, 7, &rng).cast<float>();
  codebook.deviations = testing::RandomMatrix(kNumFeatures, 7, &rng).cast<float>().cwiseAbs();
  const MotionCodebook both = WithMirrored(codebook);
  EXPECT_EQ(both.segments.leftCols(7), codebook.segments);
  EXPECT_NE(both.segments.rightCols(7), codebook.segments);
  EXPECT_TRUE((both.deviations.array() >= 0.0f).all());
  const MotionCodebook twice = WithMirrored(both);
  ASSERT_EQ(twice.NumSegments(), 28);
  EXPECT_EQ(twice.segments.rightCols(7), codebook.segments);
  EXPECT_EQ(twice.rates.rightCols(7), codebook.rates);
  EXPECT_EQ(twice.deviations.rightCols(7), codebook.deviations);
}

TEST(LeverArms, AreWhatJointsMove) {
  auto rng = TestRng();
  MotionCodebook one;
  one.skeleton = TrimmedCmuLikeSkeleton();
  one.segments = (0.5 * testing::RandomMatrix(kSegmentRows, 1, &rng)).cast<float>();
  auto middle = one.segments.middleRows<kNumFeatures>(kMiddleSample * kNumFeatures);
  middle.middleRows<2>(feature::kTilt).setZero();
  middle.bottomRows<3>().setZero();
  const FeatureVector sample = middle.col(0).cast<double>();
  const FeatureVector lever_arms_m = LeverArms(one);
  constexpr double kStep = 1e-5;
  for (int row = 0; row < kNumFeatures; ++row) {
    const auto joints_m = [&](double step) {
      return JointPositions(one.skeleton, PoseOfSample(sample + step * FeatureVector::Unit(row)));
    };
    const double moved_m = (joints_m(kStep) - joints_m(-kStep)).norm() / std::sqrt(kNumJoints);
    EXPECT_NEAR(lever_arms_m[row], moved_m / (2.0 * kStep), 1e-6) << row;
  }
}

}  // namespace
}  // namespace poselift
