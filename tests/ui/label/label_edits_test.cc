// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the edits. Made up: the labels. Properties: what each edit changes and what it leaves,
// symmetries (mirroring and swapping twice, turning back), names for menus.
#include "ui/label/label_edits.h"

#include <gmock/gmock.h>

#include <numbers>
#include <stdexcept>

#include "src/joint_relation.h"
#include "tests/support/random_labels.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::ElementsAre;
using testing::ExactText;
using ::testing::IsEmpty;
using testing::MatrixNear;
using testing::SomeLabels;

Labels After(Labels labels, const LabelEdit& edit) {
  CheckEdit(labels, edit);
  ApplyEdit(edit, &labels);
  return labels;
}

// Knees, the right one occluded with a radius, and an absent nose, of person 3 in frame 0.
Labels TwoKnees() {
  Labels labels{"coco17", {FrameLabels(), FrameLabels()}};
  labels.frames[0].people = {{3,
                              {{"left_knee", {10.0, 20.0}, LabelState::kVisible, {}},
                               {"right_knee", {30.0, 60.0}, LabelState::kOccluded, 2.0},
                               {"nose", {500.0, 0.0}, LabelState::kAbsent, {}}}}};
  return labels;
}
constexpr PersonRef kPerson{0, 3};

const LandmarkLabel& At(const Labels& labels, std::string_view landmark) {
  return *FindLandmark(labels, kPerson, landmark);
}

TEST(LabelEdits, PlaceAddsPersonAndLandmarkAndForgetsTheRadius) {
  const LabelEdit edit = PlaceLandmark(TwoKnees(), {1, 0}, "left_knee", {1.5, 2.5});
  EXPECT_EQ(edit.name, "place left knee");
  const Labels labels = After(TwoKnees(), edit);
  EXPECT_EQ(FindLandmark(labels, {1, 0}, "left_knee")->x_px, Eigen::Vector2d(1.5, 2.5));
  EXPECT_EQ(labels.frames[0].people.size(), 1u);

  const Labels again = After(TwoKnees(), PlaceLandmark(TwoKnees(), kPerson, "right_knee", {1, 2}));
  EXPECT_EQ(At(again, "right_knee").state, LabelState::kVisible);
  EXPECT_EQ(At(again, "right_knee").radius_px, std::nullopt);
  EXPECT_THROW(PlaceLandmark(TwoKnees(), kPerson, "left_wing", {1, 2}), std::invalid_argument);
  EXPECT_THROW(PlaceLandmark(TwoKnees(), {2, 0}, "nose", {1, 2}), std::out_of_range);
}

TEST(LabelEdits, MoveKeepsTheStateButShowsWhatWasAbsent) {
  Labels labels = After(TwoKnees(), MoveLandmark(TwoKnees(), kPerson, "right_knee", {7, 8}));
  EXPECT_EQ(At(labels, "right_knee").x_px, Eigen::Vector2d(7, 8));
  EXPECT_EQ(At(labels, "right_knee").state, LabelState::kOccluded);
  labels = After(labels, NudgeLandmark(labels, kPerson, "nose", {1, -1}));
  EXPECT_EQ(At(labels, "nose").x_px, Eigen::Vector2d(501, -1));
  EXPECT_EQ(At(labels, "nose").state, LabelState::kVisible);
  EXPECT_THROW(MoveLandmark(labels, kPerson, "left_ear", {1, 2}), std::invalid_argument);
}

TEST(LabelEdits, StatesGoRoundAndKeepThePlace) {
  Labels labels = TwoKnees();
  const std::string before = ExactText(labels);
  for (const LabelState wanted :
       {LabelState::kOccluded, LabelState::kAbsent, LabelState::kVisible}) {
    labels = After(labels, CycleLandmarkState(labels, kPerson, "left_knee"));
    EXPECT_EQ(At(labels, "left_knee").state, wanted);
  }
  EXPECT_EQ(ExactText(labels), before);
  EXPECT_EQ(SetLandmarkState(labels, kPerson, "left_knee", LabelState::kAbsent).name,
            "mark left knee as absent");
}

