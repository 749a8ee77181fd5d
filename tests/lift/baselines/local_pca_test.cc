// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up gaits (tests/support/made_up_gaits.h): the database has gaits of one
// kind, the test walks another of that kind, seen at its wrists and ankles.
#include "lift/baselines/local_pca.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lift/baselines/frame_ik.h"
#include "lift/eval/evaluate_motion.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectToMoveAlong;
using testing::MadeUpGaits;
using testing::ObserveHandAndFoot;

struct World {
  World()
      : database(gaits.Database(12, 120)),
        search(database, RowWeights(database), {.num_nearest = 100}) {}

  std::vector<MotionEvaluation> Evaluate(const NamedMotionMethod& method) const {
    EvaluateMotionOptions options;
    options.control_points = {PaperControlPoints()[2]};
    return EvaluateMotion({method}, {{"walking", "another", gaits.Gait(100, 0.47)}}, options, {});
  }

  NamedMotionMethod Pca(const LocalPcaOptions& options = {}) const {
    return {"local PCA",
            [this, options] { return std::make_unique<LocalPca>(database, search, options); }};
  }

  MadeUpGaits gaits;
  MotionDatabase database;
  SegmentSearch search;
};

TEST(LocalPca, BeatsInverseKinematicsOnMotionsOfItsKind) {
  const World world;
  const auto pca = world.Evaluate(world.Pca());
  const auto ik = world.Evaluate({"", [&] {
                                    return std::make_unique<FrameIk>(world.database.skeleton,
                                                                     world.database.frame_time_s,
                                                                     FeatureVector::Constant(0.05));
                                  }});
  EXPECT_LT(pca[0].position_mm, 0.5 * ik[0].position_mm);
  EXPECT_LT(pca[0].position_mm, 15.0);
}

// The answer's features are the examples' mean and a sum of their directions: what
// no example does, it does not.
TEST(LocalPca, StaysInTheSubspaceOfTheExamples) {
  World world;
  constexpr int kStill = 7;
  world.database.features.row(kStill).setConstant(0.25f);
  const SegmentSearch search(world.database, RowWeights(world.database), {.num_nearest = 100});
  LocalPca method(world.database, search);
  const Motion motion = world.gaits.Gait(20, 0.3);
  method.Begin({motion.frames.begin(), motion.frames.begin() + 4});
  for (size_t t = 4; t < motion.frames.size(); ++t) {
    const SkeletonPose pose = method.Next(ObserveHandAndFoot(motion, t));
    EXPECT_NEAR(pose.dofs[kStill], 0.25, 1e-6);
  }
}

// A prior so tight that only the mean is left.
TEST(LocalPca, IsTheMeanOfTheExamplesWhenThePriorIsAllThatCounts) {
  const World world;
  const Motion motion = world.gaits.Gait(6, 0.3);
  LocalPca method(world.database, world.search,
                  {.num_neighbours = 100, .prior_sigma_factor = 1e-6, .smoothness_sigma = 1e3});
  method.Begin({motion.frames.begin(), motion.frames.begin() + 4});
  const SkeletonPose pose = method.Next(ObserveHandAndFoot(motion, 4));
  const FeatureMatrix past = MotionFeatures(
      {motion.skeleton, motion.frame_time_s, {motion.frames.begin(), motion.frames.begin() + 4}});
  SearchCursor cursor;
  std::vector<SegmentMatch> matches;
  world.search.FindNearest(past.rightCols(2), &cursor, &matches);
  FeatureVector mean = FeatureVector::Zero();
  for (const SegmentMatch& match : matches)
    mean += world.database.features.col(match.end_frame + 1).cast<double>() /
            static_cast<double>(matches.size());
  EXPECT_TRUE(testing::MatrixNear(pose.dofs, mean.head<kNumAngles>(), 1e-5));
}

// A smoothness so strict that it goes on as it went.
TEST(LocalPca, GoesOnSteadilyWhenSmoothnessIsAllThatCounts) {
  const World world;
  const Motion motion = world.gaits.Gait(6, 0.3);
  LocalPca method(world.database, world.search,
                  {.variance_kept = 1.0, .prior_sigma_factor = 1e6, .smoothness_sigma = 1e-6});
  method.Begin({motion.frames.begin(), motion.frames.begin() + 4});
  const SkeletonPose pose = method.Next(ObserveHandAndFoot(motion, 4));
  const Eigen::VectorXd steady = 2.0 * motion.frames[3].dofs - motion.frames[2].dofs;
  // The gaits span 4 directions of 40: as near as these allow.
  EXPECT_TRUE(testing::MatrixNear(pose.dofs, steady, 2e-3));
}

TEST(LocalPca, GivesTheSameEveryTime) {
  const World world;
  const auto a = world.Evaluate(world.Pca());
  const auto b = world.Evaluate(world.Pca());
  EXPECT_EQ(a[0].position_mm, b[0].position_mm);
  EXPECT_EQ(a[0].angle_deg, b[0].angle_deg);
}

TEST(LocalPca, DoesNotDependOnPlaceAndHeading) {
  const World world;
  LocalPca here(world.database, world.search), there(world.database, world.search);
  ExpectToMoveAlong(world.gaits.Gait(12, 0.3), &here, &there);
}

TEST(LocalPca, GoesOnWithoutObservations) {
  const World world;
  LocalPca method(world.database, world.search);
  const Motion motion = world.gaits.Gait(30, 0.3);
  method.Begin({motion.frames.begin(), motion.frames.begin() + 4});
  for (int t = 4; t < 30; ++t) EXPECT_TRUE(method.Next({}).dofs.allFinite());
}

TEST(LocalPca, SaysWhatIsWrong) {
  const World world;
  const auto make = [&](const LocalPcaOptions& options) {
    LocalPca(world.database, world.search, options);
  };
  EXPECT_THROW(make({.num_neighbours = 1}), InputError);
  EXPECT_THROW(make({.observed_scale_per_m = -1.0}), InputError);
  EXPECT_THROW(make({.variance_kept = 0.0}), InputError);
  EXPECT_THROW(make({.variance_kept = NAN}), InputError);
  EXPECT_THROW(make({.prior_sigma_factor = 0.0}), InputError);
  EXPECT_THROW(make({.smoothness_sigma = INFINITY}), InputError);
  LocalPca method(world.database, world.search);
  EXPECT_THROW(method.Next({}), std::invalid_argument);
  EXPECT_THROW(method.Begin(world.gaits.Gait(2, 0.5).frames), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
