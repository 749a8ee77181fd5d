// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Every kind of hint as rows, on poses written out; hints that are none.
#include "src/joint_relation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "src/input_error.h"
#include "src/observation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Kind = LabelHint::Kind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Layout& Joints23() { return *FindLayout("joints23"); }

// A body in the picture's plane, its left hand 30 cm towards the camera.
Pose3 Pose() {
  Pose3 pose = Pose3::Zero(3, kNumJoints);
  for (int j = 0; j < kNumJoints; ++j) pose.col(j) << 0.01 * j, -0.5, 0.0;
  pose(2, joint::kLeftWrist) = -0.3;
  pose(1, joint::kLeftAnkle) = 0.92;
  pose(1, joint::kRightAnkle) = 0.92;
  pose(1, joint::kLeftFoot) = pose(1, joint::kRightFoot) = 0.98;
  return pose;
}

std::vector<int> Unmet(const std::vector<LabelHint>& hints, const Pose3& pose = Pose()) {
  return UnmetHints(RelationsOf(hints, Joints23()), pose);
}

TEST(JointRelation, NearerIsMetByDepthAndByHowMuch) {
  EXPECT_THAT(Unmet({{Kind::kNearer, "left_wrist", "right_wrist"}}), IsEmpty());
  EXPECT_THAT(Unmet({{Kind::kNearer, "right_wrist", "left_wrist"}}), ElementsAre(0));
  EXPECT_THAT(Unmet({{Kind::kNearer, "left_wrist", "neck", 0.25}}), IsEmpty());
  EXPECT_THAT(Unmet({{Kind::kNearer, "left_wrist", "neck", 0.4}}), ElementsAre(0));
  const auto relations = RelationsOf({{Kind::kNearer, "left_wrist", "neck", 0.4}}, Joints23());
  ASSERT_EQ(relations.size(), 1u);
  EXPECT_NEAR(relations[0].Residual(Pose()), -0.1 / relations[0].sigma_m, 1e-9);
}

TEST(JointRelation, WithoutANumberTheSignDecides) {
  Pose3 pose = Pose();
  for (const double depth_m : {-0.001, 0.001}) {
    pose(2, joint::kLeftWrist) = depth_m;
    EXPECT_EQ(Unmet({{Kind::kNearer, "left_wrist", "right_wrist"}}, pose).empty(), depth_m < 0.0);
  }
}

TEST(JointRelation, BonesGoTowardsTheCameraOrAway) {
  EXPECT_THAT(Unmet({{Kind::kTowardsCamera, "left_wrist"}, {Kind::kAwayFromCamera, "left_wrist"}}),
              ElementsAre(1));
  EXPECT_THAT(Unmet({{Kind::kAwayFromCamera, "left_hand"}}), IsEmpty());
}

TEST(JointRelation, TheFloorIsWhereTheHintsSayAndNothingIsBelow) {
  EXPECT_THAT(Unmet({{Kind::kOnFloor, "left_ankle"}, {Kind::kOnFloor, "right_ankle"}}), IsEmpty());
  Pose3 pose = Pose();
  pose(1, joint::kRightAnkle) -= 0.3;  // lifted
  EXPECT_THAT(Unmet({{Kind::kOnFloor, "left_ankle"}, {Kind::kOnFloor, "right_ankle"}}, pose),
              ElementsAre(1));
  EXPECT_THAT(Unmet({{Kind::kOnFloor, "left_ankle"}}, pose), IsEmpty());
  pose(1, joint::kRightHand) = 1.3;
  EXPECT_THAT(Unmet({{Kind::kOnFloor, "left_ankle"}}, pose), ElementsAre(0));
  // An ankle and the foot before it stand on one floor.
  EXPECT_THAT(Unmet({{Kind::kOnFloor, "left_ankle"}, {Kind::kOnFloor, "left_foot"}}), IsEmpty());
}

TEST(JointRelation, APinIsThreeRowsFromThePelvis) {
  Pose3 pose = Pose();
  pose.colwise() += Eigen::Vector3d(3.0, -2.0, 5.0);
  const Eigen::Vector3d x_m = pose.col(joint::kLeftWrist) - pose.col(joint::kPelvis);
  EXPECT_THAT(Unmet({{Kind::kPin, "left_wrist", "", {}, x_m}}, pose), IsEmpty());
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d beside_m = x_m + 0.1 * Eigen::Vector3d::Unit(axis);
    EXPECT_THAT(Unmet({{Kind::kPin, "left_wrist", "", {}, beside_m}}, pose), ElementsAre(0));
  }
}

TEST(JointRelation, APinIsAsFirmAsItSays) {
  const Eigen::Vector3d beside_m =
      Pose().col(joint::kLeftWrist) - Pose().col(joint::kPelvis) + Eigen::Vector3d(0.1, 0.0, 0.0);
  EXPECT_THAT(Unmet({{Kind::kPin, "left_wrist", "", 0.06, beside_m}}), IsEmpty());
  EXPECT_THAT(Unmet({{Kind::kPin, "left_wrist", "", 0.04, beside_m}}), ElementsAre(0));
}

