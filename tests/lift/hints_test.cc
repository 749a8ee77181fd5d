// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Hints of each kind on the sample pictures, whose truth is known, with the dictionary
// that ships: they are met, and the picture is explained as well as without.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <string>

#include "lift/body_proportions.h"
#include "lift/depth_mirror.h"
#include "lift/dictionary_file.h"
#include "lift/lift_labels.h"
#include "lift/lift_photo.h"
#include "src/io/camera_file.h"
#include "src/io/labels.h"
#include "src/observation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Kind = LabelHint::Kind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SourcePath;

constexpr const char* kSamples[] = {"kick", "reach", "throw"};
constexpr Limb kLimbs[] = {Limb::kLeftLeg, Limb::kRightLeg, Limb::kLeftArm, Limb::kRightArm};

const PhotoLifter& TheLifter() {
  static const Dictionary kDictionary = ReadDictionary(SourcePath("data/default.pldict"));
  static const PhotoLifter kLifter(kDictionary);
  return kLifter;
}

PersonLabels SampleLabels(const std::string& name) {
  return ReadLabels(SourcePath("samples/photo/" + name + ".exact.json")).frames[0].people[0];
}

LiftResult Lift(PersonLabels labels, const std::vector<LabelHint>& hints) {
  labels.hints = hints;
  return TheLifter().LiftPhoto(Observe(labels, *FindLayout("body15")));
}

// Of a landmark of body15.
double Depth_m(const LiftedPose& lifted, const char* name) {
  const Layout& layout = *FindLayout("body15");
  return SumOfJoints(layout.landmarks[*layout.Find(name)].parts, lifted.joints_in_cam_m).z();
}

double LeftNearerBy_m(const LiftedPose& lifted) {
  return Depth_m(lifted, "right_wrist") - Depth_m(lifted, "left_wrist");
}

// Explains the picture nearly as well.
void ExpectGoodReprojection(const LiftedPose& lifted, const LiftedPose& without) {
  EXPECT_LT(lifted.reprojection_rms_px, 1.5 * without.reprojection_rms_px + 1.0);
}

class Hints : public ::testing::TestWithParam<const char*> {
 protected:
  Hints() : labels_(SampleLabels(GetParam())), without_(Lift(labels_, {})) {}

  PersonLabels labels_;
  LiftResult without_;
};

INSTANTIATE_TEST_SUITE_P(Samples, Hints, ::testing::ValuesIn(kSamples),
                         [](const auto& param_info) { return param_info.param; });

// A knee or an elbow may not bend the way that a flip asks for: then it is a compromise.
TEST_P(Hints, FlipALimbInDepth) {
  ASSERT_TRUE(without_.IsUsable());
  int num_unmet = 0;
  for (const Limb limb : kLimbs) {
    const auto hints = HintsToFlip(limb, without_.poses[0].joints_in_cam_m);
    if (hints.empty()) continue;
    const LiftResult result = Lift(labels_, hints);
    ASSERT_TRUE(result.IsUsable());
    num_unmet += !result.poses[0].unmet_hints.empty();
    EXPECT_LT(result.poses[0].reprojection_rms_px, 0.035 * Extent_px(labels_));
  }
  EXPECT_LE(num_unmet, 1);
}

TEST_P(Hints, ChooseAnAlternative) {
  for (size_t i = 1; i < without_.poses.size(); ++i) {
    const Pose3& wanted_m = without_.poses[i].joints_in_cam_m;
    const Pose3& best_m = without_.poses[0].joints_in_cam_m;
    const auto hints = HintsToChoose(wanted_m, best_m);
    if (hints.empty()) continue;
    const LiftResult result = Lift(labels_, hints);
    ASSERT_TRUE(result.IsUsable());
    const Pose3& found_m = result.poses[0].joints_in_cam_m;
    EXPECT_LT((found_m - wanted_m).norm(), (found_m - best_m).norm()) << i;
    ExpectGoodReprojection(result.poses[0], without_.poses[i]);
  }
}

TEST_P(Hints, SayWhichJointIsNearerAndByHowMuch) {
  const LiftedPose& best = without_.poses[0];
  const double depth_m = LeftNearerBy_m(best);
  const bool left_is_nearer = depth_m > 0.0;
  const LabelHint other_way{Kind::kNearer, left_is_nearer ? "right_wrist" : "left_wrist",
                            left_is_nearer ? "left_wrist" : "right_wrist"};
  const LiftResult result = Lift(labels_, {other_way});
  EXPECT_THAT(result.poses[0].unmet_hints, IsEmpty());
  EXPECT_LE(depth_m * LeftNearerBy_m(result.poses[0]), 0.0);
  ExpectGoodReprojection(result.poses[0], best);

  // What already holds changes nothing but what the solver rounds.
  const LiftResult same = Lift(labels_, {{Kind::kNearer, other_way.other, other_way.joint, 0.0}});
  EXPECT_LT((same.poses[0].joints_in_cam_m - best.joints_in_cam_m).norm(), 0.05);
  EXPECT_LE(same.poses[0].cost, best.cost + 1e-3);
}

