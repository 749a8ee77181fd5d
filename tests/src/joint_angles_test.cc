// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The made-up CMU skeleton is put into the standing pose and moved segment by
// segment with rotations of the world's axes, which say what the movement looks
// like; the dofs follow from the bones' definition. The angles must have the
// anatomist's value and sign.
#include "src/joint_angles.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/units.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/mutation.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::DofOf;
using testing::MatrixNear;
using testing::MirroredPose;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

constexpr auto kRx = Dof::Kind::kRx, kRy = Dof::Kind::kRy, kRz = Dof::Kind::kRz;
const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                      kZ = Eigen::Vector3d::UnitZ();

Eigen::Matrix3d Rotation(const Eigen::Vector3d& axis, double angle_deg) {
  return Eigen::AngleAxisd(kRadFromDeg * angle_deg, axis).toRotationMatrix();
}

// Sets a bone's three dofs rx ry rz so that parent_from_bone is `wanted`.
void SetBone(const Skeleton& skeleton, const char* bone, const Eigen::Matrix3d& wanted,
             SkeletonPose* pose) {
  const Eigen::Matrix3d& C = skeleton.bones[skeleton.FindBone(bone).value()].rest_from_axis;
  const Eigen::Matrix3d R = C.transpose() * wanted * C;  // Rz Ry Rx
  const double y = std::asin(-R(2, 0));
  DofOf(skeleton, bone, kRx, pose) = std::atan2(R(2, 1), R(2, 2));
  DofOf(skeleton, bone, kRy, pose) = y;
  DofOf(skeleton, bone, kRz, pose) = std::atan2(R(1, 0), R(0, 0));
}

// A person who stands straight, and what the bones need to do so.
struct Stander {
  Skeleton skeleton = TrimmedCmuLikeSkeleton();
  // At rest the legs are spread by 20 degrees, and the arms are level with the
  // elbows' hinges 30 degrees out of the vertical.
  Eigen::Matrix3d left_leg = Rotation(kZ, -20);
  Eigen::Matrix3d left_arm = Rotation(kY, -30) * Rotation(kZ, -90);
  SkeletonPose pose = SkeletonPose::Rest(skeleton);

  Stander() {
    // Elbows first: the palm faces the thigh when the forearm takes back the
    // arm's 30 degrees.
    SetBone(skeleton, "lfemur", left_leg, &pose);
    SetBone(skeleton, "lhumerus", left_arm, &pose);
    DofOf(skeleton, "lwrist", kRy, &pose) = kRadFromDeg * 30;
    const SkeletonPose mirrored = MirroredPose(skeleton, pose);
    pose.dofs += mirrored.dofs;
  }

  // The left arm or thigh turned by a rotation of the world's axes.
  void MoveLeft(const char* bone, const Eigen::Matrix3d& movement) {
    SetBone(skeleton, bone, movement * (std::string(bone) == "lfemur" ? left_leg : left_arm),
            &pose);
  }
  std::map<std::string, double> Angles() const {
    const Eigen::VectorXd values = JointAngleReader(skeleton).ReadDeg(pose);
    std::map<std::string, double> angles;
    for (size_t i = 0; i < JointAngles().size(); ++i)
      angles[JointAngles()[i].name] = values[static_cast<Eigen::Index>(i)];
    return angles;
  }
  Eigen::Vector3d Joint(int joint) const { return JointPositions(skeleton, pose).col(joint); }
};

// All angles not named must be zero.
void ExpectOnly(const Stander& stander, const std::map<std::string, double>& expected) {
  for (const auto& [name, value] : stander.Angles()) {
    const auto found = expected.find(name);
    EXPECT_NEAR(value, found == expected.end() ? 0.0 : found->second, 1e-6) << name;
  }
  for (const auto& [name, value] : expected) EXPECT_EQ(stander.Angles().count(name), 1u) << name;
}

TEST(JointAngles, AreFortyFiveWithDifferentNames) {
  std::set<std::string> names;
  for (const JointAngle& angle : JointAngles()) names.insert(angle.name);
  EXPECT_EQ(names.size(), 45u);
  EXPECT_EQ(JointAngles().size(), names.size());
}

TEST(JointAngles, AreAllInTheDocumentation) {
  const std::string page = testing::FileText(testing::SourcePath("docs/ANGLES.md"));
  for (const JointAngle& angle : JointAngles()) {
    const size_t at = page.find("`" + angle.name + "`");
    ASSERT_NE(at, std::string::npos) << angle.name;
    const std::string line = page.substr(at, page.find('\n', at) - at);
    EXPECT_TRUE(line.ends_with("| " + angle.positive + " |")) << line;
  }
}

