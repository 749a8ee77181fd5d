// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Planted single atoms: the closed form of a view against a direct evaluation,
// the view found, and mixtures in which one kind says nothing.
#include "lift/view_search.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::PlantPose;
using testing::RandomDictionary;
using testing::TestRng;

const RotationOptions kNoPrior{.prior_weight = {0, 0, 0}};

std::vector<ViewStart> Search(const ProjectionOperator& op, const Dictionary& dictionary,
                              const RotationOptions& prior = kNoPrior,
                              const ViewSearchOptions& options = {}) {
  return SearchViews(op, op.CentredPointsOfAll(dictionary.atoms), prior, options);
}

double AngleBetween(const Eigen::Vector3d& tau_a, const Eigen::Vector3d& tau_b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(CamFromBody(tau_a).transpose() * CamFromBody(tau_b)))
      .angle();
}

TEST(ViewSearch, CostIsTheResidualOfTheAtomAtItsBestScale) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 10; ++trial) {
    const Dictionary dictionary = RandomDictionary(15, &rng);
    const auto planted = PlantPose(dictionary, 3, &rng);
    const bool in_space = trial % 2 == 1;
    const ProjectionOperator op(in_space ? testing::ObserveInSpace(planted, 0.01)
                                         : testing::ObserveInPicture(planted, 2.0));
    for (const ViewStart& start : Search(op, dictionary)) {
      const Eigen::VectorXd rows =
          op.Apply(CamFromBody(start.tau_rad), 1.0, dictionary.atoms.col(start.atom));
      const double factor = rows.dot(op.target()) / rows.squaredNorm();
      EXPECT_NEAR(start.cost, (factor * rows - op.target()).squaredNorm(),
                  1e-9 * op.target().squaredNorm());
      EXPECT_NEAR(start.scale_px_per_unit, in_space ? 1.0 : factor, 1e-9 * factor);
    }
  }
}

TEST(ViewSearch, RollIsTheBestForItsViewAndAtom) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(15, &rng);
  const ProjectionOperator op(testing::ObserveInPicture(PlantPose(dictionary, 2, &rng), 2.0));
  for (const ViewStart& start : Search(op, dictionary))
    for (const double turn : {-0.01, 0.01, 1.0, M_PI}) {
      const Eigen::Matrix3d R = CamFromBody(start.tau_rad + turn * Eigen::Vector3d::UnitZ());
      const Eigen::VectorXd rows = op.Apply(R, 1.0, dictionary.atoms.col(start.atom));
      const double gain = rows.dot(op.target()) / rows.norm();
      EXPECT_GT(op.target().squaredNorm() - gain * std::abs(gain), start.cost);
    }
}

TEST(ViewSearch, FirstStartOfAPlantedAtomIsItsViewToTheGrid) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const Dictionary dictionary = RandomDictionary(40, &rng);
    const auto planted = PlantPose(dictionary, 1, &rng);
    const ProjectionOperator op(trial % 2 == 1 ? testing::ObserveInSpace(planted, 0.01)
                                               : testing::ObserveInPicture(planted, 2.0));
    const ViewStart start = Search(op, dictionary).front();
    EXPECT_EQ(start.atom, planted.code.atoms[0]);
    // Half a step of the grid in yaw and in pitch, and a little for the roll.
    EXPECT_LT(AngleBetween(start.tau_rad, planted.tau_rad), 0.25);
  }
}

TEST(ViewSearch, StartsAreSortedApartAndAsManyAsAsked) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(40, &rng);
  const ProjectionOperator op(testing::ObserveInPicture(PlantPose(dictionary, 4, &rng), 2.0));
  const ViewSearchOptions options{.num_starts = 5, .min_separation_rad = 0.8};
  const auto starts = Search(op, dictionary, {}, options);
  ASSERT_EQ(starts.size(), 5u);
  for (size_t i = 0; i < starts.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      EXPECT_LE(starts[j].cost, starts[i].cost);
      EXPECT_GE(AngleBetween(starts[j].tau_rad, starts[i].tau_rad), 0.8 - 1e-9);
    }
}

TEST(ViewSearch, PriorOfTheTiltCountsInTheCost) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(10, &rng);
  const ProjectionOperator op(testing::ObserveInPicture(PlantPose(dictionary, 2, &rng), 2.0));
  const RotationOptions strong{.prior_weight = {1e4, 0, 1e4}};
  for (const ViewStart& start : Search(op, dictionary, strong, {.num_starts = 1}))
    EXPECT_LT(std::hypot(start.tau_rad.x(), std::remainder(start.tau_rad.z(), 2 * M_PI)), 0.1);
}

TEST(ViewSearch, LooksAtTheKindWithMorePoints) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(40, &rng);
  const auto planted = PlantPose(dictionary, 1, &rng);
  const Observation picture = testing::ObserveInPicture(planted, 2.0);
  const Observation space = testing::ObserveInSpace(planted, 0.01);
  for (const int num_2d : {1, 5, 18, 22}) {
    Observation mixture = space;
    for (int j = 0; j < num_2d; ++j) mixture.points[j] = picture.points[j];
    const ViewStart start = Search(ProjectionOperator(mixture), dictionary).front();
    EXPECT_EQ(start.atom, planted.code.atoms[0]);
    EXPECT_TRUE(std::isfinite(start.scale_px_per_unit));
    EXPECT_GT(start.scale_px_per_unit, 0.0);
    EXPECT_LT(AngleBetween(start.tau_rad, planted.tau_rad), 0.25);
  }
}

// One point in the picture, or all of them on one spot, have no size.
TEST(ViewSearch, ScaleIsOneWhereThePictureLeavesItOpen) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(10, &rng);
  const auto planted = PlantPose(dictionary, 1, &rng);
  Observation mixture = testing::ObserveInSpace(planted, 0.01);
  mixture.points[3] = testing::ObserveInPicture(planted, 2.0).points[3];
  for (const ViewStart& start : Search(ProjectionOperator(mixture), dictionary))
    EXPECT_EQ(start.scale_px_per_unit, 1.0);
  Observation spot = testing::ObserveInPicture(planted, 2.0);
  for (ObservedPoint& point : spot.points) point.x = {100, 100, 0};
  for (const ViewStart& start : Search(ProjectionOperator(spot), dictionary))
    EXPECT_EQ(start.scale_px_per_unit, 1.0);
}

TEST(ViewSearchOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(ViewSearchOptions().Validate(), "");
  EXPECT_THAT(ViewSearchOptions{.num_yaws = 0}.Validate(), ::testing::HasSubstr("num_yaws = 0"));
  EXPECT_THAT(ViewSearchOptions{.pitches_rad = {}}.Validate(), ::testing::HasSubstr("pitches_rad"));
  EXPECT_THAT(ViewSearchOptions{.num_starts = -1}.Validate(),
              ::testing::HasSubstr("num_starts = -1"));
  EXPECT_THAT(ViewSearchOptions{.min_separation_rad = std::nan("")}.Validate(),
              ::testing::HasSubstr("min_separation_rad = nan"));
}

}  // namespace
}  // namespace poselift