TEST(LabelEdits, PeopleAndLandmarksComeAndGo) {
  Labels labels = After(TwoKnees(), RemoveLandmark(TwoKnees(), kPerson, "nose"));
  EXPECT_EQ(FindLandmark(labels, kPerson, "nose"), nullptr);
  EXPECT_EQ(FreePersonId(labels, 0), 0);
  labels = After(labels, AddPerson(labels, {0, 0}));
  EXPECT_EQ(FreePersonId(labels, 0), 1);
  EXPECT_THROW(AddPerson(labels, {0, 0}), std::invalid_argument);
  labels = After(labels, RemovePerson(labels, kPerson));
  EXPECT_EQ(FindPerson(labels, kPerson), nullptr);
  EXPECT_NE(FindPerson(labels, {0, 0}), nullptr);
  EXPECT_THROW(RemovePerson(labels, kPerson), std::invalid_argument);
}

TEST(LabelEdits, SidesAreSwappedAndSwappedBack) {
  const Labels swapped = After(TwoKnees(), SwapSides(TwoKnees(), kPerson));
  EXPECT_EQ(At(swapped, "right_knee").x_px, Eigen::Vector2d(10, 20));
  EXPECT_EQ(At(swapped, "left_knee").radius_px, 2.0);
  EXPECT_EQ(At(swapped, "nose").x_px, Eigen::Vector2d(500, 0));
  EXPECT_EQ(ExactText(After(swapped, SwapSides(swapped, kPerson))), ExactText(TwoKnees()));
}

TEST(LabelEdits, TheMirroredPictureIsMirroredBack) {
  const Labels mirrored = After(TwoKnees(), MirrorFrame(TwoKnees(), 0, 640));
  EXPECT_EQ(At(mirrored, "right_knee").x_px, Eigen::Vector2d(629, 20));
  EXPECT_EQ(At(mirrored, "left_knee").state, LabelState::kOccluded);
  EXPECT_EQ(ExactText(After(mirrored, MirrorFrame(mirrored, 0, 640))), ExactText(TwoKnees()));
  EXPECT_THROW(MirrorFrame(TwoKnees(), 0, 0), std::invalid_argument);
}

TEST(LabelEdits, TheWholePersonMovesTurnsAndGrowsAboutItsCenter) {
  const Labels labels = TwoKnees();  // the absent nose does not count
  EXPECT_EQ(PersonCenter(labels.frames[0].people[0]), Eigen::Vector2d(20, 40));
  const Labels moved = After(labels, MovePerson(labels, kPerson, {1, -1}));
  EXPECT_EQ(At(moved, "nose").x_px, Eigen::Vector2d(501, -1));
  const Labels turned = After(labels, RotatePerson(labels, kPerson, std::numbers::pi / 2));
  EXPECT_TRUE(MatrixNear(At(turned, "left_knee").x_px, Eigen::Vector2d(40, 30), 1e-9));
  const Labels back = After(turned, RotatePerson(turned, kPerson, -std::numbers::pi / 2));
  EXPECT_TRUE(MatrixNear(At(back, "right_knee").x_px, Eigen::Vector2d(30, 60), 1e-9));
  const Labels grown = After(labels, ScalePerson(labels, kPerson, 2.0));
  EXPECT_EQ(At(grown, "right_knee").x_px, Eigen::Vector2d(40, 80));
  EXPECT_EQ(At(grown, "right_knee").radius_px, 4.0);
  EXPECT_THROW(ScalePerson(labels, kPerson, 0.0), std::invalid_argument);
}

TEST(LabelEdits, ACopiedPersonKeepsItsFlagsAndTakesItsOwnPlace) {
  Labels labels = TwoKnees();
  labels.frames[1].people = {{3, {}}, {4, {}}};
  const LabelEdit edit = CopyPerson(labels, kPerson, 1);
  EXPECT_EQ(edit.name, "copy person 3 from frame 1");
  labels = After(labels, edit);
  ASSERT_EQ(labels.frames[1].people.size(), 2u);
  EXPECT_EQ(FindLandmark(labels, {1, 3}, "right_knee")->state, LabelState::kOccluded);
  EXPECT_EQ(FindLandmark(labels, {1, 3}, "right_knee")->radius_px, 2.0);
  EXPECT_THROW(CopyPerson(labels, {0, 9}, 1), std::invalid_argument);
}