TEST_P(Hints, PinAJointInSpace) {
  const LiftedPose& best = without_.poses[0];
  Eigen::Vector3d x_m = best.joints_in_cam_m.col(joint::kLeftElbow);
  x_m.z() += 0.12;
  const LiftResult result = Lift(labels_, {{Kind::kPin, "left_elbow", "", {}, x_m}});
  ASSERT_TRUE(result.IsUsable());
  const auto distance_m = [&](const LiftedPose& pose) {
    return (pose.joints_in_cam_m.col(joint::kLeftElbow) - x_m).norm();
  };
  EXPECT_LT(distance_m(result.poses[0]), 0.05);
  EXPECT_GT(distance_m(best), 0.11);
  ExpectGoodReprojection(result.poses[0], best);
}

TEST_P(Hints, ThatContradictEachOtherGiveAPoseThatSaysWhichItDoesNotMeet) {
  const LiftResult result = Lift(labels_, {{Kind::kNearer, "left_wrist", "right_wrist", 0.1},
                                           {Kind::kNearer, "neck", "head_top", 2.0},
                                           {Kind::kNearer, "right_wrist", "left_wrist", 0.1}});
  ASSERT_TRUE(result.IsUsable());
  const std::vector<int>& unmet = result.poses[0].unmet_hints;
  EXPECT_TRUE(std::count(unmet.begin(), unmet.end(), 1) == 1);
  EXPECT_TRUE(std::count(unmet.begin(), unmet.end(), 0) == 1 ||
              std::count(unmet.begin(), unmet.end(), 2) == 1);
  EXPECT_THAT(result.BriefReport(), HasSubstr("not met"));
  EXPECT_TRUE(result.poses[0].joints_in_cam_m.allFinite());
}

TEST_P(Hints, SayWhatIsNotMetInTheResults) {
  Labels labels =
      ReadLabels(SourcePath("samples/photo/" + std::string(GetParam()) + ".exact.json"));
  labels.frames[0].people[0].hints = {{Kind::kNearer, "neck", "head_top", 2.0}};
  const LiftedLabels lifted = LiftLabels(TheLifter(), labels, {}, {});
  EXPECT_EQ(lifted.poses.frames[0].people[0].status, "ok");
  EXPECT_EQ(lifted.poses.frames[0].people[0].message, "hints not met: neck nearer than head_top");
}

TEST_P(Hints, HeightGivesMetresBeforeAKnownCamera) {
  const std::string stem = "samples/photo/" + std::string(GetParam());
  Labels labels = ReadLabels(SourcePath(stem + ".exact.json"));
  const Camera camera = ReadCamera(SourcePath(stem + ".camera.yaml"));
  const auto lift = [&](double height_m) {
    labels.frames[0].people[0].hints = {{Kind::kHeight, "", "", height_m}};
    return LiftLabels(TheLifter(), labels, camera, {});
  };
  const LiftedLabels small = lift(0.875), large = lift(1.75);
  const PersonPose& of_small = small.poses.frames[0].people[0];
  const PersonPose& of_large = large.poses.frames[0].people[0];
  const double size = large.results[0][0].poses[0].size;
  EXPECT_NEAR(size, 1.75 / Stature_m(TheLifter().dictionary().skeleton), 1e-12);
  // Half as tall is half as far.
  EXPECT_TRUE(testing::MatrixNear(2.0 * of_small.pelvis_in_cam_m, of_large.pelvis_in_cam_m, 1e-6));
  EXPECT_TRUE(testing::MatrixNear(2.0 * of_small.joints_in_cam_m, of_large.joints_in_cam_m, 1e-6));
  // The person is 1.75 m tall and stands where the truth has the pelvis.
  const std::map<std::string, double> depths_m = {
      {"kick", 4.67337}, {"reach", 4.04932}, {"throw", 4.38145}};
  const double depth_m = depths_m.at(GetParam());
  EXPECT_NEAR(of_large.pelvis_in_cam_m.z(), depth_m, 0.1 * depth_m);
  ASSERT_EQ(large.poses.bodies.size(), 1u);
  EXPECT_NEAR(large.poses.bodies[0].lengths_m[joint::kLeftKnee],
              (of_large.joints_in_cam_m.col(joint::kLeftKnee) -
               of_large.joints_in_cam_m.col(joint::kLeftHip))
                  .norm(),
              1e-6);
}

// Its camera is level, and both feet are on the floor.
TEST(LiftPhoto, PutsJointsOnTheFloor) {
  PersonLabels labels = SampleLabels("reach");
  std::erase_if(labels.landmarks,
                [](const LandmarkLabel& label) { return label.name == "right_ankle"; });
  const LiftResult result =
      Lift(labels, {{Kind::kOnFloor, "left_ankle"}, {Kind::kOnFloor, "right_ankle"}});
  ASSERT_TRUE(result.IsUsable());
  const Pose3& joints_m = result.poses[0].joints_in_cam_m;
  EXPECT_THAT(result.poses[0].unmet_hints, IsEmpty());
  EXPECT_NEAR(joints_m(1, joint::kLeftAnkle), joints_m(1, joint::kRightAnkle), 0.1);
  ExpectGoodReprojection(result.poses[0], Lift(labels, {}).poses[0]);
}

TEST(LiftPhoto, HasNeitherSizeNorUnmetHintsWithoutHints) {
  const LiftResult result = Lift(SampleLabels("kick"), {});
  EXPECT_EQ(result.poses[0].size, 1.0);
  EXPECT_THAT(result.poses[0].unmet_hints, IsEmpty());
}

}  // namespace
}  // namespace poselift
