// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk, and methods that know it: they find the camera from the labels by
// least squares and answer with the walk itself, or with it some frames late.
#include "lift/eval/evaluate_sequence.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <memory>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/joint_angles.h"
#include "src/level_camera.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using Sequence = std::vector<Observation>;

SequenceTrial Walk(const std::string& name = "walk", int num_frames = 60) {
  Motion motion = testing::PlantWalk(num_frames, 0.6, 0.0).motion;
  return {name, motion, motion};
}

Pose3 Centred(const Motion& motion, int frame) {
  const Pose3 joints = JointPositions(motion.skeleton, motion.frames[static_cast<size_t>(frame)]);
  return joints.colwise() - joints.col(joint::kPelvis);
}

// From all 23 joints in the picture, pelvis first: px = M x, the rows of M those of
// the rotation times the scale.
Eigen::Matrix3d FindCamera(const Sequence& sequence, const Motion& motion) {
  Eigen::Matrix3d xx = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 2, 3> px_x = Eigen::Matrix<double, 2, 3>::Zero();
  for (size_t t = 0; t < sequence.size(); ++t) {
    const Pose3 x = Centred(motion, static_cast<int>(t));
    for (int j = 0; j < kNumJoints; ++j) {
      const auto& points = sequence[t].points;
      const Eigen::Vector2d px = (points[static_cast<size_t>(j)].x - points[0].x).head<2>();
      xx += x.col(j) * x.col(j).transpose();
      px_x += px * x.col(j).transpose();
    }
  }
  const Eigen::Matrix<double, 2, 3> m = px_x * xx.inverse();
  Eigen::Matrix3d cam_from_world;
  cam_from_world.row(0) = m.row(0).normalized();
  cam_from_world.row(1) = m.row(1).normalized();
  cam_from_world.row(2) = cam_from_world.row(0).cross(cam_from_world.row(1));
  return cam_from_world;
}

NamedSequenceMethod LateTruth(int lag) {
  return {
      "late", [lag](const Sequence& sequence, double) {
        const auto count = static_cast<int>(sequence.size());
        const Motion motion = Walk("walk", count).own;
        const Eigen::Matrix3d cam_from_world = FindCamera(sequence, motion);
        std::vector<Pose3> poses;
        for (int t = 0; t < count; ++t)
          poses.emplace_back(cam_from_world * Centred(motion, std::clamp(t - lag, 0, count - 1)));
        return SequenceEstimate{poses};
      }};
}

EvaluateSequenceOptions CleanOptions() {
  EvaluateSequenceOptions options;
  options.layout = "joints23";
  options.noises_px = {0.0};
  options.view.missing_share = 0.0;
  return options;
}

SequenceErrors ErrorsOf(const NamedSequenceMethod& method) {
  const auto rows = EvaluateSequences({method}, {Walk()}, CleanOptions(), {});
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].method, kTrueJoints);
  return rows[1].errors;
}

TEST(EvaluateSequences, TheTruthHasNoErrorAndNoLag) {
  const SequenceErrors errors = ErrorsOf(LateTruth(0));
  for (const int i : {measure::kCam_mm, measure::kPa_mm, measure::kRoot_mm, measure::kJitter_mm})
    EXPECT_NEAR(errors[i], 0.0, 1e-6) << MeasureNames()[static_cast<size_t>(i)];
  EXPECT_NEAR(errors[measure::kLag_frames], 0.0, 0.05);
}

// Joints do not show the twist of straight limbs: what is left is small.
TEST(EvaluateSequences, AnglesOfTheTruthAreNearIt) {
  const auto rows = EvaluateSequences({LateTruth(0), LateTruth(10)}, {Walk()}, CleanOptions(), {});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_LT(rows[0].errors[measure::kAngle_deg], 3.0);
  EXPECT_NEAR(rows[1].errors[measure::kAngle_deg], rows[0].errors[measure::kAngle_deg], 1e-3);
  EXPECT_GT(rows[2].errors[measure::kAngle_deg], rows[0].errors[measure::kAngle_deg] + 1.0);
}

TEST(EvaluateSequences, ALateTruthIsLate) {
  for (const int lag : {2, -1, 4}) {
    const SequenceErrors errors = ErrorsOf(LateTruth(lag));
    EXPECT_NEAR(errors[measure::kLag_frames], lag, 0.1);
    EXPECT_GT(errors[measure::kCam_mm], 1.0);
  }
}

TEST(EvaluateSequences, SizeCountsInTheRootErrorAlone) {
  NamedSequenceMethod twice = LateTruth(0);
  twice.lift = [truth = twice.lift](const Sequence& sequence, double frame_time_s) {
    SequenceEstimate estimate = truth(sequence, frame_time_s);
    for (Pose3& pose : estimate.joints_in_cam_m) pose *= 2.0;
    return estimate;
  };
  const SequenceErrors errors = ErrorsOf(twice);
  EXPECT_NEAR(errors[measure::kCam_mm], 0.0, 1e-6);
  EXPECT_NEAR(errors[measure::kPa_mm], 0.0, 1e-6);
  EXPECT_GT(errors[measure::kRoot_mm], 300.0);
}