using Kind = LabelHint::Kind;

std::vector<std::string> Hints(const Labels& labels) {
  std::vector<std::string> said;
  for (const LabelHint& hint : FindPerson(labels, kPerson)->hints) said.push_back(Describe(hint));
  return said;
}

TEST(LabelEdits, HintsTakeThePlaceOfWhatIsSaidOfTheSame) {
  const LabelHint nearer{Kind::kNearer, "left_wrist", "right_wrist"};
  const LabelEdit one = GiveHints(TwoKnees(), kPerson, {nearer});
  EXPECT_EQ(one.name, "hint: left wrist nearer than right wrist");
  Labels labels = After(TwoKnees(), one);
  const LabelEdit four = GiveHints(labels, kPerson,
                                   {{Kind::kTowardsCamera, "left_knee"},
                                    {Kind::kTowardsCamera, "right_knee"},
                                    {Kind::kHeight, "", "", 1.8},
                                    {Kind::kPin, "left_hand", "", {}, {0.1, 0.2, 0.3}}});
  EXPECT_EQ(four.name, "4 hints");
  labels = After(labels, four);
  EXPECT_THAT(
      Hints(labels),
      ElementsAre("left_wrist nearer than right_wrist", "the bone to left_knee towards the camera",
                  "the bone to right_knee towards the camera", "1.8 m tall", "left_hand pinned"));
  labels = After(labels, GiveHints(labels, kPerson,
                                   {{Kind::kNearer, "right_wrist", "left_wrist"},
                                    {Kind::kAwayFromCamera, "left_knee"},
                                    {Kind::kHeight, "", "", 1.6},
                                    {Kind::kOnFloor, "left_hand"}}));
  EXPECT_THAT(Hints(labels), ElementsAre("the bone to right_knee towards the camera",
                                         "left_hand pinned", "right_wrist nearer than left_wrist",
                                         "the bone to left_knee away from the camera", "1.6 m tall",
                                         "left_hand on the floor"));
  const LabelEdit forgotten = RemoveHint(labels, kPerson, 1);
  EXPECT_EQ(forgotten.name, "forget: left hand pinned");
  EXPECT_EQ(Hints(After(labels, forgotten)).size(), 5u);
  EXPECT_THROW(RemoveHint(labels, kPerson, 6), std::out_of_range);
  EXPECT_THAT(Hints(After(labels, RemoveHints(labels, kPerson))), IsEmpty());
  EXPECT_THROW(GiveHints(labels, {1, 0}, {nearer}), std::invalid_argument);
}

TEST(LabelEdits, HintsFollowTheirSides) {
  // A hand is a joint of the body, not of the layout.
  const Labels labels =
      After(TwoKnees(), GiveHints(TwoKnees(), kPerson,
                                  {{Kind::kNearer, "left_wrist", "right_knee"},
                                   {Kind::kPin, "left_hand", "", {}, {0.1, 0.2, 0.3}}}));
  const Labels swapped = After(labels, SwapSides(labels, kPerson));
  EXPECT_THAT(Hints(swapped),
              ElementsAre("right_wrist nearer than left_knee", "right_hand pinned"));
  EXPECT_EQ(FindPerson(swapped, kPerson)->hints[1].x_in_cam_m, Eigen::Vector3d(0.1, 0.2, 0.3));
  const Labels mirrored = After(labels, MirrorFrame(labels, 0, 640));
  EXPECT_THAT(Hints(mirrored), Hints(swapped));
  EXPECT_EQ(FindPerson(mirrored, kPerson)->hints[1].x_in_cam_m, Eigen::Vector3d(-0.1, 0.2, 0.3));
  EXPECT_EQ(ExactText(After(mirrored, MirrorFrame(mirrored, 0, 640))), ExactText(labels));
}

}  // namespace
}  // namespace poselift
