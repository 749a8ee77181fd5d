// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Databases of made-up trials, in memory and in files as CMU's, and of real ones
// where they are.
#include "lift/temporal/motion_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "lift/dictionary_file.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::CmuLikeSkeleton;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::MatrixNear;
using testing::RandomMatrix;
using testing::RandomMotion;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

TEST(MotionDatabase, HasNoSegmentAcrossTrials) {
  MotionDatabase database;
  for (const int num_frames : {5, 3, 0, 4, 1, 2})
    database.Append("trial", FeatureMatrix::Zero(kNumFeatures, num_frames));
  EXPECT_EQ(database.NumFrames(), 15);
  EXPECT_THAT(SegmentEnds(database, 1), ElementsAre(0, 1, 2, 3, 5, 6, 8, 9, 10, 13));
  EXPECT_THAT(SegmentEnds(database, 3), ElementsAre(2, 3, 10));
  EXPECT_THAT(SegmentEnds(database, 4), ElementsAre(3));
  EXPECT_THAT(SegmentEnds(database, 5), IsEmpty());
  EXPECT_THAT(SegmentEnds(MotionDatabase(), 2), IsEmpty());
}

TEST(MotionDatabase, WeighsGroupsOfRowsByOneOverSigma) {
  auto rng = TestRng();
  FeatureMatrix features = RandomMatrix(kNumFeatures, 20000, &rng);
  features.row(3) *= 0.0;  // a joint that does not move does not count for more
  features.row(feature::kHeight).setConstant(0.9);
  features.middleRows<2>(feature::kTilt).array() = 0.2 * features.middleRows<2>(41).array() - 7.0;
  features.row(feature::kVelocity) *= 3.0;
  features.row(feature::kVelocity + 1) *= 4.0;
  features.row(feature::kYawRate) *= 10.0;
  MotionDatabase database;
  database.Append("a", features.leftCols(5000));
  database.Append("b", features.rightCols(15000));
  const FeatureVector weights = RowWeights(database);
  EXPECT_NEAR(weights[0], std::sqrt(40.0 / 39.0), 0.01);
  for (int d = 1; d < kNumAngles; ++d) EXPECT_EQ(weights[d], weights[0]);
  EXPECT_EQ(weights[feature::kHeight], 1.0);
  EXPECT_NEAR(weights[feature::kTilt], 5.0, 0.1);
  EXPECT_EQ(weights[feature::kTilt + 1], weights[feature::kTilt]);
  EXPECT_NEAR(weights[feature::kVelocity], 1.0 / std::sqrt(12.5), 0.01);
  EXPECT_EQ(weights[feature::kVelocity + 1], weights[feature::kVelocity]);
  EXPECT_NEAR(weights[feature::kYawRate], 0.1, 0.002);
  EXPECT_EQ(RowWeights(MotionDatabase()), FeatureVector::Ones());
}

TEST(MotionDatabase, ScalesTheBodyAndItsPathTogether) {
  auto rng = TestRng();
  const Skeleton standard = TrimmedCmuLikeSkeleton();
  Motion tall = RandomMotion(CmuLikeSkeleton(), 20, &rng);
  for (Bone& bone : tall.skeleton.bones) {
    bone.offset_m *= 1.25;
    bone.tip_m *= 1.25;
  }
  for (SkeletonPose& pose : tall.frames) pose.dofs *= 0.1;
  // The clavicles, which the standard skeleton cannot turn.
  for (SkeletonPose& pose : tall.frames)
    for (const char* bone : {"lclavicle", "rclavicle"})
      for (const Dof::Kind kind : {Dof::Kind::kRy, Dof::Kind::kRz})
        testing::DofOf(tall.skeleton, bone, kind, &pose) = 0.0;
  const Motion motion = OnStandardSkeleton(tall, standard, 2.0 * tall.frame_time_s);
  ASSERT_EQ(motion.frames.size(), 10u);
  EXPECT_EQ(motion.frame_time_s, 2.0 * tall.frame_time_s);
  for (size_t f = 0; f < 10; ++f)
    EXPECT_TRUE(MatrixNear(1.25 * JointPositions(standard, motion.frames[f]),
                           JointPositions(tall.skeleton, tall.frames[2 * f]), 1e-9));
}

TEST(MotionDatabase, RefusesABodyWithoutLegs) {
  auto rng = TestRng();
  Motion motion = RandomMotion(CmuLikeSkeleton(), 3, &rng);
  motion.skeleton.bones[*motion.skeleton.FindBone("ltibia")].name = "tail";
  EXPECT_THROW(OnStandardSkeleton(motion, TrimmedCmuLikeSkeleton(), 0.1), InputError);
}