TEST(JointAngles, AreZeroStandingStraight) {
  const Stander stander;
  ExpectOnly(stander, {});
  const Eigen::Vector3d hand = stander.Joint(joint::kLeftHand);
  const Eigen::Vector3d shoulder = stander.Joint(joint::kLeftShoulder);
  EXPECT_NEAR(hand.x(), shoulder.x(), 1e-12);
  EXPECT_LT(hand.y(), shoulder.y());
  EXPECT_NEAR(stander.Joint(joint::kLeftAnkle).x(), stander.Joint(joint::kLeftHip).x(), 1e-12);
}

TEST(JointAngles, TPoseHasTheArmsAbductedByNinety) {
  Stander stander;
  stander.pose = SkeletonPose::Rest(stander.skeleton);
  // The rest pose's elbows hinge 30 degrees off: arms turned outward, forearms back.
  ExpectOnly(stander, {{"left_shoulder.abduction", 90},
                       {"right_shoulder.abduction", 90},
                       {"left_shoulder.rotation", -30},
                       {"right_shoulder.rotation", -30},
                       {"left_wrist.pronation", 30},
                       {"right_wrist.pronation", 30},
                       {"left_hip.abduction", 20},
                       {"right_hip.abduction", 20}});
}

TEST(JointAngles, HipFlexionTakesTheKneeForward) {
  Stander stander;
  stander.MoveLeft("lfemur", Rotation(kX, -40));
  EXPECT_GT(stander.Joint(joint::kLeftKnee).z(), 0.2);
  ExpectOnly(stander, {{"left_hip.flexion", 40}});
}

TEST(JointAngles, HipAbductionTakesTheKneeOutward) {
  Stander stander;
  stander.MoveLeft("lfemur", Rotation(kZ, 25));
  EXPECT_GT(stander.Joint(joint::kLeftKnee).x(), stander.Joint(joint::kLeftHip).x() + 0.1);
  ExpectOnly(stander, {{"left_hip.abduction", 25}});
}

TEST(JointAngles, HipRotationInwardIsPositive) {
  Stander stander;
  stander.MoveLeft("lfemur", Rotation(kY, -15));
  const Eigen::Vector3d toes = stander.Joint(joint::kLeftFoot) - stander.Joint(joint::kLeftAnkle);
  EXPECT_LT(toes.x(), -0.01);
  ExpectOnly(stander, {{"left_hip.rotation", 15}});
}

TEST(JointAngles, SwingOfAThighIsOneRotationVectorBeforeItsTurn) {
  Stander stander;
  const Eigen::Vector3d swing_deg(-60, 0, 30);
  stander.MoveLeft("lfemur",
                   Rotation(swing_deg.normalized(), swing_deg.norm()) * Rotation(kY, -20));
  ExpectOnly(stander,
             {{"left_hip.flexion", 60}, {"left_hip.abduction", 30}, {"left_hip.rotation", 20}});
}

TEST(JointAngles, KneeFlexionTakesTheHeelBack) {
  Stander stander;
  DofOf(stander.skeleton, "ltibia", kRx, &stander.pose) = kRadFromDeg * 120;
  EXPECT_LT(stander.Joint(joint::kLeftAnkle).z(), stander.Joint(joint::kLeftKnee).z() - 0.3);
  ExpectOnly(stander, {{"left_knee.flexion", 120}});
}

TEST(JointAngles, DorsiflexionRaisesTheToes) {
  Stander stander;
  const double flat = stander.Joint(joint::kLeftFoot).y();
  DofOf(stander.skeleton, "lfoot", kRx, &stander.pose) = kRadFromDeg * -20;
  EXPECT_GT(stander.Joint(joint::kLeftFoot).y(), flat + 0.02);
  ExpectOnly(stander, {{"left_ankle.dorsiflexion", 20}});
}

TEST(JointAngles, AnkleRotationInwardIsPositive) {
  Stander stander;
  DofOf(stander.skeleton, "lfoot", kRz, &stander.pose) = kRadFromDeg * -25;
  EXPECT_LT(stander.Joint(joint::kLeftFoot).x(), stander.Joint(joint::kLeftAnkle).x() - 0.02);
  ExpectOnly(stander, {{"left_ankle.rotation", 25}});
}

// On the tips of the toes the foot's turn about the shin is one about its own length.
TEST(JointAngles, InversionTurnsTheSoleInward) {
  Stander stander;
  DofOf(stander.skeleton, "lfoot", kRx, &stander.pose) = kRadFromDeg * 90;
  DofOf(stander.skeleton, "lfoot", kRz, &stander.pose) = kRadFromDeg * 25;
  BoneFrames frames;
  ForwardKinematics(stander.skeleton, stander.pose, &frames);
  // The sole looks back when the toes point down, and down in the rest pose.
  const int foot = stander.skeleton.FindBone("lfoot").value();
  const Eigen::Vector3d sole = frames.world_from_bone[foot] * stander.left_leg.transpose() * -kY;
  EXPECT_LT(sole.x(), -0.2);
  EXPECT_LT(sole.z(), -0.8);
  ExpectOnly(stander, {{"left_ankle.dorsiflexion", -90}, {"left_ankle.inversion", 25}});
}

