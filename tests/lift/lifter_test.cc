// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Planted truth over made-up dictionaries: poses of a few atoms, a camera, no
// noise. The symmetries of the whole lift, and observations that cannot be
// lifted.
#include "lift/lifter.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::Masked;
using testing::MatrixNear;
using testing::ObserveInPicture;
using testing::ObserveInSpace;
using testing::PlantedPose;
using testing::PlantPose;
using testing::RandomDictionary;
using testing::RandomMatrix;
using testing::TestRng;
using ::testing::UnorderedElementsAreArray;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Seen { kPicture, kMaskedPicture, kMaskedSpace, kMixture };

Observation Observe(const PlantedPose& planted, Seen seen, std::mt19937_64* rng) {
  Observation picture = ObserveInPicture(planted, 2.0);
  Observation space = ObserveInSpace(planted, 0.01);
  switch (seen) {
    case Seen::kPicture:
      return picture;
    case Seen::kMaskedPicture:
      return Masked(picture, 0.3, rng);
    case Seen::kMaskedSpace:
      return Masked(space, 0.3, rng);
    case Seen::kMixture:
      break;
  }
  for (int j = 0; j < kNumJoints; j += 3) space.points[j] = picture.points[j];
  return Masked(space, 0.2, rng);
}

// The paper's problem, to the end.
LifterOptions WithoutPriors(int max_atoms) {
  LifterOptions options;
  options.omp.max_atoms = max_atoms;
  options.rotation.prior_weight.setZero();
  options.prior_weight = 0.0;
  options.min_improvement = 0.0;
  options.max_alternations = 1000;
  options.num_finishing = 100;
  return options;
}

Pose3 JointsInCam_m(const LiftSolution& solution) {
  return CamFromBody(solution.tau_rad) * Unstacked(solution.pose_in_body_m);
}

// Relative, over joints and rotation. In a picture alone, pose and scale share
// one factor, and -x with the roll turned by pi is the same picture.
double Error(const LiftSolution& solution, const PlantedPose& planted, bool picture_alone) {
  const auto error = [&](double factor, const Eigen::Vector3d& tau) {
    const Eigen::VectorXd pose = factor * solution.pose_in_body_m;
    return (pose - planted.pose_in_body_m).norm() / planted.pose_in_body_m.norm() +
           (CamFromBody(tau) - planted.camera.cam_from_body).norm();
  };
  if (!picture_alone) return error(1.0, solution.tau_rad);
  const double factor = solution.scale_px_per_m / planted.camera.scale_px_per_m;
  return std::min(error(factor, solution.tau_rad),
                  error(-factor, solution.tau_rad + M_PI * Eigen::Vector3d::UnitZ()));
}

class PlantedTruth : public ::testing::TestWithParam<Seen> {
 protected:
  bool PictureAlone() const {
    return GetParam() == Seen::kPicture || GetParam() == Seen::kMaskedPicture;
  }
};

std::string NameOf(const ::testing::TestParamInfo<Seen>& seen) {
  constexpr const char* kNames[] = {"Picture", "MaskedPicture", "MaskedSpace", "Mixture"};
  return kNames[static_cast<int>(seen.param)];
}

INSTANTIATE_TEST_SUITE_P(Lifter, PlantedTruth,
                         ::testing::Values(Seen::kPicture, Seen::kMaskedPicture, Seen::kMaskedSpace,
                                           Seen::kMixture),
                         NameOf);

TEST_P(PlantedTruth, IsRecoveredFromAStartNearby) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 12; ++trial) {
    const Dictionary dictionary = RandomDictionary(60, &rng);
    const PlantedPose planted = PlantPose(dictionary, 3, &rng);
    const Eigen::Vector3d tau = planted.tau_rad + 0.1 * RandomMatrix(3, 1, &rng);
    const ViewStart start{
        .tau_rad = tau,
        .scale_px_per_unit = 1.1 * planted.camera.scale_px_per_m * dictionary.typical_norm_m};
    const auto solutions =
        Lifter(dictionary, WithoutPriors(3)).SolveFrom(Observe(planted, GetParam(), &rng), {start});
    ASSERT_EQ(solutions.size(), 1u);
    EXPECT_LT(Error(solutions[0], planted, PictureAlone()), 1e-6);
    std::vector<int> atoms = solutions[0].code.atoms, true_atoms = planted.code.atoms;
    EXPECT_THAT(atoms, UnorderedElementsAreArray(true_atoms));
  }
}

