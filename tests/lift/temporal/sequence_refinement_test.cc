// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk of which tags alone are seen, and a planted one whose joints are seen
// with noise, again and again: the answers scatter as their covariances say.
#include "lift/temporal/sequence_refinement.h"

#include <gtest/gtest.h>

#include <random>

#include "src/dof_angles.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/planted_tag.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr size_t kTagFrames = 20;

class TagsOverTime : public ::testing::Test {
 protected:
  TagsOverTime() : walk_(testing::MadeUpGaits().Gait(kTagFrames, 0.4)) {}

  // From rest, with the tags of these bones in every frame.
  std::vector<RefinedFrame> Refine(const std::vector<std::string>& bones) const {
    std::vector<FrameEvidence> evidence(kTagFrames);
    for (size_t t = 0; t < kTagFrames; ++t) {
      evidence[t].start = SkeletonPose::Rest(walk_.skeleton);
      evidence[t].camera.scale_px_per_m = 0.0;
      for (const std::string& bone : bones)
        evidence[t].observation.bone_poses.push_back(
            testing::PlantTag(walk_.skeleton, walk_.frames[t], bone));
    }
    SequenceRefinementOptions weak{.acceleration_sigma_rad = 1.0,
                                   .turn_sigma = 1.0,
                                   .path_sigma_m = 1.0,
                                   .function_tolerance = 1e-12,
                                   .max_iterations = 200};
    return SequenceRefinement(walk_.skeleton, {}, weak).Solve(evidence, walk_.frame_time_s);
  }

  Motion walk_;
};

TEST_F(TagsOverTime, TheSequenceFollowsThem) {
  const std::vector<std::string> bones = {"root", "lhumerus", "lradius"};
  const std::vector<RefinedFrame> refined = Refine(bones);
  const int elbow = walk_.skeleton.DofStarts()[*walk_.skeleton.FindBone("lradius")];
  BoneFrames truth, found;
  for (size_t t = 0; t < kTagFrames; ++t) {
    ForwardKinematics(walk_.skeleton, walk_.frames[t], &truth);
    ForwardKinematics(walk_.skeleton, refined[t].pose, &found);
    EXPECT_NEAR(refined[t].pose.dofs[elbow], walk_.frames[t].dofs[elbow], 2e-3);
    for (const std::string& name : bones) {
      const int bone = *walk_.skeleton.FindBone(name);
      EXPECT_LT(AngleBetween(truth.world_from_bone[bone], found.world_from_bone[bone]), 2e-3);
      EXPECT_TRUE(testing::MatrixNear(truth.start_in_world_m.col(bone),
                                      found.start_in_world_m.col(bone), 1e-3));
    }
  }
}

TEST_F(TagsOverTime, WithoutThemTheBodyStaysWhereItStarts) {
  for (const RefinedFrame& frame : Refine({})) EXPECT_LT(frame.pose.dofs.norm(), 1e-6);
}

constexpr double kFrameTime_s = 1.0 / 30.0, kNoise_m = 0.003;

// Little is known but what is seen, and that angles do not jump.
SequenceRefinementOptions Loose() {
  SequenceRefinementOptions options;
  options.code_gamma_per_m2 = options.prior_weight = options.local_weight = 0.0;
  options.limit_stiffness = 0.01;
  options.acceleration_sigma_rad = 1.0;
  options.turn_sigma = 1.0;
  options.path_sigma_m = 1.0;
  options.function_tolerance = 1e-10;
  return options;
}

// What joints do not show, as the twist of a wrist, is where it is by half a radian.
std::vector<FrameEvidence> See(const Motion& walk, int num_frames, std::mt19937_64* rng) {
  std::normal_distribution<double> noise(0.0, kNoise_m);
  std::vector<FrameEvidence> frames;
  for (int t = 0; t < num_frames; ++t) {
    FrameEvidence& frame = frames.emplace_back();
    frame.start = walk.frames[static_cast<size_t>(2 * t)];
    frame.camera.scale_px_per_m = 0.0;
    frame.measured =
        PosePrediction{frame.start, 2.0 * Eigen::MatrixXd::Identity(kNumFeatures, kNumFeatures)};
    frame.observation = ObservePose(JointPositions(walk.skeleton, frame.start), kNoise_m);
    for (ObservedPoint& point : frame.observation.points)
      point.x += Eigen::Vector3d(noise(*rng), noise(*rng), noise(*rng));
  }
  return frames;
}

