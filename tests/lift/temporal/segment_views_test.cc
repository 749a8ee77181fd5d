// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/segment_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lift/temporal/local_pose.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MadeUpGaits;
using testing::MatrixNear;

const std::vector<std::vector<Landmark::Part>> kPoints = {
    {{joint::kPelvis, 1.0}},
    {{joint::kLeftHand, 1.0}},
    {{joint::kRightHand, 1.0}},
    {{joint::kLeftAnkle, 1.0}},
    {{joint::kRightAnkle, 1.0}},
    {{joint::kHeadTop, 1.0}},
    {{joint::kLeftKnee, 0.5}, {joint::kRightKnee, 0.5}}};

MotionCodebook Codebook() { return SegmentsOf(MadeUpGaits().Database(6, 120), 3); }

SkeletonPose Sample(const MotionCodebook& codebook, int segment, int k) {
  return PoseOfSample(
      codebook.segments.col(segment).segment<kNumFeatures>(k * kNumFeatures).cast<double>());
}

// What a level camera sees of a segment that is turned by psi.
SegmentViews::Query Seen(const MotionCodebook& codebook, int segment, double psi_rad) {
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(psi_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  SegmentViews::Query query(3, 0);
  for (int k = 0; k < kSegmentSamples; ++k) {
    const Pose3 joints_m = JointPositions(codebook.skeleton, Sample(codebook, segment, k));
    for (const auto& parts : kPoints) {
      query.conservativeResize(Eigen::NoChange, query.cols() + 1);
      query.rightCols<1>() =
          turned * SumOfJoints(parts, joints_m) + Eigen::Vector3d(3.0, -2.0, 0.7);
    }
  }
  return query;
}

TEST(SegmentViews, FindsTheSegmentAndHowItIsTurned) {
  const MotionCodebook codebook = Codebook();
  const SegmentViews views(codebook, kPoints);
  std::vector<SegmentViews::Query> queries;
  const std::vector<int> planted = {0, 17, codebook.NumSegments() - 1};
  const std::vector<double> turns_rad = {0.4, -2.0, 3.0};
  for (size_t i = 0; i < planted.size(); ++i)
    queries.push_back(Seen(codebook, planted[i], turns_rad[i]));
  const auto nearest = views.FindNearest(queries, 0.4, 3);
  for (size_t i = 0; i < planted.size(); ++i) {
    ASSERT_EQ(nearest[i].size(), 3U);
    EXPECT_EQ(nearest[i][0].segment, planted[i]);
    EXPECT_NEAR(std::remainder(nearest[i][0].psi_rad - turns_rad[i], 2.0 * std::numbers::pi), 0.0,
                1e-3);
    EXPECT_NEAR(nearest[i][0].mean_squared_m2, 0.0, 1e-6);
    EXPECT_LE(nearest[i][0].mean_squared_m2, nearest[i][1].mean_squared_m2);
  }
}

TEST(SegmentViews, NoOtherTurnIsNearer) {
  const MotionCodebook codebook = Codebook();
  SegmentViews::Query query = Seen(codebook, 5, 1.0);
  auto rng = testing::TestRng();
  query += 0.05 * testing::RandomMatrix(3, query.cols(), &rng);
  const SegmentViews still(codebook, kPoints, {.path_weight = 0.0});
  const auto nearest = still.FindNearest({query}, 0.4, 5)[0];
  for (const SegmentView& found : nearest) {
    const auto distance = [&](double psi_rad) {
      SegmentViews::Query a = query, b = Seen(codebook, found.segment, psi_rad);
      const auto count = std::ssize(kPoints);
      for (SegmentViews::Query* points : {&a, &b})
        for (int k = 0; k < kSegmentSamples; ++k) {
          const Eigen::Vector3d mean = points->middleCols(k * count, count).rowwise().mean();
          points->middleCols(k * count, count).colwise() -= mean;
        }
      const Eigen::Matrix3Xd difference = Eigen::Vector3d(1.0, 1.0, 0.4).asDiagonal() * (a - b);
      return difference.squaredNorm() / static_cast<double>(a.cols());
    };
    EXPECT_NEAR(found.mean_squared_m2, distance(found.psi_rad), 1e-5);
    for (double psi_rad = -3.1; psi_rad < 3.2; psi_rad += 0.05)
      EXPECT_GE(distance(psi_rad), found.mean_squared_m2 - 1e-5);
  }
}

TEST(SegmentViews, RefusesAPathWeightBeyondOne) {
  EXPECT_THROW(SegmentViews(Codebook(), kPoints, {.path_weight = 1.5}), InputError);
}

TEST(LocalPose, IsTheOnlyNeighbourSeenFromItsSide) {
  const MotionCodebook codebook = Codebook();
  const LocalPose local = MakeLocalPose(codebook, {{7, 0.8, 0.0}}, 0.4);
  const SkeletonPose middle = Sample(codebook, 7, kMiddleSample);
  EXPECT_TRUE(MatrixNear(local.prediction.pose.dofs, middle.dofs, 1e-9));
  Pose3 joints_m = JointPositions(codebook.skeleton, middle);
  joints_m.colwise() -= Eigen::Vector3d(joints_m.col(joint::kPelvis));
  const Eigen::Matrix3d cam_from_body =
      Eigen::Vector3d(1, -1, -1).asDiagonal() *
      Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_TRUE(MatrixNear(JointPositions(codebook.skeleton, local.prediction.pose),
                         cam_from_body * joints_m, 1e-9));
  EXPECT_TRUE(MatrixNear(local.rate_rad_per_s,
                         codebook.rates.col(7).head<kNumAngles>().cast<double>(), 1e-9));
}

TEST(LocalPose, IsLessSureTheFartherItsNeighboursAre) {
  const MotionCodebook codebook = Codebook();
  double before = 0.0;
  for (const double distance_m : {0.2, 0.1, 0.05, 0.0}) {
    const LocalPose local =
        MakeLocalPose(codebook, {{7, 0.8, distance_m * distance_m}}, 0.4, {.label_sigma_m = 0.0});
    EXPECT_GT(local.prediction.whitening.norm(), before);
    before = local.prediction.whitening.norm();
  }
}

TEST(LocalPose, IsBetweenItsNeighboursByTheirWeights) {
  const MotionCodebook codebook = Codebook();
  const LocalPoseOptions options{.bandwidth_m = 0.1};
  const double farther_m2 = 2.0 * 0.1 * 0.1 * std::log(3.0);  // a weight of 1/4
  const LocalPose local =
      MakeLocalPose(codebook, {{3, 0.5, 0.0}, {9, 0.5, farther_m2}}, 0.4, options);
  const Eigen::VectorXd wanted = 0.75 * Sample(codebook, 3, kMiddleSample).dofs +
                                 0.25 * Sample(codebook, 9, kMiddleSample).dofs;
  EXPECT_TRUE(MatrixNear(local.prediction.pose.dofs, wanted, 1e-6));
}

}  // namespace
}  // namespace poselift