TEST_P(PlantedTruth, IsRecoveredByTheViewSearch) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 12; ++trial) {
    const Dictionary dictionary = RandomDictionary(30, &rng);
    const int num_atoms = 1 + trial % 3;
    const PlantedPose planted = PlantPose(dictionary, num_atoms, &rng);
    const auto solutions =
        Lifter(dictionary, WithoutPriors(num_atoms)).Solve(Observe(planted, GetParam(), &rng));
    ASSERT_FALSE(solutions.empty());
    EXPECT_LT(Error(solutions[0], planted, PictureAlone()), 1e-6);
  }
}

// A body whose prior says something: RandomDictionary with the prior of random
// sums of its atoms.
Dictionary DictionaryWithPrior(int num_atoms, std::mt19937_64* rng) {
  Dictionary dictionary = RandomDictionary(num_atoms, rng);
  Eigen::MatrixXd poses(3 * kNumJoints, 300);
  for (auto pose : poses.colwise()) pose = PlantPose(dictionary, 3, rng).pose_in_body_m;
  dictionary.prior = LearnPosePrior(poses);
  return dictionary;
}

// Noise, so that no objective is zero.
Observation NoisyPicture(const PlantedPose& planted, std::mt19937_64* rng) {
  Observation observation = Masked(ObserveInPicture(planted, 4.0), 0.3, rng);
  for (ObservedPoint& point : observation.points)
    point.x.head<2>() += 4.0 * RandomMatrix(2, 1, rng);
  return observation;
}

void ExpectSameLift(const LiftSolution& a, const LiftSolution& b) {
  EXPECT_THAT(a.code.atoms, UnorderedElementsAreArray(b.code.atoms));
  EXPECT_TRUE(MatrixNear(a.pose_in_body_m, b.pose_in_body_m, 1e-6));
  EXPECT_TRUE(MatrixNear(CamFromBody(a.tau_rad), CamFromBody(b.tau_rad), 1e-6));
  EXPECT_NEAR(a.objective, b.objective, 1e-6 * a.objective);
}

TEST(Lifter, OrderOfThePointsChangesNothing) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(80, &rng);
  const Lifter lifter(dictionary, {});
  for (int trial = 0; trial < 5; ++trial) {
    Observation observation = NoisyPicture(PlantPose(dictionary, 3, &rng), &rng);
    const LiftSolution expected = lifter.Solve(observation).front();
    std::shuffle(observation.points.begin(), observation.points.end(), rng);
    const LiftSolution solution = lifter.Solve(observation).front();
    ExpectSameLift(solution, expected);
    EXPECT_NEAR(solution.scale_px_per_m, expected.scale_px_per_m, 1e-6);
  }
}

TEST(Lifter, ShiftingAndRescalingThePictureChangesTheScaleAlone) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(80, &rng);
  const Lifter lifter(dictionary, {});
  for (const double factor : {0.25, 1.0, 4.0}) {
    Observation observation = NoisyPicture(PlantPose(dictionary, 3, &rng), &rng);
    const LiftSolution expected = lifter.Solve(observation).front();
    const Eigen::Vector3d shift_px(-300, 1000, 0);
    for (ObservedPoint& point : observation.points) {
      point.x = factor * point.x + shift_px;
      point.sigma *= factor;
    }
    const LiftSolution solution = lifter.Solve(observation).front();
    ExpectSameLift(solution, expected);
    EXPECT_NEAR(solution.scale_px_per_m, factor * expected.scale_px_per_m, 1e-5);
  }
}

// Columns of poses or atoms, mirrored left to right.
Eigen::MatrixXd Mirrored(const Eigen::MatrixXd& poses) {
  Eigen::MatrixXd mirrored = poses;
  for (auto pose : mirrored.colwise()) pose = Stacked(MirroredInBody(Unstacked(pose))).eval();
  return mirrored;
}

