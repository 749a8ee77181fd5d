// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A planted walk, seen by a level camera with noise, through the whole of
// LiftSequence. The dictionary is the one that ships; the motion model is the walk
// itself in other phases, so that what is tested is how the parts fit together.
#include "lift/lift_sequence.h"

#include <gtest/gtest.h>

#include <random>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/eval/pose_error.h"
#include "lift/normalize.h"
#include "lift/rotation.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr double kFrameTime_s = 1.0 / 30.0;
constexpr double kScale_px_per_m = 180.0;

class LiftSequenceTest : public ::testing::Test {
 protected:
  LiftSequenceTest()
      : dictionary_(ReadDictionary(DefaultDictionaryPath())),
        lifter_(dictionary_),
        walk_(OnStandardSkeleton(testing::PlantWalk(200, 0.6, 0.0).motion, dictionary_.skeleton,
                                 1.0 / 60.0)),
        codebook_(Learn()) {}

  MotionCodebook Learn() const {
    MotionDatabase database{dictionary_.skeleton, 1.0 / 60.0, {}, {}};
    database.Append("walk", MotionFeatures(walk_));
    return SegmentsOf(database, 2);
  }

  // Every other frame of the walk from its 40th on, from the side, a little farther
  // round with each frame, by a body of other proportions.
  void See(int num_frames, double noise_px, const GroupVector& log_ratios = GroupVector::Zero(),
           double turn_rad = 0.0) {
    const Skeleton body = WithProportions(walk_.skeleton, log_ratios);
    auto rng = testing::TestRng();
    std::normal_distribution<double> normal;
    for (int t = 0; t < num_frames; ++t) {
      const Eigen::Matrix3d cam_from_world = CamFromBody({0.0, 1.2 + t * turn_rad, 0.0});
      const SkeletonPose& pose = walk_.frames[static_cast<size_t>(40 + 2 * t)];
      truth_.push_back(cam_from_world * JointPositions(body, pose));
      Observation& frame = frames_.emplace_back();
      for (const Landmark& landmark : FindLayout("body15")->landmarks) {
        const Eigen::Vector3d x_in_cam_m = SumOfJoints(landmark.parts, truth_.back());
        ObservedPoint point{std::string(landmark.name), landmark.parts};
        point.x << kScale_px_per_m * x_in_cam_m.head<2>() +
                       noise_px * Eigen::Vector2d(normal(rng), normal(rng)),
            0.0;
        point.sigma = 4.0;
        frame.points.push_back(point);
      }
    }
  }

  double Error_mm(const LiftedSequence& lifted) const {
    double sum_mm = 0.0;
    for (size_t t = 0; t < truth_.size(); ++t)
      sum_mm += CamError_mm(lifted.frames[t].poses.front().joints_in_cam_m, truth_[t]);
    return sum_mm / static_cast<double>(truth_.size());
  }

  Dictionary dictionary_;
  PhotoLifter lifter_;
  Motion walk_;
  MotionCodebook codebook_;
  std::vector<Observation> frames_;
  std::vector<Pose3> truth_;
};

TEST_F(LiftSequenceTest, IsNearerToAKnownMotionThanFramesAlone) {
  See(24, 4.0);
  double alone_mm = 0.0;
  for (size_t t = 0; t < frames_.size(); ++t)
    alone_mm += CamError_mm(lifter_.LiftPhoto(frames_[t]).poses.front().joints_in_cam_m, truth_[t]);
  alone_mm /= static_cast<double>(frames_.size());
  const SequenceLifter lifter(lifter_, codebook_);
  EXPECT_LT(Error_mm(lifter.LiftSequence(frames_, kFrameTime_s)), 0.6 * alone_mm);
}

TEST_F(LiftSequenceTest, FillsAShortGapAndSaysSo) {
  See(20, 1.0);
  for (const size_t t : {8, 9, 10}) frames_[t].points.clear();
  const SequenceLifter lifter(lifter_, codebook_);
  const LiftedSequence lifted = lifter.LiftSequence(frames_, kFrameTime_s);
  for (size_t t = 0; t < frames_.size(); ++t) {
    EXPECT_TRUE(lifted.frames[t].IsUsable());
    EXPECT_EQ(lifted.filled[t], t >= 8 && t <= 10) << t;
  }
  EXPECT_LT(CamError_mm(lifted.frames[9].poses.front().joints_in_cam_m, truth_[9]), 60.0);
}

TEST_F(LiftSequenceTest, ALongGapStaysOpen) {
  See(16, 1.0);
  for (size_t t = 5; t < 11; ++t) frames_[t].points.clear();
  const SequenceLifter lifter(lifter_, codebook_, {.max_gap_s = 0.1});
  const LiftedSequence lifted = lifter.LiftSequence(frames_, kFrameTime_s);
  for (size_t t = 0; t < frames_.size(); ++t)
    EXPECT_EQ(lifted.frames[t].IsUsable(), t < 5 || t >= 11) << t;
  EXPECT_FALSE(lifted.frames[7].message.empty());
}

