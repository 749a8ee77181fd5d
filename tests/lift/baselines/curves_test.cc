// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Runs between gaps on small made-up matrices.
#include "lift/baselines/curves.h"

#include <gmock/gmock.h>

#include "src/input_error.h"
#include "tests/support/motion_curves.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::kInfinity;
using testing::kNaN;
using testing::SameCurves;
using ::testing::ThrowsMessage;

TEST(Curves, EveryRunOfValuesIsSmoothedOnItsOwnAndGapsStay) {
  Eigen::MatrixXd curves(4, 5);
  curves << 1, 2, kNaN, 4, 5,  //
      kNaN, 7, 8, 9, kNaN,     //
      kNaN, kNaN, kNaN, kNaN, kNaN, 3, 1, 4, 1, 5;
  Eigen::MatrixXd reversed(4, 5);
  reversed << 2, 1, kNaN, 5, 4,  //
      kNaN, 9, 8, 7, kNaN,       //
      kNaN, kNaN, kNaN, kNaN, kNaN, 5, 1, 4, 1, 3;
  const auto reverse = [](Eigen::VectorXd* run) { run->reverseInPlace(); };
  EXPECT_TRUE(SameCurves(SmoothRuns(curves, reverse), reversed));
}

TEST(Curves, NothingIsHandedOutWhereThereIsNothing) {
  const auto fail = [](Eigen::VectorXd*) { FAIL(); };
  for (const auto& [rows, cols] : {std::pair{0, 5}, {3, 0}, {0, 0}}) {
    const Eigen::MatrixXd smoothed = SmoothRuns(Eigen::MatrixXd(rows, cols), fail);
    EXPECT_EQ(smoothed.rows(), rows);
    EXPECT_EQ(smoothed.cols(), cols);
  }
  SmoothRuns(Eigen::MatrixXd::Constant(2, 3, kNaN), fail);
}

TEST(Curves, AnInfiniteEntryIsNamed) {
  Eigen::MatrixXd curves = Eigen::MatrixXd::Zero(2, 4);
  curves(1, 2) = -kInfinity;
  EXPECT_THAT([&] { RequireCurves(curves); },
              ThrowsMessage<InputError>(HasSubstr("channel 1, frame 2")));
  EXPECT_THROW(SmoothRuns(curves, [](Eigen::VectorXd*) {}), InputError);
}

TEST(Curves, AFrameRateIsAPositiveNumber) {
  EXPECT_NO_THROW(RequireFrameRate(29.97));
  for (const double bad : {0.0, -30.0, kNaN, kInfinity})
    EXPECT_THROW(RequireFrameRate(bad), InputError);
}

}  // namespace
}  // namespace poselift
