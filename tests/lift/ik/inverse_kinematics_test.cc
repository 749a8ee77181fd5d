// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Poses of the made-up CMU skeleton, posed by forward kinematics and found
// again from their joints alone; damaged, absurd and unreachable targets. Real
// captured motion where it is there. Bone twists that joints do not show are
// free, so poses are compared by their joints.
#include "lift/ik/inverse_kinematics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/units.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_tag.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::DofOf;
using testing::MatrixNear;
using testing::RandomPoseWithinLimits;
using testing::RandomRotation;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Largest angle by which dofs are outside of their limits.
double Excess_rad(const Skeleton& skeleton, const SkeletonPose& pose) {
  double worst = 0.0;
  Eigen::Index d = 0;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) {
      const double value = pose.dofs[d++];
      worst = std::max({worst, dof.lower - value, value - dof.upper});
    }
  return worst;
}

// A walker in mid-stride with a bent arm, well within all limits.
SkeletonPose Walker(const Skeleton& skeleton) {
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  pose.root_in_world_m << 0.4, 0.9, -1.2;
  pose.world_from_root = Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, 1, 0.2).normalized());
  DofOf(skeleton, "lfemur", Dof::Kind::kRx, &pose) = -0.6;
  DofOf(skeleton, "rfemur", Dof::Kind::kRx, &pose) = 0.3;
  DofOf(skeleton, "ltibia", Dof::Kind::kRx, &pose) = 0.5;
  DofOf(skeleton, "rtibia", Dof::Kind::kRx, &pose) = 0.3;
  DofOf(skeleton, "upperback", Dof::Kind::kRx, &pose) = 0.2;
  DofOf(skeleton, "lhumerus", Dof::Kind::kRz, &pose) = 1.1;
  DofOf(skeleton, "rhumerus", Dof::Kind::kRz, &pose) = -1.0;
  DofOf(skeleton, "lradius", Dof::Kind::kRx, &pose) = 0.9;
  DofOf(skeleton, "rradius", Dof::Kind::kRx, &pose) = 0.6;
  return pose;
}

TEST(InverseKinematics, ATagTellsTheTwistThatJointsDoNot) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Skeleton& skeleton = ik.body().skeleton;
  SkeletonPose truth = Walker(skeleton);
  DofOf(skeleton, "head", Dof::Kind::kRy, &truth) = 0.4;
  const Pose3 joints_m = JointPositions(ik.body(), truth);
  const int head = *skeleton.FindBone("head");
  const auto error_rad = [&](const IkHints& hints) {
    BoneFrames wanted, found;
    ForwardKinematics(skeleton, truth, &wanted);
    ForwardKinematics(skeleton, ik.Solve(joints_m, hints).pose, &found);
    return AngleBetween(wanted.world_from_bone[head], found.world_from_bone[head]);
  };
  IkHints tagged;
  tagged.bone_poses = {testing::PlantTag(skeleton, truth, "head")};
  EXPECT_GT(error_rad({}), 0.1);
  EXPECT_LT(error_rad(tagged), 1e-3);
}

// A few end in another minimum at the limits, some millimetres off.
TEST(InverseKinematics, FindsRandomPosesWithinLimitsAgain) {
  auto rng = TestRng();
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  int num_missed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const SkeletonPose truth = RandomPoseWithinLimits(ik.body().skeleton, 0.5, &rng);
    const IkResult result = ik.Solve(JointPositions(ik.body(), truth));
    ASSERT_TRUE(IsUsable(result.status)) << result.message;
    if (result.rms_m > 1e-3) ++num_missed;
    EXPECT_LT(result.rms_m, 0.02) << "trial " << trial;
    EXPECT_LE(Excess_rad(ik.body().skeleton, result.pose), 0.0);
  }
  EXPECT_LE(num_missed, 3);
}

