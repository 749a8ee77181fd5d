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
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kFrameTime_s = 1.0 / 60.0;

struct World {
  World() : rng(TestRng()), mixture(0.15 * RandomMatrix(kNumAngles, 4, &rng)) {
    database.skeleton = TrimmedCmuLikeSkeleton();
    database.frame_time_s = kFrameTime_s;
    for (int i = 0; i < 12; ++i) {
      const double share = (i + 0.5) / 12;
      database.Append("gait", MotionFeatures(Gait(120, share)));
    }
    weights = RowWeights(database);
  }

  // share, 0 ... 1: which gait of the kind.
  Motion Gait(int num_frames, double share) const {
    Motion motion{TrimmedCmuLikeSkeleton(), kFrameTime_s, {}};
    for (int t = 0; t < num_frames; ++t) {
      const double phase = 6.0 * t * kFrameTime_s + 6.0 * share;
      const Eigen::Vector4d waves(std::sin(phase), std::cos(phase), std::sin(2 * phase) * share,
                                  share);
      SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
      pose.dofs += mixture * waves;
      pose.root_in_world_m << 0.0, 0.9 + 0.03 * std::sin(2 * phase), 1.2 * t * kFrameTime_s;
      pose.world_from_root = Eigen::AngleAxisd(0.3 * std::sin(phase), Eigen::Vector3d::UnitY());
      motion.frames.push_back(pose);
    }
    return motion;
  }

  std::vector<MotionEvaluation> Evaluate(const NamedMotionMethod& method) const {
    EvaluateMotionOptions options;
    options.control_points = {PaperControlPoints()[2]};
    return EvaluateMotion({method}, {{"walking", "another", Gait(100, 0.47)}}, options, {});
  }

  NamedMotionMethod Reconstruction(const SegmentSearch& search) const {
    return {"reconstruction",
            [&] { return std::make_unique<MotionReconstruction>(database, search); }};
  }

  std::mt19937_64 rng;
  Eigen::MatrixXd mixture;
  MotionDatabase database;
  FeatureVector weights;
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
  const Motion motion = world.Gait(12, 0.3);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d shift_m(3.0, 0.0, -2.0);
  Motion moved = motion;
  for (SkeletonPose& pose : moved.frames) {
    pose.world_from_root = turn * pose.world_from_root;
    pose.root_in_world_m = turn * pose.root_in_world_m + shift_m;
  }
  MotionReconstruction here(world.database, search);
  MotionReconstruction there(world.database, search);
  here.Begin({motion.frames.begin(), motion.frames.begin() + 4});
  there.Begin({moved.frames.begin(), moved.frames.begin() + 4});
  for (size_t t = 4; t < motion.frames.size(); ++t) {
    const Pose3 joints_m = JointPositions(motion.skeleton, motion.frames[t]);
    std::vector<TargetPoint> observed;
    for (int j : {joint::kLeftHand, joint::kRightAnkle})
      observed.push_back({{{j, 1.0}}, joints_m.col(j), 200.0});
    std::vector<TargetPoint> observed_there = observed;
    for (TargetPoint& point : observed_there) point.x = turn * point.x + shift_m;
    const SkeletonPose a = here.Next(observed), b = there.Next(observed_there);
    EXPECT_TRUE(MatrixNear(a.dofs, b.dofs, 1e-4));
    EXPECT_TRUE(MatrixNear(turn * a.root_in_world_m + shift_m, b.root_in_world_m, 1e-4));
  }
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
