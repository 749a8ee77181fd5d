// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Planted clusters of segments: found again, with their means and deviations.
#include "lift/train/train_codebook.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/forward_kinematics.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kSigma = 0.01;

// Segments about given means, one after the other in turn.
struct Planted {
  MotionCodebook means;
  MotionCodebook segments;
};

Planted Plant(int num_cells, int num_segments, std::mt19937_64* rng) {
  Planted planted;
  planted.means.skeleton = planted.segments.skeleton = TrimmedCmuLikeSkeleton();
  planted.means.segments = (0.5 * RandomMatrix(kSegmentRows, num_cells, rng)).cast<float>();
  planted.means.rates = RandomMatrix(kNumFeatures, num_cells, rng).cast<float>();
  planted.segments.segments =
      (kSigma * RandomMatrix(kSegmentRows, num_segments, rng)).cast<float>();
  planted.segments.rates = (kSigma * RandomMatrix(kNumFeatures, num_segments, rng)).cast<float>();
  planted.segments.deviations.setZero(kNumFeatures, num_segments);
  planted.segments.accelerations = AccelerationModels::Zero(num_segments);
  for (int j = 0; j < num_segments; ++j) {
    planted.segments.segments.col(j) += planted.means.segments.col(j % num_cells);
    planted.segments.rates.col(j) += planted.means.rates.col(j % num_cells);
  }
  return planted;
}

TEST(TrainCodebook, FindsPlantedCells) {
  auto rng = TestRng();
  const auto [means, segments] = Plant(6, 6 * 200, &rng);
  CodebookReport report;
  double done = 0.0;
  const MotionCodebook codebook = TrainCodebook(
      segments, {.num_segments = 6, .iterations = 50}, [&](double part) { done = part; }, &report);
  ASSERT_EQ(codebook.NumSegments(), 6);
  EXPECT_EQ(report.members, std::vector<int>(6, 200));
  EXPECT_GT(done, 0.0);
  for (int k = 0; k < 6; ++k) {
    Eigen::Index found = 0;
    (codebook.segments.colwise() - means.segments.col(k)).colwise().squaredNorm().minCoeff(&found);
    EXPECT_TRUE(MatrixNear(codebook.segments.col(found).cast<double>(),
                           means.segments.col(k).cast<double>(), 4e-3));
    EXPECT_TRUE(MatrixNear(codebook.rates.col(found).cast<double>(),
                           means.rates.col(k).cast<double>(), 4e-3));
  }
  const Eigen::ArrayXXd deviations = codebook.deviations.cast<double>();
  EXPECT_GT(deviations.minCoeff(), 0.75 * kSigma);
  EXPECT_LT(deviations.maxCoeff(), 1.25 * kSigma);
  EXPECT_NEAR(deviations.mean(), kSigma, 0.02 * kSigma);
  EXPECT_EQ(codebook.record.num_segments, 1200);
  EXPECT_NEAR(codebook.record.rms_error_mm, 1e3 * report.rms_error_m, 1e-12);
}

// Its own variance is nought, which nobody should believe.
TEST(TrainCodebook, ALonelyMemberHasTheUsualDeviation) {
  auto rng = TestRng();
  auto [means, segments] = Plant(3, 3 * 100 + 1, &rng);
  segments.segments.col(300).setConstant(1.5f);
  CodebookReport report;
  const MotionCodebook codebook = TrainCodebook(
      segments, {.num_segments = 4, .iterations = 50, .least_members = 1}, {}, &report);
  const auto lonely = std::find(report.members.begin(), report.members.end(), 1);
  ASSERT_NE(lonely, report.members.end());
  const auto k = lonely - report.members.begin();
  EXPECT_EQ(codebook.segments.col(k), segments.segments.col(300));
  EXPECT_TRUE(MatrixNear(codebook.deviations.col(k).cast<double>(),
                         Eigen::VectorXd::Constant(kNumFeatures, kSigma), 0.2 * kSigma));
}

TEST(TrainCodebook, MembersOfSmallCellsJoinTheNearest) {
  auto rng = TestRng();
  auto [means, segments] = Plant(3, 3 * 100 + 2, &rng);
  for (const int j : {300, 301}) {  // two strangers, nearest to the first cell
    segments.segments.col(j) = means.segments.col(0).array() + 1.0f;
    segments.rates.col(j) = means.rates.col(0);
  }
  CodebookReport report;
  const auto train = [&](int least) {
    TrainCodebook(segments, {.num_segments = 4, .iterations = 50, .least_members = least}, {},
                  &report);
    std::sort(report.members.begin(), report.members.end());
    return report.members;
  };
  EXPECT_EQ(train(2), (std::vector<int>{2, 100, 100, 100}));
  EXPECT_EQ(train(3), (std::vector<int>{100, 100, 102}));
  EXPECT_EQ(train(1000), (std::vector<int>{2, 100, 100, 100}));  // all are small
}

TEST(TrainCodebook, SameSeedSameBitsWhateverTheThreads) {
  auto rng = TestRng();
  const MotionCodebook segments = Plant(40, 700, &rng).segments;
  const auto train = [&](std::uint64_t seed) {
    CodebookReport report;
    return TrainCodebook(segments, {.num_segments = 50, .seed = seed}, {}, &report);
  };
  const MotionCodebook codebook = train(1);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const MotionCodebook by_one = train(1);
  omp_set_num_threads(threads);
  EXPECT_EQ(codebook.segments, by_one.segments);
  EXPECT_EQ(codebook.rates, by_one.rates);
  EXPECT_EQ(codebook.deviations, by_one.deviations);
  const MotionCodebook other = train(2);
  EXPECT_TRUE(other.segments.size() != codebook.segments.size() ||
              other.segments != codebook.segments);
}

TEST(TrainCodebook, HasNoMoreCellsThanSegments) {
  auto rng = TestRng();
  const MotionCodebook segments = Plant(5, 9, &rng).segments;
  CodebookReport report;
  const MotionCodebook codebook =
      TrainCodebook(segments, {.num_segments = 50, .least_members = 1}, {}, &report);
  EXPECT_EQ(codebook.NumSegments(), 9);
  EXPECT_EQ(report.rms_error_m, 0.0);
  EXPECT_TRUE(codebook.deviations.isZero(0.0f));
}

TEST(TrainCodebook, OptionsAreChecked) {
  EXPECT_EQ(CodebookOptions{}.Validate(), "");
  EXPECT_NE(CodebookOptions{.num_segments = 0}.Validate(), "");
  EXPECT_NE(CodebookOptions{.iterations = 0}.Validate(), "");
  EXPECT_NE(CodebookOptions{.least_members = 0}.Validate(), "");
}

TEST(MeanDistanceToNearest, IsHowFarTheNearestIsMovedAway) {
  auto rng = TestRng();
  const MotionCodebook codebook = Plant(30, 30, &rng).segments;
  MotionCodebook captured = codebook;
  EXPECT_NEAR(MeanDistanceToNearest_m(captured, codebook), 0.0, 1e-9);
  const int height = kMiddleSample * kNumFeatures + feature::kHeight;
  captured.segments.row(height).array() += 0.003f;
  captured.segments(height, 0) += 0.003f;
  EXPECT_NEAR(MeanDistanceToNearest_m(captured, codebook), 0.003 * 31.0 / 30.0, 1e-6);
}

}  // namespace
}  // namespace poselift