std::vector<std::string> Names(const std::vector<MotionSource>& sources) {
  std::vector<std::string> names;
  for (const MotionSource& source : sources) names.push_back(source.amc.stem());
  return names;
}

TEST(MotionDatabase, TakesTheSubjectsAndTrialsThatAreAskedFor) {
  const std::vector<MotionSource> sources = {
      {"d/07/07_01.amc", "", "07"}, {"d/07/07_02.amc", "", "07"}, {"d/08/08_01.amc", "", "08"}};
  EXPECT_THAT(Names(ChooseTrials(sources, {}, {})), ElementsAre("07_01", "07_02", "08_01"));
  EXPECT_THAT(Names(ChooseTrials(sources, {"07"}, {})), ElementsAre("07_01", "07_02"));
  EXPECT_THAT(Names(ChooseTrials(sources, {"08", "07_02"}, {})), ElementsAre("07_02", "08_01"));
  EXPECT_THAT(Names(ChooseTrials(sources, {}, {"07_01", "08"})), ElementsAre("07_02"));
  EXPECT_THAT(Names(ChooseTrials(sources, {"07"}, {"07"})), IsEmpty());
  EXPECT_THROW(ChooseTrials(sources, {"7"}, {}), InputError);
  EXPECT_THROW(ChooseTrials(sources, {}, {"07_03"}), InputError);
}

TEST(MotionDatabase, HoldsTheTrialsOfFilesAndTheirMirrorImages) {
  auto rng = TestRng();
  const auto folder = testing::ScratchDir();
  std::filesystem::create_directories(folder / "07");
  const AsfSkeleton asf = ToAsfSkeleton(CmuLikeSkeleton());
  WriteAsf(asf, folder / "07/07.asf");
  std::vector<FeatureMatrix> planted;
  for (const int num_frames : {31, 1, 12}) {
    Motion motion = RandomMotion(asf.skeleton, num_frames, &rng);
    for (SkeletonPose& pose : motion.frames) pose.dofs *= 0.1;
    const std::string name = "07_0" + std::to_string(planted.size() + 1) + ".amc";
    WriteAmc(motion, asf, folder / "07" / name);
    motion.frame_time_s = kCmuFrameTime_s;
    planted.push_back(
        MotionFeatures(OnStandardSkeleton(motion, TrimmedCmuLikeSkeleton(), 1.0 / 60.0)));
  }
  const Skeleton standard = TrimmedCmuLikeSkeleton();
  double done = 0.0;
  const MotionDatabase database = LoadMotionDatabase(FindMotions(folder), standard, {},
                                                     [&](double fraction) { done = fraction; });
  EXPECT_EQ(done, 1.0);
  ASSERT_EQ(database.trials.size(), 6u);
  EXPECT_EQ(database.trials[0].name, "07_01");
  EXPECT_EQ(database.trials[5].name, "07_03/mirrored");
  EXPECT_EQ(database.NumFrames(), 2 * (16 + 1 + 6));
  for (int i = 0; i < 3; ++i) {
    const auto trial = [&](const Trial& t) -> Eigen::MatrixXd {
      return database.features.middleCols(t.first_frame, t.num_frames).cast<double>();
    };
    EXPECT_TRUE(MatrixNear(trial(database.trials[2 * i]), planted[i], 1e-3));
    EXPECT_TRUE(MatrixNear(trial(database.trials[2 * i + 1]),
                           MirroredFeatures(planted[i], standard), 1e-3));
  }
  EXPECT_EQ(LoadMotionDatabase(FindMotions(folder), standard, {.mirrored = false}).NumFrames(), 23);
}

// Trials of one value each, so that a frame says whose it is.
MotionDatabase NumberedTrials() {
  MotionDatabase database;
  int number = 0;
  for (const char* name :
       {"01_01", "01_01/mirrored", "01_02", "01_02/mirrored", "01_01", "02_05"}) {
    database.Append(name, FeatureMatrix::Constant(kNumFeatures, 10 + number, number));
    ++number;
  }
  return database;
}

TEST(MotionDatabase, SubsetsHaveAllPiecesOfATrialAndItsMirrorImage) {
  const MotionDatabase subset = SubsetOfTrials(NumberedTrials(), {"02_05", "01_01", "77_77"});
  std::vector<int> numbers;
  for (const Trial& trial : subset.trials) {
    const auto frames = subset.features.middleCols(trial.first_frame, trial.num_frames);
    EXPECT_TRUE((frames.array() == frames(0, 0)).all());
    EXPECT_EQ(trial.num_frames, 10 + frames(0, 0));
    numbers.push_back(static_cast<int>(frames(0, 0)));
  }
  EXPECT_THAT(numbers, ElementsAre(0, 1, 4, 5));
  EXPECT_EQ(SubsetOfTrials(NumberedTrials(), {}).NumFrames(), 0);
}