TEST(JointRelation, ALandmarkIsTheSumOfItsJoints) {
  const Layout& layout = *FindLayout("body15");
  const auto relations = RelationsOf({{Kind::kNearer, "left_wrist", "neck", 0.0}}, layout);
  ASSERT_EQ(relations.size(), 1u);
  Pose3 pose = Pose3::Random(3, kNumJoints);
  const auto depth_m = [&](const char* name) {
    return SumOfJoints(layout.landmarks[*layout.Find(name)].parts, pose).z();
  };
  if (depth_m("neck") > depth_m("left_wrist")) pose.row(2) *= -1.0;
  EXPECT_NEAR(relations[0].Residual(pose),
              (depth_m("neck") - depth_m("left_wrist")) / relations[0].sigma_m, 1e-9);
}

TEST(JointRelation, MovingTheBodyChangesNothing) {
  const std::vector<LabelHint> hints = {{Kind::kNearer, "left_wrist", "neck"},
                                        {Kind::kTowardsCamera, "left_knee"},
                                        {Kind::kOnFloor, "left_ankle"},
                                        {Kind::kOnFloor, "right_hip"},
                                        {Kind::kPin, "head", "", {}, {0.1, 0.2, 0.3}}};
  Pose3 moved = Pose();
  moved.colwise() += Eigen::Vector3d(1.0, 2.0, 3.0);
  for (const JointRelation& relation : RelationsOf(hints, Joints23()))
    EXPECT_NEAR(relation.Residual(Pose()), relation.Residual(moved), 1e-9);
}

TEST(JointRelation, OfHintsThatAreNoneAreRefused) {
  const auto complaint = [](const LabelHint& hint) -> std::string {
    try {
      RelationsOf({hint}, Joints23());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint({Kind::kOnFloor, "left_ankel"}), HasSubstr("\"left_ankle\""));
  EXPECT_THAT(complaint({Kind::kNearer, "neck", "tail"}), HasSubstr("\"tail\""));
  EXPECT_THAT(complaint({Kind::kTowardsCamera, "pelvis"}), HasSubstr("a bone"));
  EXPECT_THAT(complaint({Kind::kNearer, "neck", "pelvis", NAN}), HasSubstr("found nan m"));
  EXPECT_THAT(complaint({Kind::kHeight, "", "", 0.0}), HasSubstr("a height of 0 m"));
  EXPECT_THAT(complaint({Kind::kHeight}), HasSubstr("a height of nan m"));
  EXPECT_THAT(complaint({Kind::kPin, "neck", "", {}, {0.0, NAN, 0.0}}), HasSubstr("a pin at"));
}

TEST(RelationOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(RelationOptions{}.Validate(), "");
  EXPECT_THAT(RelationOptions{.sigma_m = 0.0}.Validate(), HasSubstr("sigma_m"));
  EXPECT_THAT(RelationOptions{.least_depth_m = -1.0}.Validate(), HasSubstr("least_depth_m"));
  EXPECT_THAT(RelationOptions{.floor_sigma_m = NAN}.Validate(), HasSubstr("floor_sigma_m"));
}

TEST(Observe, PinsAloneArePointsBesideThePelvis) {
  PersonLabels labels;
  for (const char* name : {"left_wrist", "right_wrist", "left_ankle"})
    labels.hints.push_back({Kind::kPin, name, "", 0.1, {0.1, 0.2, 0.3}});
  EXPECT_TRUE(Observe(labels, Joints23()).points.empty());  // three are too few
  labels.hints.push_back({Kind::kPin, "head", "", {}, {0.0, -0.7, 0.0}});
  Observation observation = Observe(labels, Joints23());
  ASSERT_EQ(observation.points.size(), 5u);
  EXPECT_TRUE(observation.relations.empty());
  EXPECT_EQ(observation.points[0].name, "pelvis");
  EXPECT_EQ(observation.points[1].sigma, 0.1);
  EXPECT_EQ(observation.points[4].hint, 3);
  EXPECT_LT(observation.points[4].sigma, 0.05);
  for (const char* name : {"thorax", "left_hip", "right_hip"})
    labels.landmarks.push_back({name, {1.0, 2.0}, LabelState::kVisible, {}});
  EXPECT_EQ(Observe(labels, Joints23()).Count(ObservedPoint::Kind::k2D), 0);  // they wait
  labels.landmarks.push_back({"left_knee", {5.0, 9.0}, LabelState::kVisible, {}});
  observation = Observe(labels, Joints23());
  EXPECT_EQ(observation.points.size(), 4u);
  EXPECT_EQ(observation.relations.size(), 12u);
}

TEST(Observe, HintsAreRelationsAndTheStature) {
  PersonLabels labels{0, {{"thorax", {1.0, 2.0}, LabelState::kVisible, {}}}};
  EXPECT_TRUE(Observe(labels, Joints23()).relations.empty());
  EXPECT_FALSE(Observe(labels, Joints23()).stature_m);
  labels.hints = {{Kind::kHeight, "", "", 1.8}, {Kind::kPin, "neck", "", {}, {0.0, -0.5, 0.0}}};
  const Observation observation = Observe(labels, Joints23());
  EXPECT_EQ(observation.stature_m, 1.8);
  ASSERT_EQ(observation.relations.size(), 3u);
  EXPECT_EQ(observation.relations[1].hint, 1);
  const Observation smaller = AtSkeletonSize(observation, 2.0);
  EXPECT_FALSE(smaller.stature_m);
  EXPECT_EQ(smaller.relations[1].bound_m, -0.25);
  EXPECT_EQ(smaller.relations[1].sigma_m, 0.5 * observation.relations[1].sigma_m);
}

}  // namespace
}  // namespace poselift