TEST(InverseKinematics, WithoutLimitsFindsAnyRandomPoseAgain) {
  auto rng = TestRng();
  const InverseKinematics ik(TrimmedCmuLikeSkeleton(),
                             {.enforce_limits = false, .function_tolerance = 1e-6});
  for (int trial = 0; trial < 300; ++trial) {
    const SkeletonPose truth = RandomPoseWithinLimits(ik.body().skeleton, 0.6, &rng);
    const IkResult result = ik.Solve(JointPositions(ik.body(), truth));
    ASSERT_TRUE(IsUsable(result.status)) << result.message;
    EXPECT_LT(result.rms_m, 1e-3) << "trial " << trial;
  }
}

TEST(InverseKinematics, FindsTheAnglesThatJointsShow) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Skeleton& skeleton = ik.body().skeleton;
  SkeletonPose truth = Walker(skeleton);
  IkResult result = ik.Solve(JointPositions(ik.body(), truth));
  for (const char* bone : {"lfemur", "rfemur", "ltibia", "rtibia", "lradius", "rradius"})
    EXPECT_NEAR(DofOf(skeleton, bone, Dof::Kind::kRx, &result.pose),
                DofOf(skeleton, bone, Dof::Kind::kRx, &truth), 0.2 * kRadFromDeg)
        << bone;
  EXPECT_LT(result.pose.world_from_root.angularDistance(truth.world_from_root), 0.1 * kRadFromDeg);
}

TEST(InverseKinematics, ReportsTheDistanceOfItsPose) {
  auto rng = TestRng();
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  Pose3 target = JointPositions(ik.body(), Walker(ik.body().skeleton));
  std::normal_distribution<double> noise_m(0.0, 0.03);
  for (double& x : target.reshaped()) x += noise_m(rng);
  const IkResult result = ik.Solve(target);
  const Eigen::VectorXd distances_m =
      (JointPositions(ik.body(), result.pose) - target).colwise().norm();
  EXPECT_NEAR(result.max_m, distances_m.maxCoeff(), 1e-12);
  EXPECT_NEAR(result.rms_m, distances_m.norm() / std::sqrt(kNumJoints), 1e-12);
  EXPECT_THAT(result.BriefReport(), ::testing::HasSubstr("converged"));
}

TEST(InverseKinematics, TurnsAndShiftsWithTheTarget) {
  auto rng = TestRng();
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Pose3 target = JointPositions(ik.body(), Walker(ik.body().skeleton));
  const IkResult plain = ik.Solve(target);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Quaterniond rotation = RandomRotation(&rng);
    const Eigen::Vector3d shift_m(100.0, -30.0 * trial, 7.0);
    const IkResult moved = ik.Solve((rotation.toRotationMatrix() * target).colwise() + shift_m);
    EXPECT_TRUE(MatrixNear(moved.pose.dofs, plain.pose.dofs, 1e-6));
    EXPECT_LT(moved.pose.world_from_root.angularDistance(rotation * plain.pose.world_from_root),
              1e-6);
    EXPECT_TRUE(MatrixNear(moved.pose.root_in_world_m,
                           rotation * plain.pose.root_in_world_m + shift_m, 1e-6));
  }
}

TEST(InverseKinematics, AbsentJointsDoNotDisturbTheOthers) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Pose3 whole = JointPositions(ik.body(), Walker(ik.body().skeleton));
  Pose3 target = whole;
  for (const int j : {joint::kLeftHand, joint::kRightElbow, joint::kRightFoot, joint::kPelvis})
    target.col(j).setConstant(kNaN);
  target(1, joint::kUpperBack) = kNaN;  // one coordinate is enough
  const IkResult result = ik.Solve(target);
  ASSERT_EQ(result.status, IkStatus::kConverged);
  EXPECT_LT(result.rms_m, 1e-3);
  // What is rigid with the rest is found with it.
  const Pose3 found = JointPositions(ik.body(), result.pose);
  EXPECT_TRUE(MatrixNear(found.col(joint::kPelvis), whole.col(joint::kPelvis), 2e-3));
}