TEST(EvaluateSequences, AMethodLiftsOnceForAllItsFilters) {
  auto lifts = std::make_shared<std::atomic<int>>(0);
  NamedSequenceMethod method = LateTruth(0);
  method.lift = [lifts, lift = method.lift](const Sequence& sequence, double frame_time_s) {
    ++*lifts;
    return lift(sequence, frame_time_s);
  };
  method.filters.push_back({"as it is", [](const auto& poses, double) { return poses; }});
  method.filters.push_back({"backwards", [](auto poses, double) {
                              std::reverse(poses.begin(), poses.end());
                              return poses;
                            }});
  const auto rows = EvaluateSequences({method}, {Walk()}, CleanOptions(), {});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(*lifts, 1);
  EXPECT_EQ(rows[1].method, "late");
  EXPECT_EQ(rows[2].method, "as it is");
  EXPECT_EQ(rows[3].method, "backwards");
  EXPECT_NEAR(rows[2].errors[measure::kRoot_mm], rows[1].errors[measure::kRoot_mm], 1e-12);
  EXPECT_GT(rows[3].errors[measure::kRoot_mm], 10.0);
}

// The truth's angles off by one degree, two, three and four in turn, said to be off by
// two and a half: half of them are less, and all are less than twice that.
TEST(EvaluateSequences, CountsTheAnglesThatAreAsNearAsIsSaid) {
  NamedSequenceMethod sure = LateTruth(0);
  sure.lift = [truth = sure.lift](const Sequence& sequence, double frame_time_s) {
    SequenceEstimate estimate = truth(sequence, frame_time_s);
    const Motion motion = Walk("walk", static_cast<int>(sequence.size())).own;
    const Eigen::Quaterniond cam_from_world(FindCamera(sequence, motion));
    const JointAngleReader reader(motion.skeleton);
    estimate.angles_deg.resize(std::ssize(JointAngles()), std::ssize(sequence));
    for (Eigen::Index t = 0; t < estimate.angles_deg.cols(); ++t) {
      SkeletonPose pose = motion.frames[static_cast<size_t>(t)];
      pose.world_from_root = kLevelFromCam * (cam_from_world * pose.world_from_root);
      estimate.angles_deg.col(t) = reader.ReadDeg(pose);
      for (Eigen::Index a = 0; a < estimate.angles_deg.rows(); ++a)
        estimate.angles_deg(a, t) += 360.0 + 1.0 + static_cast<double>((a + t) % 4);
    }
    estimate.angles_sigma_deg =
        Eigen::MatrixXd::Constant(estimate.angles_deg.rows(), estimate.angles_deg.cols(), 2.5);
    return estimate;
  };
  const SequenceErrors errors = ErrorsOf(sure);
  for (const int first : {measure::kTrunkSigmas, measure::kLimbSigmas}) {
    EXPECT_NEAR(errors[first], 0.5, 0.02);
    EXPECT_NEAR(errors[first + 1], 1.0, 1e-9);
    EXPECT_NEAR(errors[first + 2], 3.0 / 2.5, 1e-3);
  }
  EXPECT_TRUE(std::isnan(ErrorsOf(LateTruth(0))[measure::kLimbSigmas]));
}

// The labels a trial gets, by way of a method that looks at them.
std::vector<Sequence> Labels(const std::vector<SequenceTrial>& trials, std::uint64_t seed) {
  auto seen = std::make_shared<std::vector<Sequence>>(trials.size());
  const NamedSequenceMethod look = {
      "look", [=](const Sequence& sequence, double) {
        (*seen)[sequence.size() == 60 ? 0 : 1] = sequence;
        return SequenceEstimate{std::vector<Pose3>(sequence.size(), Pose3::Random(3, kNumJoints))};
      }};
  EvaluateSequenceOptions options;
  options.noises_px = {5.0};
  options.seed = seed;
  EvaluateSequences({look}, trials, options, {});
  return *seen;
}

bool Same(const Sequence& a, const Sequence& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::equal(x.points.begin(), x.points.end(), y.points.begin(), y.points.end(),
                      [](const auto& p, const auto& q) { return p.name == q.name && p.x == q.x; });
  });
}

TEST(EvaluateSequences, TheSeedAndTheTrialDecideTheLabels) {
  const auto labels = Labels({Walk("a"), Walk("b", 50)}, 3);
  EXPECT_TRUE(Same(labels[0], Labels({Walk("a")}, 3)[0]));  // whatever other trials there are
  EXPECT_FALSE(Same(labels[0], Labels({Walk("a")}, 4)[0]));
  EXPECT_FALSE(Same(labels[0], Labels({Walk("c")}, 3)[0]));
  EXPECT_EQ(labels[1].size(), 50u);
}

TEST(EvaluateSequences, RefusesWhatDoesNotFit) {
  const auto run = [](const NamedSequenceMethod& method, const SequenceTrial& trial,
                      const char* layout = "body15") {
    EvaluateSequenceOptions options;
    options.layout = layout;
    EvaluateSequences({method}, {trial}, options, {});
  };
  const NamedSequenceMethod short_one = {
      "short", [](const Sequence&, double) { return SequenceEstimate{std::vector<Pose3>(3)}; }};
  EXPECT_THROW(run(short_one, Walk()), std::invalid_argument);
  EXPECT_THROW(run(LateTruth(0), Walk("walk", 11)), std::invalid_argument);
  EXPECT_THROW(run(LateTruth(0), Walk(), "none"), std::invalid_argument);
  SequenceTrial uneven = Walk();
  uneven.standard.frames.pop_back();
  EXPECT_THROW(run(LateTruth(0), uneven), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