TEST_F(LiftSequenceTest, PointsInSpaceWillDo) {
  See(10, 0.0);
  for (size_t t = 0; t < frames_.size(); ++t) {
    frames_[t] = ObservePose(truth_[t], 0.01);
    std::erase_if(frames_[t].points, [](const ObservedPoint& p) { return p.name.size() % 2 == 0; });
  }
  const SequenceLifter lifter(lifter_, codebook_);
  EXPECT_LT(Error_mm(lifter.LiftSequence(frames_, kFrameTime_s)), 25.0);
}

TEST_F(LiftSequenceTest, NothingSeenIsNothingLifted) {
  const SequenceLifter lifter(lifter_, codebook_);
  EXPECT_TRUE(lifter.LiftSequence({}, kFrameTime_s).frames.empty());
  const LiftedSequence lifted = lifter.LiftSequence(std::vector<Observation>(5), kFrameTime_s);
  for (const LiftResult& frame : lifted.frames) EXPECT_FALSE(frame.IsUsable());
}

TEST_F(LiftSequenceTest, PiecesAreNearlyTheWhole) {
  See(24, 2.0);
  LiftSequenceOptions in_pieces;
  in_pieces.refinement.piece_frames = 8;
  in_pieces.refinement.overlap_frames = 6;
  const LiftedSequence whole =
      SequenceLifter(lifter_, codebook_).LiftSequence(frames_, kFrameTime_s);
  const LiftedSequence pieces =
      SequenceLifter(lifter_, codebook_, in_pieces).LiftSequence(frames_, kFrameTime_s);
  for (size_t t = 0; t < frames_.size(); ++t)
    EXPECT_LT((whole.frames[t].poses.front().joints_in_cam_m -
               pieces.frames[t].poses.front().joints_in_cam_m)
                  .colwise()
                  .norm()
                  .mean(),
              0.02)
        << t;
}

GroupVector LongLegs() {
  GroupVector log_ratios = GroupVector::Zero();
  log_ratios[1] = 0.10;  // thigh
  log_ratios[2] = 0.06;  // shank
  return log_ratios;
}

TEST_F(LiftSequenceTest, FindsLongLegsOfAWalkThatTurns) {
  See(60, 0.5, LongLegs(), 0.02);
  const Eigen::VectorXd standard_m = BoneLengths(dictionary_.skeleton);
  const GroupVector truth = AtEqualStature({LongLegs(), {}}, standard_m).log_ratios;
  const LiftedSequence lifted =
      SequenceLifter(lifter_, codebook_).LiftSequence(frames_, kFrameTime_s);
  // The arms of this walk are spread out: from the side they point at the camera.
  for (const int seen : {1, 2, 4}) {
    EXPECT_NEAR(lifted.body.log_ratios[seen], truth[seen], 0.03) << BoneGroupNames()[seen];
    EXPECT_LT(lifted.body.covariance(seen, seen), ProportionPrior().covariance(seen, seen));
  }
  EXPECT_NEAR(LogStature(lifted.body.log_ratios, standard_m), 0.0, 1e-9);
}

TEST_F(LiftSequenceTest, AllPosesAreOfOneSymmetricBody) {
  See(30, 2.0, LongLegs());
  for (size_t t = 10; t < 20; ++t) frames_[t].points.clear();
  LiftSequenceOptions with_gap;
  with_gap.max_gap_s = 0.1;
  const LiftedSequence lifted =
      SequenceLifter(lifter_, codebook_, with_gap).LiftSequence(frames_, kFrameTime_s);
  const Eigen::VectorXd lengths_m = BoneLengths(lifted.skeleton);
  for (int j = 1; j < kNumJoints; ++j)
    EXPECT_NEAR(lengths_m[j], lengths_m[Joints()[j].mirror], 1e-9);
  EXPECT_GT(lengths_m[joint::kLeftKnee],
            1.01 * BoneLengths(dictionary_.skeleton)[joint::kLeftKnee]);
  for (const LiftResult& frame : lifted.frames)
    for (const LiftedPose& pose : frame.poses)
      for (int j = 1; j < kNumJoints; ++j)
        EXPECT_NEAR(
            (pose.joints_in_cam_m.col(j) - pose.joints_in_cam_m.col(Joints()[j].parent)).norm(),
            lengths_m[j], 1e-9);
}

TEST_F(LiftSequenceTest, ProportionsDoNotDependOnTheScaleOfThePicture) {
  See(20, 1.0, LongLegs());
  const SequenceLifter lifter(lifter_, codebook_);
  const GroupVector once = lifter.LiftSequence(frames_, kFrameTime_s).body.log_ratios;
  for (Observation& frame : frames_)
    for (ObservedPoint& point : frame.points) {
      point.x *= 1.7;
      point.sigma *= 1.7;
    }
  const GroupVector enlarged = lifter.LiftSequence(frames_, kFrameTime_s).body.log_ratios;
  EXPECT_TRUE(testing::MatrixNear(once, enlarged, 2e-3));
}

