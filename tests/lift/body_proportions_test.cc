// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Proportions planted on the made-up skeleton, and the prior against the skeletons
// of real subjects.
#include "lift/body_proportions.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "lift/normalize.h"
#include "lift/train/training_poses.h"
#include "src/forward_kinematics.h"
#include "src/io/asf.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;

GroupVector MadeUpRatios() {
  GroupVector ratios;
  ratios << 0.02, 0.08, 0.05, -0.1, -0.04, 0.03, -0.06, 0.01, 0.12;
  return ratios;
}

TEST(BodyProportions, LengthsFollowTheRatiosOnBothSides) {
  const Skeleton standard = testing::TrimmedCmuLikeSkeleton();
  const Skeleton body = WithProportions(standard, MadeUpRatios());
  const Eigen::VectorXd lengths_m = BoneLengths(body), standard_m = BoneLengths(standard);
  for (int j = 1; j < kNumJoints; ++j)
    EXPECT_NEAR(lengths_m[j], standard_m[j] * std::exp(MadeUpRatios()[GroupOfJoint(j)]), 1e-12);
  EXPECT_TRUE(MatrixNear(LogRatios(lengths_m, standard_m), MadeUpRatios(), 1e-12));
  EXPECT_TRUE(MatrixNear(BoneLengths(WithBoneLengths(standard, lengths_m)), lengths_m, 1e-12));
}

TEST(BodyProportions, StatureDropsOut) {
  const Eigen::VectorXd standard_m = BoneLengths(testing::TrimmedCmuLikeSkeleton());
  const BodyProportions body = {MadeUpRatios(), ProportionPrior().covariance};
  const BodyProportions taller = {MadeUpRatios().array() + 0.3, body.covariance};
  EXPECT_NEAR(LogStature(taller.log_ratios, standard_m),
              LogStature(body.log_ratios, standard_m) + 0.3, 1e-12);
  const BodyProportions even = AtEqualStature(body, standard_m);
  EXPECT_NEAR(LogStature(even.log_ratios, standard_m), 0.0, 1e-12);
  EXPECT_TRUE(MatrixNear(AtEqualStature(taller, standard_m).log_ratios, even.log_ratios, 1e-12));
  // What is unsure of the size does not make proportions unsure.
  const BodyProportions size_alone = {MadeUpRatios(), GroupMatrix::Constant(0.01)};
  EXPECT_LT(AtEqualStature(size_alone, standard_m).covariance.norm(), 1e-12);
}

TEST(BodyProportions, ThePriorIsAGaussian) {
  const GroupMatrix covariance = ProportionPrior().covariance;
  EXPECT_EQ(covariance, covariance.transpose());
  EXPECT_EQ(covariance.llt().info(), Eigen::Success);
  EXPECT_TRUE(ProportionPrior().log_ratios.isZero());
}

// How its table came to be.
TEST(BodyProportions, ThePriorIsThatOfTheTrainingSubjects) {
  POSELIFT_DATA_OR_SKIP(data);
  std::vector<Skeleton> skeletons;
  for (const char* subject : {"01", "02", "03", "05", "14", "17", "29"})
    skeletons.push_back(TrimToJoints(
        ReadAsfSkeleton(data / "mocap" / "cmu" / subject / (std::string(subject) + ".asf"))
            .skeleton));
  const Eigen::VectorXd standard_m = BoneLengths(MeanSkeleton(skeletons));
  GroupMatrix sample = GroupMatrix::Zero();
  for (const Skeleton& skeleton : skeletons) {
    GroupVector ratios = LogRatios(BoneLengths(skeleton), standard_m);
    ratios.array() -= LogStature(ratios, standard_m);
    sample += ratios * ratios.transpose() / static_cast<double>(skeletons.size());
  }
  const GroupMatrix shrunk =
      0.5 * sample + 0.5 * sample.trace() / kNumBoneGroups * GroupMatrix::Identity();
  const GroupMatrix size = GroupMatrix::Constant(0.01);
  EXPECT_TRUE(MatrixNear(ProportionPrior().covariance, shrunk + size, 2e-5));
}

}  // namespace
}  // namespace poselift