TEST(InverseKinematics, WeightsDecideWhichJointsOfAnUnreachableTargetAreMet) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  Pose3 target = JointPositions(ik.body(), Walker(ik.body().skeleton));
  target.col(joint::kLeftHand) += Eigen::Vector3d(0.0, 0.5, 0.0);
  IkHints hints;
  const double even_m =
      (JointPositions(ik.body(), ik.Solve(target).pose) - target).col(joint::kLeftHand).norm();
  hints.joint_weights.setConstant(kNumJoints, 1.0);
  hints.joint_weights[joint::kLeftHand] = 100.0;
  const double heavy_m = (JointPositions(ik.body(), ik.Solve(target, hints).pose) - target)
                             .col(joint::kLeftHand)
                             .norm();
  EXPECT_LT(heavy_m, 0.5 * even_m);
  hints.joint_weights[joint::kLeftHand] = 0.0;
  EXPECT_LT(ik.Solve(target, hints).rms_m, 1e-3);
}

TEST(InverseKinematics, KeepsToLimitsThatTheTargetBreaksAndPassesThemWhenToldTo) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  SkeletonPose truth = Walker(skeleton);
  DofOf(skeleton, "ltibia", Dof::Kind::kRx, &truth) = -30 * kRadFromDeg;    // limit -10
  DofOf(skeleton, "lowerneck", Dof::Kind::kRx, &truth) = 70 * kRadFromDeg;  // limit 45
  const InverseKinematics limited(skeleton);
  const InverseKinematics free(skeleton, {.enforce_limits = false});
  const Pose3 target = JointPositions(free.body(), truth);
  IkResult result = limited.Solve(target);
  EXPECT_EQ(result.status, IkStatus::kConverged);
  EXPECT_LE(Excess_rad(skeleton, result.pose), 0.0);
  EXPECT_NEAR(DofOf(skeleton, "ltibia", Dof::Kind::kRx, &result.pose), -10 * kRadFromDeg, 1e-9);
  EXPECT_GT(result.max_m, 0.01);
  EXPECT_LT(free.Solve(target).rms_m, 1e-3);
}

// No pose a small step away along one dof, within the limits, is better.
TEST(InverseKinematics, StopsAtAMinimumWithinTheLimits) {
  auto rng = TestRng();
  const InverseKinematics ik(TrimmedCmuLikeSkeleton(),
                             {.max_iterations = 500, .function_tolerance = 1e-7});
  const Skeleton& skeleton = ik.body().skeleton;
  const double pull = ik.options().pull_m_per_rad;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    SkeletonPose beyond = Walker(skeleton);
    for (double& dof : beyond.dofs) dof += 0.5 * uniform(rng);
    const Pose3 target = JointPositions(ik.body(), beyond);
    const IkResult result = ik.Solve(target);
    ASSERT_TRUE(IsUsable(result.status)) << result.message;
    EXPECT_LE(Excess_rad(skeleton, result.pose), 0.0);
    const auto cost = [&](const SkeletonPose& pose) {
      return (JointPositions(ik.body(), pose) - target).squaredNorm() +
             pull * pull * pose.dofs.squaredNorm();
    };
    for (Eigen::Index d = 0; d < beyond.dofs.size(); ++d)
      for (const double step_rad : {-0.02, 0.02}) {
        SkeletonPose moved = result.pose;
        moved.dofs[d] += step_rad;
        if (Excess_rad(skeleton, moved) > 0.0) continue;
        EXPECT_GT(cost(moved), 0.999 * cost(result.pose)) << "trial " << trial << " dof " << d;
      }
  }
}