TEST_F(LiftSequenceTest, FewFramesStayNearTheStandardBody) {
  See(60, 1.0, LongLegs());
  const SequenceLifter lifter(lifter_, codebook_);
  const GroupVector of_many = lifter.LiftSequence(frames_, kFrameTime_s).body.log_ratios;
  frames_.resize(3);
  const GroupVector of_few = lifter.LiftSequence(frames_, kFrameTime_s).body.log_ratios;
  EXPECT_LT(of_few.norm(), 0.5 * of_many.norm());
}

TEST_F(LiftSequenceTest, AFrameWithoutLabelsLeavesTheProportionsSure) {
  See(30, 1.0, LongLegs());
  const SequenceLifter lifter(lifter_, codebook_);
  const BodyProportions whole = lifter.LiftSequence(frames_, kFrameTime_s).body;
  frames_[14].points.clear();
  frames_[15].points.clear();
  const BodyProportions with_gap = lifter.LiftSequence(frames_, kFrameTime_s).body;
  for (int g = 0; g < kNumBoneGroups; ++g) {
    EXPECT_NEAR(with_gap.log_ratios[g], whole.log_ratios[g], 0.02) << BoneGroupNames()[g];
    EXPECT_NEAR(std::sqrt(with_gap.covariance(g, g)), std::sqrt(whole.covariance(g, g)), 0.01);
  }
}

TEST_F(LiftSequenceTest, KeepsTheStandardBonesWhenTold) {
  See(8, 1.0, LongLegs());
  LiftSequenceOptions standard;
  standard.find_proportions = false;
  const LiftedSequence lifted =
      SequenceLifter(lifter_, codebook_, standard).LiftSequence(frames_, kFrameTime_s);
  EXPECT_TRUE(lifted.body.log_ratios.isZero());
  EXPECT_EQ(BoneLengths(lifted.skeleton), BoneLengths(dictionary_.skeleton));
}

TEST_F(LiftSequenceTest, SaysHowSureTheAnglesAre) {
  See(12, 2.0);
  const LiftedSequence once =
      SequenceLifter(lifter_, codebook_, {.trunk_sigma_factor = 1.0, .limb_sigma_factor = 1.0})
          .LiftSequence(frames_, kFrameTime_s);
  const LiftedSequence twice =
      SequenceLifter(lifter_, codebook_, {.trunk_sigma_factor = 1.0, .limb_sigma_factor = 2.0})
          .LiftSequence(frames_, kFrameTime_s);
  for (size_t t = 0; t < frames_.size(); ++t) {
    const Eigen::VectorXd& sigma_deg = once.frames[t].poses.front().angles_sigma_deg;
    ASSERT_EQ(sigma_deg.size(), std::ssize(JointAngles()));
    EXPECT_GT(sigma_deg.minCoeff(), 0.05);
    EXPECT_LT(sigma_deg.maxCoeff(), 60.0);
    for (Eigen::Index a = 0; a < sigma_deg.size(); ++a)
      EXPECT_NEAR(twice.frames[t].poses.front().angles_sigma_deg[a],
                  (IsOfLimb(JointAngles()[static_cast<size_t>(a)]) ? 2.0 : 1.0) * sigma_deg[a],
                  1e-9);
    EXPECT_EQ(once.frames[t].poses.back().angles_sigma_deg.size(), 0);  // of the frame alone
  }
}

TEST_F(LiftSequenceTest, SameInputSameBytes) {
  See(8, 2.0);
  const SequenceLifter lifter(lifter_, codebook_);
  const LiftedSequence a = lifter.LiftSequence(frames_, kFrameTime_s);
  const LiftedSequence b = lifter.LiftSequence(frames_, kFrameTime_s);
  for (size_t t = 0; t < frames_.size(); ++t)
    EXPECT_EQ(a.frames[t].poses.front().joints_in_cam_m, b.frames[t].poses.front().joints_in_cam_m);
}

TEST_F(LiftSequenceTest, RefusesWhatIsNoVideo) {
  const SequenceLifter lifter(lifter_, codebook_);
  EXPECT_THROW(lifter.LiftSequence({}, 0.5), InputError);
  EXPECT_THROW(lifter.LiftSequence({}, 0.0), InputError);
  EXPECT_THROW(SequenceLifter(lifter_, codebook_, {.num_neighbours = 0}), InputError);
  EXPECT_THROW(SequenceLifter(lifter_, codebook_, {.limb_sigma_factor = 0.0}), InputError);
}

}  // namespace
}  // namespace poselift