TEST(SequenceRefinement, AnswersScatterAsTheCovariancesSay) {
  constexpr int kFrames = 5, kMiddle = 2, kRounds = 60;
  auto rng = testing::TestRng();
  Motion walk = testing::PlantWalk(2 * kFrames, 0.6, 0.0).motion;
  // Who stands still does what is expected of bodies: there is no bias.
  walk.frames.assign(walk.frames.size(), SkeletonPose(walk.frames.front()));
  const SequenceRefinement refinement(walk.skeleton, {}, Loose());
  const SkeletonPose& truth = walk.frames[2 * kMiddle];
  SkeletonPose places = truth;  // of the hinges among the dofs
  places.dofs.setZero();
  for (const char* bone : {"ltibia", "rtibia", "lradius", "rradius"})
    testing::DofOf(walk.skeleton, bone, Dof::Kind::kRx, &places) = 1.0;
  double squares = 0.0, count = 0.0;
  Eigen::Vector3d turn_squares = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const auto refined = refinement.Solve(See(walk, kFrames, &rng), kFrameTime_s);
    const RefinedFrame& frame = refined[kMiddle];
    ASSERT_EQ(frame.covariance.rows(), 3 + walk.skeleton.NumDofs());
    const Eigen::VectorXd sigmas = frame.covariance.diagonal().cwiseSqrt();
    for (Eigen::Index d = 0; d < places.dofs.size(); ++d) {
      if (places.dofs[d] == 0.0) continue;
      const double error = (frame.pose.dofs[d] - truth.dofs[d]) / sigmas[3 + d];
      squares += error * error;
      ++count;
    }
    const Eigen::AngleAxisd turn(frame.pose.world_from_root * truth.world_from_root.conjugate());
    turn_squares += (turn.angle() * turn.axis()).cwiseQuotient(sigmas.head<3>()).cwiseAbs2();
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.15);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(std::sqrt(turn_squares[axis] / kRounds), 1.0, 0.25) << axis;
}

TEST(SequenceRefinement, LessSeenIsLessSure) {
  auto rng = testing::TestRng();
  const Motion walk = testing::PlantWalk(20, 0.6, 0.0).motion;
  auto frames = See(walk, 9, &rng);
  frames[4].observation.points.clear();
  const auto refined = SequenceRefinement(walk.skeleton, {}, Loose()).Solve(frames, kFrameTime_s);
  const auto variances_of = [&](size_t t) { return refined[t].covariance.diagonal().array(); };
  EXPECT_GT(variances_of(4).sum(), 1.1 * variances_of(3).sum());
  EXPECT_GT(variances_of(0).sum(), variances_of(3).sum());  // nothing before it
}

TEST(SequenceRefinement, PiecesAreAsSureAsTheWhole) {
  constexpr int kFrames = 60;
  auto rng = testing::TestRng();
  const Motion walk = testing::PlantWalk(2 * kFrames, 0.6, 0.0).motion;
  const auto frames = See(walk, kFrames, &rng);
  SequenceRefinementOptions options = Loose();
  const auto whole = SequenceRefinement(walk.skeleton, {}, options).Solve(frames, kFrameTime_s);
  options.piece_frames = 20;
  options.overlap_frames = 12;
  const auto pieces = SequenceRefinement(walk.skeleton, {}, options).Solve(frames, kFrameTime_s);
  for (size_t t = 0; t < kFrames; ++t) {
    const Eigen::VectorXd ratios =
        (pieces[t].covariance.diagonal().array() / whole[t].covariance.diagonal().array()).sqrt();
    EXPECT_NEAR(ratios.minCoeff(), 1.0, 0.1) << t;
    EXPECT_NEAR(ratios.maxCoeff(), 1.0, 0.1) << t;
  }
}

TEST(SequenceRefinement, RefusesWrongOptions) {
  SequenceRefinementOptions options;
  options.rate_sigma_rad = 0.0;
  EXPECT_THROW(SequenceRefinement(testing::TrimmedCmuLikeSkeleton(), {}, options), InputError);
}

}  // namespace
}  // namespace poselift
