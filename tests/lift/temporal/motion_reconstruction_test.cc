// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up gaits: a few waves move all angles and carry the body over the floor.
// The database has gaits of one kind, the test walks another of that kind, seen
// at its wrists and ankles.
#include "lift/temporal/motion_reconstruction.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lift/baselines/frame_ik.h"
#include "lift/eval/evaluate_motion.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"

namespace poselift {
namespace {

constexpr double kFrameTime_s = 1.0 / 60.0;

struct World : testing::MadeUpGaits {
  std::vector<MotionEvaluation> Evaluate(const NamedMotionMethod& method) const {
    EvaluateMotionOptions options;
    options.control_points = {PaperControlPoints()[2]};
    return EvaluateMotion({method}, {{"walking", "another", Gait(100, 0.47)}}, options, {});
  }

  NamedMotionMethod Reconstruction(const SegmentSearch& search) const {
    return {"reconstruction",
            [&] { return std::make_unique<MotionReconstruction>(database, search); }};
  }

  const MotionDatabase database = Database(12, 120);
  const FeatureVector weights = RowWeights(database);
};

// Says what it is told.
class KnowsIt : public MotionMethod {
 public:
  KnowsIt(Motion truth, double shift_m) : truth_(std::move(truth)), shift_m_(shift_m) {}
  void Begin(const std::vector<SkeletonPose>& first) override { next_ = first.size(); }
  SkeletonPose Next(const std::vector<TargetPoint>& observed) override {
    EXPECT_EQ(observed.size(), 4u);
    SkeletonPose pose = truth_.frames[next_++];
    pose.root_in_world_m.y() += shift_m_;
    return pose;
  }

 private:
  Motion truth_;
  double shift_m_;
  size_t next_ = 0;
};

TEST(EvaluateMotion, MeasuresKnownErrors) {
  const World world;
  const auto rows =
      world.Evaluate({"", [&] { return std::make_unique<KnowsIt>(world.Gait(100, 0.47), 0.05); }});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].num_frames, 96);
  EXPECT_NEAR(rows[0].position_mm, 50.0, 1e-9);
  EXPECT_NEAR(rows[0].angle_deg, 0.0, 1e-9);
  // The error appears once and stays: second differences of 1 and -1.
  EXPECT_NEAR(rows[0].acceleration_mm, 2 * 50.0 / 96, 1e-9);
}

TEST(MotionReconstruction, BeatsInverseKinematicsOnMotionsOfItsKind) {
  const World world;
  const SegmentSearch search(world.database, world.weights, {.num_nearest = 100});
  const auto ours = world.Evaluate(world.Reconstruction(search));
  const auto ik =
      world.Evaluate({"", [&] {
                        return std::make_unique<FrameIk>(world.database.skeleton, kFrameTime_s,
                                                         FeatureVector::Constant(0.05));
                      }});
  EXPECT_LT(ours[0].position_mm, 0.5 * ik[0].position_mm);
  EXPECT_LT(ours[0].position_mm, 15.0);
}

TEST(MotionReconstruction, GivesTheSameEveryTime) {
  const World world;
  const SegmentSearch search(world.database, world.weights, {.num_nearest = 100});
  const auto a = world.Evaluate(world.Reconstruction(search));
  const auto b = world.Evaluate(world.Reconstruction(search));
  EXPECT_EQ(a[0].position_mm, b[0].position_mm);
  EXPECT_EQ(a[0].angle_deg, b[0].angle_deg);
}

// Moved over the floor and turned about the vertical, everything moves along.
TEST(MotionReconstruction, DoesNotDependOnPlaceAndHeading) {
  const World world;
  const SegmentSearch search(world.database, world.weights, {.num_nearest = 100});
  MotionReconstruction here(world.database, search), there(world.database, search);
  testing::ExpectToMoveAlong(world.Gait(12, 0.3), &here, &there);
}

TEST(MotionReconstruction, GoesOnWithoutObservations) {
  const World world;
  const SegmentSearch search(world.database, world.weights, {.num_nearest = 100});
  MotionReconstruction method(world.database, search);
  const Motion motion = world.Gait(30, 0.3);
  method.Begin({motion.frames.begin(), motion.frames.begin() + 4});
  SkeletonPose pose;
  for (int t = 4; t < 30; ++t) pose = method.Next({});
  const Pose3 error_m =
      JointPositions(motion.skeleton, pose) - JointPositions(motion.skeleton, motion.frames.back());
  EXPECT_LT(error_m.colwise().norm().mean(), 0.1);
}

TEST(MotionReconstruction, SaysWhatIsWrong) {
  const World world;
  const SegmentSearch search(world.database, world.weights, {});
  MotionReconstructionOptions options;
  options.num_neighbours = 0;
  EXPECT_THROW(MotionReconstruction(world.database, search, options), InputError);
  options = {};
  options.regression.velocity_scale = 30.0;
  EXPECT_THROW(MotionReconstruction(world.database, search, options), InputError);
  MotionReconstruction method(world.database, search);
  EXPECT_THROW(method.Next({}), std::invalid_argument);
  EXPECT_THROW(method.Begin(world.Gait(2, 0.5).frames), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