TEST(MotionDatabase, DrawsWholeTrialsBySeed) {
  const MotionDatabase all = NumberedTrials();
  std::set<int> sizes;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const MotionDatabase drawn = DrawTrials(all, 20, seed);
    EXPECT_GE(drawn.NumFrames(), 20);
    EXPECT_LT(drawn.NumFrames(), 35 + 20);
    EXPECT_EQ(drawn.NumFrames(), DrawTrials(all, 20, seed).NumFrames());
    sizes.insert(drawn.NumFrames());
  }
  EXPECT_GT(sizes.size(), 1u);
  EXPECT_EQ(DrawTrials(all, 1000000, 1).NumFrames(), all.NumFrames());
  EXPECT_EQ(DrawTrials(all, 0, 1).NumFrames(), 0);
}

TEST(MotionDatabase, CutsTrialsWhereAnglesJump) {
  const auto folder = testing::ScratchDir();
  const AsfSkeleton asf = ToAsfSkeleton(CmuLikeSkeleton());
  WriteAsf(asf, folder / "07.asf");
  Motion motion{asf.skeleton, kCmuFrameTime_s, {}};
  for (int f = 0; f < 60; ++f) {
    SkeletonPose pose = SkeletonPose::Rest(asf.skeleton);
    testing::DofOf(asf.skeleton, "ltibia", Dof::Kind::kRx, &pose) = 0.1 * f;
    motion.frames.push_back(pose);
  }
  WriteAmc(motion, asf, folder / "07_01.amc");
  const Skeleton standard = TrimmedCmuLikeSkeleton();
  const MotionDatabase database =
      LoadMotionDatabase(FindMotions(folder), standard, {.mirrored = false});
  ASSERT_EQ(database.trials.size(), 2u);
  EXPECT_EQ(database.trials[0].num_frames, 16);  // 0, 0.2 ... 3.0
  EXPECT_EQ(database.trials[1].first_frame, 16);
  EXPECT_EQ(database.trials[1].num_frames, 14);  // 3.2 - 2 pi ... 5.8 - 2 pi
  EXPECT_EQ(database.trials[1].name, "07_01");
  SkeletonPose row_of = SkeletonPose::Rest(standard);
  testing::DofOf(standard, "ltibia", Dof::Kind::kRx, &row_of) = 1.0;
  Eigen::Index row = 0;
  row_of.dofs.maxCoeff(&row);
  for (int t = 0; t < 30; ++t)
    EXPECT_NEAR(database.features(row, t), std::remainder(0.2 * t, 2.0 * std::numbers::pi), 1e-4);
}

// The standard skeleton's axes have to be mirror images for MirroredFeatures.
TEST(MotionDatabase, MirrorsRealMotionsInTheMidplane) {
  POSELIFT_DATA_OR_SKIP(data);
  const Skeleton standard = ReadDictionary(testing::SourcePath("data/default.pldict")).skeleton;
  const auto sources = ChooseTrials(FindMotions(data / "mocap/cmu"), {"49_08", "09_03"}, {});
  const MotionDatabase database = LoadMotionDatabase(sources, standard);
  ASSERT_EQ(database.trials.size(), 4u);
  for (const int i : {0, 2}) {
    const Trial& original = database.trials[i];
    const Trial& mirrored = database.trials[i + 1];
    ASSERT_EQ(original.num_frames, mirrored.num_frames);
    ASSERT_GT(original.num_frames, 50);
    SkeletonPose pose = SkeletonPose::Rest(standard), mirrored_pose = pose;
    for (int t = 0; t < original.num_frames; ++t) {
      const auto step = [&](const Trial& trial, SkeletonPose* at) {
        *at = PoseFromFeatures(database.features.col(trial.first_frame + t).cast<double>(), *at,
                               database.frame_time_s);
        return JointPositions(standard, *at);
      };
      Pose3 joints_m = step(original, &pose);
      const Pose3 mirrored_m = step(mirrored, &mirrored_pose);
      joints_m.row(0) *= -1.0;
      for (int j = 0; j < kNumJoints; ++j)
        EXPECT_LT((joints_m.col(Joints()[j].mirror) - mirrored_m.col(j)).norm(), 1e-4) << j;
    }
  }
}

}  // namespace
}  // namespace poselift