Dictionary Mirrored(Dictionary dictionary) {
  dictionary.atoms = Mirrored(dictionary.atoms);
  dictionary.prior.mean_m = Mirrored(dictionary.prior.mean_m);
  // |Wh (y - mean)| of the mirrored pose: mirror the rows.
  dictionary.prior.whitening = Mirrored(dictionary.prior.whitening.transpose()).transpose();
  return dictionary;
}

TEST(Lifter, MirroredPictureOverAMirroredDictionaryGivesTheMirroredPose) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(80, &rng);
  const Dictionary mirrored_dictionary = Mirrored(dictionary);
  for (int trial = 0; trial < 5; ++trial) {
    Observation observation = NoisyPicture(PlantPose(dictionary, 3, &rng), &rng);
    const LiftSolution expected = Lifter(dictionary, {}).Solve(observation).front();
    for (ObservedPoint& point : observation.points) {
      point.x.x() = 639.0 - point.x.x();
      for (auto& part : point.parts) part.joint = Joints()[part.joint].mirror;
    }
    const LiftSolution solution = Lifter(mirrored_dictionary, {}).Solve(observation).front();
    EXPECT_THAT(solution.code.atoms, UnorderedElementsAreArray(expected.code.atoms));
    EXPECT_TRUE(MatrixNear(solution.pose_in_body_m, Mirrored(expected.pose_in_body_m), 1e-6));
    const Eigen::Vector3d mirrored_tau(expected.tau_rad.x(), -expected.tau_rad.y(),
                                       -expected.tau_rad.z());
    EXPECT_TRUE(MatrixNear(CamFromBody(solution.tau_rad), CamFromBody(mirrored_tau), 1e-6));
  }
}

TEST(Lifter, TurningABodyInSpaceAboutItsVerticalIsAYaw) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(30, &rng);
  const Lifter lifter(dictionary, WithoutPriors(3));
  const PlantedPose planted = PlantPose(dictionary, 3, &rng);
  const LiftSolution expected = lifter.Solve(ObserveInSpace(planted, 0.01)).front();
  for (const double angle_rad : {0.3, 1.5, -2.0}) {
    const Eigen::Vector3d turn = angle_rad * Eigen::Vector3d::UnitY();
    PlantedPose turned = planted;
    turned.camera.cam_from_body = CamFromBody(planted.tau_rad + turn);
    const LiftSolution solution = lifter.Solve(ObserveInSpace(turned, 0.01)).front();
    EXPECT_TRUE(
        MatrixNear(CamFromBody(solution.tau_rad), CamFromBody(expected.tau_rad + turn), 1e-6));
    EXPECT_TRUE(MatrixNear(solution.pose_in_body_m, expected.pose_in_body_m, 1e-6));
  }
}

// Without a prior of the tilt no direction of the world is special.
TEST(Lifter, TurningTheWorldTurnsTheCameraAndLeavesThePose) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(60, &rng);
  LifterOptions options;
  options.rotation.prior_weight.setZero();
  options.min_improvement = 0.0;
  options.max_alternations = 500;
  const Lifter lifter(dictionary, options);
  for (int trial = 0; trial < 5; ++trial) {
    const PlantedPose planted = PlantPose(dictionary, 3, &rng);
    PlantedPose turned = planted;
    turned.camera.cam_from_body =
        Eigen::AngleAxisd(1.0 + trial, Eigen::Vector3d::UnitY()) * planted.camera.cam_from_body;
    const Eigen::Vector3d start = planted.tau_rad + 0.1 * RandomMatrix(3, 1, &rng);
    const Eigen::Matrix3d turn =
        turned.camera.cam_from_body * planted.camera.cam_from_body.transpose();
    const LiftSolution expected =
        lifter.SolveFrom(ObserveInSpace(planted, 0.01), {{.tau_rad = start}}).front();
    const LiftSolution solution =
        lifter
            .SolveFrom(ObserveInSpace(turned, 0.01),
                       {{.tau_rad = TauFromRotation(turn * CamFromBody(start))}})
            .front();
    EXPECT_TRUE(MatrixNear(solution.pose_in_body_m, expected.pose_in_body_m, 1e-6));
    EXPECT_TRUE(
        MatrixNear(CamFromBody(solution.tau_rad), turn * CamFromBody(expected.tau_rad), 1e-6));
  }
}

