// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/path_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kFrameTime_s = 1.0 / 60.0;
constexpr int kTrials = 3, kFrames = 120;
const std::vector<std::vector<Landmark::Part>> kPoints = {{{joint::kLeftHand, 1.0}},
                                                          {{joint::kRightAnkle, 1.0}}};

// A body that turns and swings its limbs, in a rhythm of its own.
Motion Walk(double rhythm) {
  Motion motion{TrimmedCmuLikeSkeleton(), kFrameTime_s, {}};
  for (int t = 0; t < kFrames; ++t) {
    SkeletonPose pose = SkeletonPose::Rest(motion.skeleton);
    for (Eigen::Index d = 0; d < pose.dofs.size(); ++d)
      pose.dofs[d] = 0.3 * std::sin(rhythm * t * kFrameTime_s + static_cast<double>(d));
    pose.root_in_world_m << 0.3 * std::sin(0.02 * t), 0.9 + 0.02 * std::sin(0.1 * t), 0.02 * t;
    pose.world_from_root = Eigen::AngleAxisd(0.01 * t, Eigen::Vector3d::UnitY());
    motion.frames.push_back(pose);
  }
  return motion;
}

MotionDatabase Walks() {
  MotionDatabase database;
  database.skeleton = TrimmedCmuLikeSkeleton();
  database.frame_time_s = kFrameTime_s;
  for (int i = 0; i < kTrials; ++i) database.Append("walk", MotionFeatures(Walk(5.0 + 2.0 * i)));
  return database;
}

// The query of a frame of the motion, whose last pose is the one before.
PathQuery QueryAt(const Motion& motion, int frame) {
  PathQuery query;
  for (int t = frame - 30; t <= frame; ++t) {
    const Pose3 joints_m = JointPositions(motion.skeleton, motion.frames[static_cast<size_t>(t)]);
    query.points_in_world_m.emplace_back(3, 2);
    for (int i = 0; i < 2; ++i)
      query.points_in_world_m.back().col(i) =
          SumOfJoints(kPoints[static_cast<size_t>(i)], joints_m);
  }
  query.pose = motion.frames[static_cast<size_t>(frame - 1)];
  query.features = MotionFeatures(motion).col(frame - 1);
  return query;
}

Motion Moved(Motion motion, double yaw_rad, const Eigen::Vector3d& shift_m) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()));
  for (SkeletonPose& pose : motion.frames) {
    pose.world_from_root = turn * pose.world_from_root;
    pose.root_in_world_m = turn * pose.root_in_world_m + shift_m;
  }
  return motion;
}

TEST(PathSearch, FindsTheFrameAndItsRootWhereverThePathLies) {
  const MotionDatabase database = Walks();
  const PathSearch search(database, {.num_nearest = 5});
  PointPaths paths = search.Paths(kPoints);
  std::vector<PathMatch> matches;
  for (int trial = 0; trial < kTrials; ++trial)
    for (const double yaw_rad : {0.0, 1.3, -3.0}) {
      const Motion motion = Moved(Walk(5.0 + 2.0 * trial), yaw_rad, {3.0, 0.0, -20.0});
      search.FindNearest(QueryAt(motion, 64), &paths, &matches);
      ASSERT_EQ(matches.size(), 5u);
      EXPECT_EQ(matches[0].frame, trial * kFrames + 64);
      EXPECT_LT(matches[0].energy, 0.02);
      EXPECT_GT(matches[1].energy, 0.1);
      EXPECT_TRUE(MatrixNear(matches[0].root_in_world_m, motion.frames[64].root_in_world_m, 1e-3));
      EXPECT_NEAR(std::remainder(matches[0].yaw_rad - Yaw(motion.frames[64].world_from_root),
                                 2.0 * std::numbers::pi),
                  0.0, 2e-3);
    }
}

// The energy as the header has it, on a grid of turns, the shift being the best.
TEST(PathSearch, EnergyIsTheLeastOfItsEquation) {
  const MotionDatabase database = Walks();
  const PathSearchOptions options{.num_nearest = 1};
  const PathSearch search(database, options);
  PointPaths paths = search.Paths(kPoints);
  std::vector<PathMatch> matches;
  const PathQuery query = QueryAt(Walk(6.2), 50);
  search.FindNearest(query, &paths, &matches);
  ASSERT_EQ(matches.size(), 1u);
  const int trial = matches[0].frame / kFrames, frame = matches[0].frame % kFrames;
  const Motion walk = Walk(5.0 + 2.0 * trial);
  const PathQuery found = QueryAt(walk, frame);
  FeatureVector weights = RowWeights(database);
  weights.tail<3>() *= 0.3;
  const double pose_energy =
      options.pose_weight * weights.cwiseProduct(found.features - query.features).squaredNorm();
  double least = 1e300;
  for (double yaw_rad = -3.14; yaw_rad < 3.14; yaw_rad += 0.002) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
    double sum = 0.0, square = 0.0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int lag : {0, 2, 6, 12, 18, 24, 30})
      for (int i = 0; i < 2; ++i) {
        const double weight = std::exp(-lag / options.decay_frames);
        const size_t at = static_cast<size_t>(30 - lag);
        const Eigen::Vector3d difference =
            query.points_in_world_m[at].col(i) - turn * found.points_in_world_m[at].col(i);
        sum += weight;
        mean += weight * Eigen::Vector3d(difference.x(), 0.0, difference.z());
        square += weight * difference.squaredNorm();
      }
    const double path = square / sum - (mean / sum).squaredNorm();
    const double heading =
        std::remainder(yaw_rad + Yaw(found.pose.world_from_root) - Yaw(query.pose.world_from_root),
                       2.0 * std::numbers::pi);
    least = std::min(least, path / std::pow(options.path_sigma_m, 2) +
                                std::pow(heading / options.heading_sigma_rad, 2));
  }
  EXPECT_NEAR(matches[0].energy, least + pose_energy, 2e-3 * (1.0 + least));
}

TEST(PathSearch, KeepsItsMatchesApart) {
  const MotionDatabase database = Walks();
  const PathSearch search(database, {.num_nearest = 6, .exclusion_frames = 20});
  PointPaths paths = search.Paths(kPoints);
  std::vector<PathMatch> matches;
  search.FindNearest(QueryAt(Walk(6.0), 64), &paths, &matches);
  ASSERT_GT(matches.size(), 2u);
  for (size_t a = 0; a < matches.size(); ++a)
    for (size_t b = 0; b < a; ++b) {
      EXPECT_GT(std::abs(matches[a].frame - matches[b].frame), 20);
      EXPECT_GE(matches[a].energy, matches[b].energy);
    }
}

TEST(PathSearch, SaysWhatIsWrong) {
  const MotionDatabase database = Walks();
  EXPECT_THROW(PathSearch(database, {.num_nearest = 0}), InputError);
  EXPECT_THROW(PathSearch(database, {.num_nearest = 50, .num_candidates = 49}), InputError);
  EXPECT_THROW(PathSearch(database, {.path_sigma_m = 0.0}), InputError);
  EXPECT_THROW(PathSearch(database, {.heading_sigma_rad = -1.0}), InputError);
  const PathSearch search(database);
  PointPaths paths = search.Paths(kPoints);
  std::vector<PathMatch> matches;
  EXPECT_THROW(search.FindNearest({}, &paths, &matches), std::invalid_argument);
  PathQuery query;
  query.points_in_world_m.emplace_back(Eigen::Matrix3Xd::Zero(3, 1));
  EXPECT_THROW(search.FindNearest(query, &paths, &matches), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