TEST(InverseKinematics, TwistsThatNothingShowsStayAtTheRestThatIsAskedFor) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Skeleton& skeleton = ik.body().skeleton;
  const Pose3 target = JointPositions(ik.body(), Walker(skeleton));
  IkResult result = ik.Solve(target);
  EXPECT_NEAR(DofOf(skeleton, "lwrist", Dof::Kind::kRy, &result.pose), 0.0, 1e-6);
  SkeletonPose rest = SkeletonPose::Rest(skeleton);
  DofOf(skeleton, "lwrist", Dof::Kind::kRy, &rest) = -0.8;
  result = ik.Solve(target, {.rest_dofs = rest.dofs});
  EXPECT_NEAR(DofOf(skeleton, "lwrist", Dof::Kind::kRy, &result.pose), -0.8, 1e-6);
}

TEST(InverseKinematics, ASequenceFromItsOwnAnswersIsContinuous) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton(), {.enforce_limits = false});
  const Skeleton& skeleton = ik.body().skeleton;
  SkeletonPose truth = Walker(skeleton);
  IkHints hints;
  double largest_rad = 0.0;
  // The arm circles through the back and overhead, the body turns twice.
  for (int frame = 0; frame < 240; ++frame) {
    truth.world_from_root =
        Eigen::AngleAxisd(4 * std::numbers::pi * frame / 240.0, Eigen::Vector3d::UnitY());
    DofOf(skeleton, "lhumerus", Dof::Kind::kRx, &truth) = 2 * std::numbers::pi * frame / 240.0;
    const IkResult result = ik.Solve(JointPositions(ik.body(), truth), hints);
    ASSERT_LT(result.rms_m, 1e-3) << "frame " << frame;
    if (hints.start)
      largest_rad =
          std::max(largest_rad, (result.pose.dofs - hints.start->dofs).cwiseAbs().maxCoeff());
    hints.start = result.pose;
  }
  EXPECT_LT(largest_rad, 30 * kRadFromDeg);
}

TEST(InverseKinematics, TheSameTargetGivesTheSameBits) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Pose3 target = JointPositions(ik.body(), Walker(ik.body().skeleton));
  EXPECT_EQ(ik.Solve(target).pose.dofs, ik.Solve(target).pose.dofs);
}

TEST(InverseKinematics, AnswersDegenerateTargetsWithAStatusAndNoNaN) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  Pose3 line(3, kNumJoints);
  for (int j = 0; j < kNumJoints; ++j) line.col(j) << 0.1 * j, 0.0, 0.0;
  Pose3 three = Pose3::Constant(3, kNumJoints, kNaN);
  for (int j = 0; j < 3; ++j) three.col(j) << j, 0.5, 0.0;
  for (const Pose3& target :
       {Pose3(Pose3::Zero(3, kNumJoints)), Pose3(Pose3::Constant(3, kNumJoints, 1e12)), line, three,
        Pose3(-line)}) {
    const IkResult result = ik.Solve(target);
    EXPECT_TRUE(IsUsable(result.status)) << result.message;
    EXPECT_TRUE(result.pose.dofs.allFinite());
    EXPECT_TRUE(result.pose.world_from_root.coeffs().allFinite());
    EXPECT_TRUE(result.pose.root_in_world_m.allFinite());
    EXPECT_TRUE(std::isfinite(result.rms_m) && std::isfinite(result.max_m));
  }
}

TEST(InverseKinematics, RefusesTargetsThatHoldNoPose) {
  const InverseKinematics ik(TrimmedCmuLikeSkeleton());
  const Pose3 walker = JointPositions(ik.body(), Walker(ik.body().skeleton));
  Pose3 two = Pose3::Constant(3, kNumJoints, kNaN);
  two.leftCols(2) = walker.leftCols(2);
  EXPECT_THAT(ik.Solve(two).message, ::testing::HasSubstr("found 2 joints"));
  EXPECT_THAT(ik.Solve(1000 * walker).message, ::testing::HasSubstr("metres"));
  Pose3 far = walker;
  far(0, 3) = 1e308;
  far(0, 4) = -1e308;
  for (const Pose3& target :
       {two, Pose3(1000 * walker), Pose3(1e12 * walker), far,
        Pose3(Pose3::Constant(3, kNumJoints, kNaN)),
        Pose3(Pose3::Constant(3, kNumJoints, std::numeric_limits<double>::infinity()))}) {
    const IkResult result = ik.Solve(target);
    EXPECT_EQ(result.status, IkStatus::kBadInput);
    EXPECT_FALSE(IsUsable(result.status));
    EXPECT_THAT(result.BriefReport(), ::testing::HasSubstr("bad input"));
  }
}

