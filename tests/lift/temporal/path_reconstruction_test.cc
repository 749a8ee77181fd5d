// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up gaits, one family of waves: the database has some, the test another,
// seen at its left wrist and right ankle, or at all four.
#include "lift/temporal/path_reconstruction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lift/baselines/frame_ik.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"

namespace poselift {
namespace {

constexpr double kFrameTime_s = 1.0 / 60.0;

struct World : testing::MadeUpGaits {
  const MotionDatabase database = Database(12, 160);
};

using Joints = std::vector<int>;
const Joints kTwo = {joint::kLeftHand, joint::kRightAnkle};
const Joints kFour = {joint::kLeftHand, joint::kRightHand, joint::kLeftAnkle, joint::kRightAnkle};

std::vector<TargetPoint> Observe(const Motion& motion, size_t frame, const Joints& joints = kTwo) {
  const Pose3 joints_m = JointPositions(motion.skeleton, motion.frames[frame]);
  std::vector<TargetPoint> observed;
  for (const int j : joints) observed.push_back({{{j, 1.0}}, joints_m.col(j), 200.0});
  return observed;
}

// From the frame `from` on; the error of each frame, the mean of its joints.
std::vector<double> Errors_m(MotionMethod* method, const Motion& motion, size_t from,
                             const Joints& joints = kTwo) {
  std::vector<double> errors_m;
  for (size_t t = from; t < motion.frames.size(); ++t) {
    const SkeletonPose pose = method->Next(Observe(motion, t, joints));
    const Pose3 error_m =
        JointPositions(motion.skeleton, pose) - JointPositions(motion.skeleton, motion.frames[t]);
    errors_m.push_back(error_m.colwise().norm().mean());
  }
  return errors_m;
}

double Mean(const std::vector<double>& values, size_t from = 0) {
  double sum = 0.0;
  for (size_t i = from; i < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(values.size() - from);
}

std::vector<SkeletonPose> First4(const Motion& motion, size_t from = 0) {
  const auto begin = motion.frames.begin() + static_cast<std::ptrdiff_t>(from);
  return {begin, begin + 4};
}

TEST(PathReconstruction, TwoPointsTellAMotionOfItsKind) {
  const World world;
  const PathSearch search(world.database);
  const Motion motion = world.Gait(100, 0.47);
  PathReconstruction ours(world.database, search);
  FrameIk ik(world.database.skeleton, kFrameTime_s, FeatureVector::Constant(0.05));
  ours.Begin(First4(motion));
  ik.Begin(First4(motion));
  const double error_m = Mean(Errors_m(&ours, motion, 4));
  EXPECT_LT(error_m, 0.02);
  EXPECT_LT(error_m, 0.3 * Mean(Errors_m(&ik, motion, 4)));
}

// The first poses are of half a cycle later: lost from the start.
TEST(PathReconstruction, ComesBackFromAstray) {
  const World world;
  const PathSearch search(world.database);
  const Motion motion = world.Gait(140, 0.47);
  PathReconstruction method(world.database, search);
  method.Begin(First4(motion, 31));
  const auto errors_m = Errors_m(&method, motion, 4, kFour);
  EXPECT_GT(errors_m.front(), 0.2);
  EXPECT_LT(Mean(errors_m, errors_m.size() - 40), 0.3 * errors_m.front());
}

TEST(PathReconstruction, GivesTheSameEveryTime) {
  const World world;
  const PathSearch search(world.database);
  const Motion motion = world.Gait(40, 0.3);
  PathReconstruction a(world.database, search), b(world.database, search);
  a.Begin(First4(motion));
  b.Begin(First4(motion));
  EXPECT_EQ(Errors_m(&a, motion, 4), Errors_m(&b, motion, 4));
}

// Moved over the floor and turned about the vertical, everything moves along.
TEST(PathReconstruction, DoesNotDependOnPlaceAndHeading) {
  const World world;
  const PathSearch search(world.database);
  PathReconstruction here(world.database, search), there(world.database, search);
  testing::ExpectToMoveAlong(world.Gait(12, 0.3), &here, &there, 1e-3);
}

TEST(PathReconstruction, GoesOnWithoutObservations) {
  const World world;
  const PathSearch search(world.database);
  PathReconstruction method(world.database, search);
  const Motion motion = world.Gait(40, 0.3);
  method.Begin(First4(motion));
  for (size_t t = 4; t < 20; ++t) method.Next(Observe(motion, t));
  SkeletonPose pose;
  for (size_t t = 20; t < 40; ++t) pose = method.Next({});
  const Pose3 error_m =
      JointPositions(motion.skeleton, pose) - JointPositions(motion.skeleton, motion.frames.back());
  EXPECT_LT(error_m.colwise().norm().mean(), 0.15);
}

TEST(PathReconstruction, SaysWhatIsWrong) {
  const World world;
  const PathSearch search(world.database);
  EXPECT_THROW(PathReconstruction(world.database, search, {.bandwidth = 0.0}), InputError);
  EXPECT_THROW(PathReconstruction(world.database, search, {.shrinkage = 0.0}), InputError);
  EXPECT_THROW(PathReconstruction(world.database, search, {.change_sigma_factor = -1.0}),
               InputError);
  PathReconstruction method(world.database, search);
  EXPECT_THROW(method.Next({}), std::invalid_argument);
  EXPECT_THROW(method.Begin(world.Gait(1, 0.5).frames), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