TEST(Lifter, SolutionsAreSortedAndDistinct) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(80, &rng);
  LifterOptions options;
  options.distinct_m = 0.1;
  for (int trial = 0; trial < 5; ++trial) {
    const auto solutions =
        Lifter(dictionary, options).Solve(NoisyPicture(PlantPose(dictionary, 4, &rng), &rng));
    for (size_t i = 0; i < solutions.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        EXPECT_LE(solutions[j].objective, solutions[i].objective);
        const Pose3 difference = JointsInCam_m(solutions[i]) - JointsInCam_m(solutions[j]);
        EXPECT_GE(difference.norm(), 0.1 * std::sqrt(kNumJoints));
      }
  }
}

TEST(Lifter, IsDeterministic) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(80, &rng);
  const Observation observation = NoisyPicture(PlantPose(dictionary, 4, &rng), &rng);
  const auto a = Lifter(dictionary, {}).Solve(observation);
  const auto b = Lifter(dictionary, {}).Solve(observation);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].pose_in_body_m, b[i].pose_in_body_m);
    EXPECT_EQ(a[i].history, b[i].history);
  }
}

// Pose and scale share one factor.
TEST(Lifter, StartDecidesTheSizeInAPictureWithoutPriors) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(60, &rng);
  const PlantedPose planted = PlantPose(dictionary, 3, &rng);
  const double scale = planted.camera.scale_px_per_m * dictionary.typical_norm_m;
  const auto size_from = [&](double start_scale) {
    return Lifter(dictionary, WithoutPriors(3))
        .SolveFrom(ObserveInPicture(planted, 2.0), {{planted.tau_rad, start_scale}})
        .front()
        .pose_in_body_m.norm();
  };
  EXPECT_NEAR(size_from(scale) / size_from(1.5 * scale), 1.5, 1e-6);
}

// Points on a body, to be spoilt.
Observation GoodObservation() {
  std::mt19937_64 rng(1);
  const Dictionary dictionary = RandomDictionary(5, &rng);
  return ObserveInPicture(PlantPose(dictionary, 2, &rng), 2.0);
}

void ExpectCannotLift(const Observation& observation, const std::string& why) {
  EXPECT_THAT(CanLift(observation), HasSubstr(why));
  std::mt19937_64 rng(2);
  const Dictionary dictionary = RandomDictionary(20, &rng);
  EXPECT_TRUE(Lifter(dictionary, {}).Solve(observation).empty());
  EXPECT_TRUE(Lifter(dictionary, {})
                  .SolveFrom(observation, {{.tau_rad = Eigen::Vector3d::Zero()}})
                  .empty());
}

TEST(CanLift, SaysNothingOfGoodPoints) { EXPECT_EQ(CanLift(GoodObservation()), ""); }

TEST(CanLift, NeedsFourPoints) {
  ExpectCannotLift({}, "0 usable points, wanted at least 4");
  Observation observation = GoodObservation();
  observation.points.resize(3);
  ExpectCannotLift(observation, "3 usable points, wanted at least 4");
}

TEST(CanLift, NeedsPointsThatAreApart) {
  Observation observation = GoodObservation();
  for (ObservedPoint& point : observation.points) point.x = {200.0, 100.0, 0.0};
  ExpectCannotLift(observation, "all points lie in one place");
  for (ObservedPoint& point : observation.points)
    point.x.x() += 0.5 * (&point - &observation.points[0]) / kNumJoints;
  ExpectCannotLift(observation, "all points lie in one place");
}

TEST(CanLift, NeedsNumbersOfASize) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e300, -1e300, 1e30,
                           std::numeric_limits<double>::max()})
    for (const auto kind : {ObservedPoint::Kind::k2D, ObservedPoint::Kind::k3D}) {
      Observation observation = GoodObservation();
      observation.points[5].kind = kind;
      observation.points[5].x.y() = bad;
      ExpectCannotLift(observation, "'right_hip' is at (");
    }
}