TEST(InverseKinematics, RefusesBadOptionsAndHints) {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  EXPECT_THROW(InverseKinematics(skeleton, {.pull_m_per_rad = kNaN}), InputError);
  EXPECT_THROW(InverseKinematics(skeleton, {.max_iterations = 0}), InputError);
  EXPECT_THROW(InverseKinematics(skeleton, {.function_tolerance = 0.0}), InputError);
  Skeleton stiff = skeleton;
  for (Bone& bone : stiff.bones) bone.dofs.clear();
  EXPECT_THROW(InverseKinematics{stiff}, InputError);
  const InverseKinematics ik(skeleton);
  const Pose3 target = JointPositions(ik.body(), Walker(skeleton));
  EXPECT_THROW(ik.Solve(Pose3::Zero(3, 5)), std::invalid_argument);
  EXPECT_THROW(ik.Solve(target, {.joint_weights = Eigen::Vector2d::Ones()}), std::invalid_argument);
  EXPECT_THROW(ik.Solve(target, {.joint_weights = Eigen::VectorXd::Constant(kNumJoints, -1.0)}),
               std::invalid_argument);
  EXPECT_THROW(ik.Solve(target, {.start = SkeletonPose()}), std::invalid_argument);
  EXPECT_THROW(ik.Solve(target, {.rest_dofs = Eigen::Vector2d::Zero()}), std::invalid_argument);
}

// A rig as BVH files have them: joints at the starts of bones, three rotations
// each, no limits, some of the 23 joints absent.
TEST(InverseKinematics, WorksOnABvhLikeRig) {
  auto rng = TestRng();
  const std::vector<Dof> zxy = {{Dof::Kind::kRy}, {Dof::Kind::kRx}, {Dof::Kind::kRz}};
  Skeleton rig;
  rig.bones = {{.name = "Hips", .tip_m = {0, 0.1, 0}}};
  const auto add = [&](const char* name, int parent, const Eigen::Vector3d& offset_m) {
    rig.bones.push_back({.name = name, .parent = parent, .offset_m = offset_m, .dofs = zxy});
    return static_cast<int>(rig.bones.size()) - 1;
  };
  const int spine = add("Spine", 0, {0, 0.1, 0});
  const int spine1 = add("Spine1", spine, {0, 0.2, 0});
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    int b = add(left ? "LeftUpLeg" : "RightUpLeg", 0, {0.1 * side, -0.05, 0});
    b = add(left ? "LeftLeg" : "RightLeg", b, {0, -0.45, 0});
    b = add(left ? "LeftFoot" : "RightFoot", b, {0, -0.45, 0});
    add(left ? "LeftToeBase" : "RightToeBase", b, {0, -0.05, 0.15});
    b = add(left ? "LeftArm" : "RightArm", spine1, {0.2 * side, 0.2, 0});
    b = add(left ? "LeftForeArm" : "RightForeArm", b, {0.3 * side, 0, 0});
    add(left ? "LeftHand" : "RightHand", b, {0.25 * side, 0, 0});
  }
  const InverseKinematics ik(rig);
  for (int trial = 0; trial < 20; ++trial) {
    const SkeletonPose truth = RandomPoseWithinLimits(rig, 0.8, &rng);
    const IkResult result = ik.Solve(JointPositions(ik.body(), truth));
    ASSERT_TRUE(IsUsable(result.status)) << result.message;
    EXPECT_LT(result.rms_m, 1e-3);
  }
}

}  // namespace
}  // namespace poselift