TEST(JointAngles, ShoulderFlexionTakesTheArmForward) {
  Stander stander;
  stander.MoveLeft("lhumerus", Rotation(kX, -90));
  EXPECT_GT(stander.Joint(joint::kLeftElbow).z(), stander.Joint(joint::kLeftShoulder).z() + 0.2);
  ExpectOnly(stander, {{"left_shoulder.flexion", 90}});
}

TEST(JointAngles, ShoulderAbductionTakesTheArmOutwardAndUp) {
  Stander stander;
  stander.MoveLeft("lhumerus", Rotation(kZ, 150));
  EXPECT_GT(stander.Joint(joint::kLeftElbow).y(), stander.Joint(joint::kLeftShoulder).y() + 0.2);
  ExpectOnly(stander, {{"left_shoulder.abduction", 150}});
}

TEST(JointAngles, ShoulderRotationInwardTakesTheBentForearmAcrossTheBody) {
  Stander stander;
  stander.MoveLeft("lhumerus", Rotation(kY, -40));
  DofOf(stander.skeleton, "lradius", kRx, &stander.pose) = kRadFromDeg * 90;
  EXPECT_LT(stander.Joint(joint::kLeftWrist).x(), stander.Joint(joint::kLeftElbow).x() - 0.1);
  ExpectOnly(stander, {{"left_shoulder.rotation", 40}, {"left_elbow.flexion", 90}});
}

TEST(JointAngles, ElbowFlexionTakesTheHandStraightForward) {
  Stander stander;
  DofOf(stander.skeleton, "lradius", kRx, &stander.pose) = kRadFromDeg * 90;
  const Eigen::Vector3d forearm =
      stander.Joint(joint::kLeftWrist) - stander.Joint(joint::kLeftElbow);
  EXPECT_TRUE(MatrixNear(forearm.normalized(), kZ, 1e-9));
  ExpectOnly(stander, {{"left_elbow.flexion", 90}});
}

// The thumb of the whole skeleton shows what the trimmed one's wrist dof does.
TEST(JointAngles, PronationTurnsTheThumbInward) {
  Stander stander;
  stander.skeleton = testing::CmuLikeSkeleton();
  SkeletonPose whole = SkeletonPose::Rest(stander.skeleton);
  const Stander trimmed;
  SetBone(stander.skeleton, "lhumerus", stander.left_arm, &whole);
  DofOf(stander.skeleton, "lwrist", kRy, &whole) = kRadFromDeg * (30 - 50);
  stander.pose = whole;
  BoneFrames frames;
  ForwardKinematics(stander.skeleton, stander.pose, &frames);
  const int thumb = stander.skeleton.FindBone("lthumb").value();
  const Eigen::Vector3d along =
      frames.tip_in_world_m.col(thumb) - frames.start_in_world_m.col(thumb);
  EXPECT_LT(along.x(), -0.01);
  EXPECT_GT(along.z(), 0.01);
  EXPECT_NEAR(stander.Angles().at("left_wrist.pronation"), 50, 1e-6);
}

TEST(JointAngles, EachSpineSegmentBendsAndTurnsToTheLeft) {
  const std::map<std::string, const char*> bones = {
      {"lower_back", "lowerback"}, {"upper_back", "upperback"}, {"thorax", "thorax"},
      {"lower_neck", "lowerneck"}, {"upper_neck", "upperneck"}, {"head", "head"}};
  for (const auto& [name, bone] : bones) {
    Stander stander;
    SetBone(stander.skeleton, bone, Rotation(kX, 20) * Rotation(kZ, -10) * Rotation(kY, 5),
            &stander.pose);
    EXPECT_GT(stander.Joint(joint::kHeadTop).z(), 0.03) << name;
    EXPECT_GT(stander.Joint(joint::kHeadTop).x(), 0.01) << name;
    ExpectOnly(stander,
               {{name + ".flexion", 20}, {name + ".lateral_bend", 10}, {name + ".rotation", 5}});
  }
}

TEST(JointAngles, PelvisTurnsRisesAndTilts) {
  Stander stander;
  stander.pose.world_from_root = Rotation(kY, 100) * Rotation(kZ, 10) * Rotation(kX, 30);
  ExpectOnly(stander, {{"pelvis.rotation", 100}, {"pelvis.obliquity", 10}, {"pelvis.tilt", 30}});
}