TEST(CanLift, NeedsASigmaAboveZero) {
  for (const double bad : {0.0, -1.0, std::nan(""), kInfinity, 1e-300, 1e300}) {
    Observation observation = GoodObservation();
    observation.points[1].sigma = bad;
    ExpectCannotLift(observation, "'left_hip' has a sigma of ");
  }
}

// The edges of what is let through: slow or wrong is allowed, NaN is not.
TEST(Lifter, ExtremeButAllowedPointsGiveFinitePoses) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(40, &rng);
  for (const double size : {1e-9, 1.0, 1e9})
    for (const double sigma : {1e-9, 1.0, 1e9})
      for (const auto seen : {Seen::kPicture, Seen::kMaskedSpace, Seen::kMixture}) {
        Observation observation = Observe(PlantPose(dictionary, 3, &rng), seen, &rng);
        double largest = 0.0;
        for (const ObservedPoint& point : observation.points)
          largest = std::max(largest, point.x.cwiseAbs().maxCoeff());
        for (ObservedPoint& point : observation.points) {
          point.x *= size / largest;
          point.sigma = sigma;
        }
        for (const LiftSolution& solution : Lifter(dictionary, {}).Solve(observation)) {
          EXPECT_TRUE(solution.pose_in_body_m.allFinite());
          EXPECT_TRUE(solution.tau_rad.allFinite());
          EXPECT_TRUE(std::isfinite(solution.objective));
          EXPECT_TRUE(std::isfinite(solution.scale_px_per_m));
          EXPECT_GT(solution.scale_px_per_m, 0.0);
        }
      }
}

TEST(Lifter, MixtureWithOnePointOfAKindGivesFinitePoses) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = DictionaryWithPrior(40, &rng);
  const PlantedPose planted = PlantPose(dictionary, 3, &rng);
  Observation space = ObserveInSpace(planted, 0.01);
  Observation picture = ObserveInPicture(planted, 2.0);
  std::swap(space.points[4], picture.points[4]);
  for (const Observation& observation : {space, picture}) {
    const auto solutions = Lifter(dictionary, {}).Solve(observation);
    ASSERT_FALSE(solutions.empty());
    EXPECT_TRUE(solutions.front().pose_in_body_m.allFinite());
    EXPECT_TRUE(std::isfinite(solutions.front().scale_px_per_m));
  }
}

TEST(LifterOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(LifterOptions().Validate(), "");
  EXPECT_THAT(LifterOptions{.omp = {.max_atoms = 0}}.Validate(), HasSubstr("max_atoms"));
  EXPECT_THAT(LifterOptions{.rotation = {.max_iterations = 0}}.Validate(),
              HasSubstr("max_iterations"));
  EXPECT_THAT(LifterOptions{.views = {.num_yaws = 0}}.Validate(), HasSubstr("num_yaws"));
  EXPECT_THAT(LifterOptions{.prior_weight = std::nan("")}.Validate(), HasSubstr("prior_weight"));
  EXPECT_THAT(LifterOptions{.max_alternations = 0}.Validate(), HasSubstr("max_alternations"));
  EXPECT_THAT(LifterOptions{.min_improvement = -1}.Validate(), HasSubstr("min_improvement"));
  EXPECT_THAT(LifterOptions{.new_atoms_gain = 1.0}.Validate(), HasSubstr("new_atoms_gain"));
  EXPECT_THAT(LifterOptions{.trial_alternations = 0}.Validate(), HasSubstr("trial_alternations"));
  EXPECT_THAT(LifterOptions{.num_finishing = 0}.Validate(), HasSubstr("num_finishing"));
  EXPECT_THAT(LifterOptions{.distinct_m = -1}.Validate(), HasSubstr("distinct_m"));
}

TEST(Lifter, RefusesInvalidOptions) {
  std::mt19937_64 rng = TestRng();
  const Dictionary dictionary = RandomDictionary(5, &rng);
  EXPECT_THROW(Lifter(dictionary, LifterOptions{.prior_weight = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