TEST(JointAngles, MirroredPosesHaveEqualAnglesOnTheOtherSide) {
  auto rng = TestRng();
  std::normal_distribution<double> normal(0.0, 0.3);
  for (int trial = 0; trial < 20; ++trial) {
    Stander stander;
    for (double& dof : stander.pose.dofs) dof += normal(rng);
    Stander mirrored = stander;
    mirrored.pose = MirroredPose(stander.skeleton, stander.pose);
    const auto angles = stander.Angles();
    for (const auto& [name, value] : mirrored.Angles()) {
      std::string other = name;
      double sign = 1;
      if (name.starts_with("left"))
        other.replace(0, 4, "right");
      else if (name.starts_with("right"))
        other.replace(0, 5, "left");
      else if (!name.ends_with("flexion") && !name.ends_with("tilt"))
        sign = -1;
      EXPECT_NEAR(value, sign * angles.at(other), 1e-9) << name;
    }
  }
}

TEST(JointAngles, FollowAMovementThroughWholeTurns) {
  Stander stander;
  Motion motion;
  motion.skeleton = stander.skeleton;
  for (int step = 0; step <= 200; ++step) {  // 1000 degrees
    motion.frames.push_back(stander.pose);
    motion.frames.back().world_from_root = Eigen::AngleAxisd(kRadFromDeg * 5 * step, kY);
  }
  const Eigen::MatrixXd angles_deg = ReadJointAnglesDeg(motion);
  EXPECT_EQ(JointAngles()[2].name, "pelvis.rotation");
  EXPECT_NEAR(angles_deg(2, 200), 1000, 1e-6);
}

TEST(JointAngles, FollowACartwheelAndAnArmOverTheTop) {
  Stander stander;
  Motion motion;
  motion.skeleton = stander.skeleton;
  for (int step = 0; step <= 50; ++step) {
    stander.pose.world_from_root = Eigen::AngleAxisd(kRadFromDeg * 7 * step, kZ);
    stander.MoveLeft("lhumerus", Rotation(kX, -5 * step));
    motion.frames.push_back(stander.pose);
  }
  const Eigen::MatrixXd angles_deg = ReadJointAnglesDeg(motion);
  const double largest_step =
      (angles_deg.rightCols(50) - angles_deg.leftCols(50)).cwiseAbs().maxCoeff();
  EXPECT_NEAR(largest_step, 7, 1e-6);
  EXPECT_NEAR(angles_deg(1, 50), 350, 1e-6);
}

TEST(JointAngles, DerivativeSaysWhereASmallStepLeads) {
  auto rng = TestRng();
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const JointAngleReader reader(skeleton);
  for (int trial = 0; trial < 10; ++trial) {
    const SkeletonPose pose = testing::RandomPoseWithinLimits(skeleton, 0.4, &rng);
    const Eigen::VectorXd step = 1e-4 * testing::RandomMatrix(3 + pose.dofs.size(), 1, &rng);
    SkeletonPose moved = pose;
    const Eigen::Vector3d turn = step.head<3>();
    moved.world_from_root =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pose.world_from_root;
    moved.dofs += step.tail(pose.dofs.size());
    const Eigen::VectorXd here_deg = reader.ReadDeg(pose);
    const Eigen::VectorXd change_deg = reader.ReadDeg(moved, here_deg) - here_deg;
    EXPECT_TRUE(MatrixNear(reader.DerivativeDeg(pose) * step, change_deg, 1e-3));
    EXPECT_GT(change_deg.norm(), 0.01);
  }
}

TEST(JointAngles, OfAWholeSkeletonAreThoseOfTheTrimmedOne) {
  const Skeleton whole = testing::CmuLikeSkeleton();
  const Skeleton trimmed = TrimmedCmuLikeSkeleton();
  SkeletonPose pose = SkeletonPose::Rest(whole);
  SkeletonPose trimmed_pose = SkeletonPose::Rest(trimmed);
  for (const char* bone : {"lfemur", "rhumerus", "upperback"})
    DofOf(whole, bone, kRx, &pose) = DofOf(trimmed, bone, kRx, &trimmed_pose) = 0.3;
  EXPECT_TRUE(MatrixNear(JointAngleReader(whole).ReadDeg(pose),
                         JointAngleReader(trimmed).ReadDeg(trimmed_pose), 1e-12));
}

TEST(JointAngles, RefuseASkeletonWithoutTheBones) {
  Skeleton skeleton = TrimmedCmuLikeSkeleton();
  skeleton.bones[skeleton.FindBone("lwrist").value()].name = "paw";
  EXPECT_THROW(JointAngleReader reader(skeleton), InputError);
}

}  // namespace
}  // namespace poselift
