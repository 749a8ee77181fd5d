// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the dictionary that ships, labels files on disk, the sample picture's labels. The mouse is
// where a window would have it. Checked: a joint that is dragged gets there and the rest stays
// about where it was, on the same bones; what was dragged is in the file and can be undone.
#include "ui/label/pose_drag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "lift/body_proportions.h"
#include "lift/dictionary_file.h"
#include "lift/normalize.h"
#include "src/draw/pose_view.h"
#include "src/io/labels.h"
#include "src/io/motion_file.h"
#include "tests/support/support.h"
#include "ui/label/label_session.h"
#include "ui/label/new_pose.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using Way = PoseDrag::Way;
using testing::ScratchDir;
using testing::SourcePath;

const Dictionary& TheDictionary() {
  static const Dictionary kDictionary = ReadDictionary(SourcePath("data/default.pldict"));
  return kDictionary;
}

const PhotoLifter& TheLifter() {
  static const PhotoLifter kLifter(TheDictionary());
  return kLifter;
}

// Of a pose without a picture.
class PoseDragTest : public ::testing::Test {
 protected:
  PoseDragTest() : file_(ScratchDir() / "hero.labels.json") {
    for (const char* left : {"hero.labels.json", ".hero.labels.json.journal"})
      fs::remove(ScratchDir() / left);
    CreatePoseFile(file_, "body15", TheDictionary().skeleton);
    Open();
  }

  void Open() {
    session_.reset();
    project_.reset();
    project_.emplace(file_);
    session_.emplace(&*project_, TheLifter(), nullptr);
    session_->WaitUntilSolved();
  }

  size_t Handle(std::string_view name) const {
    const auto found = std::ranges::find(session_->handles(), name, &PoseHandle::name);
    EXPECT_NE(found, session_->handles().end()) << name;
    return static_cast<size_t>(found - session_->handles().begin());
  }
  const Pose3& Joints_m() const { return session_->pose()->joints_in_cam_m; }
  Eigen::Vector3d Place_m(std::string_view name) const {
    return session_->handles()[Handle(name)].In(Joints_m());
  }
  // Returns where the mouse let it go.
  Eigen::Vector3d Drag(std::string_view name, const Eigen::Vector3d& by_m, Way way = Way::kFree) {
    const Eigen::Vector3d from_m = Place_m(name);
    EXPECT_TRUE(session_->PressHandle(Handle(name), way));
    for (const double part : {0.3, 0.7, 1.0}) session_->MoveHandle(from_m + part * by_m);
    session_->Release();
    session_->WaitUntilSolved();
    return from_m + by_m;
  }
  double Moved_m(std::string_view name, const Pose3& before_m) const {
    return (Place_m(name) - session_->handles()[Handle(name)].In(before_m)).norm();
  }
  void ExpectBonesOfTheSkeletonWithinLimits() const {
    const Skeleton& skeleton = TheDictionary().skeleton;
    const Eigen::VectorXd lengths_m = BoneLengths(skeleton);
    for (int j = 1; j < kNumJoints; ++j) {
      const int parent = Joints()[static_cast<size_t>(j)].parent;
      EXPECT_NEAR((Joints_m().col(j) - Joints_m().col(parent)).norm(), lengths_m[j], 1e-6);
    }
    Eigen::Index d = 0;
    for (const Bone& bone : skeleton.bones)
      for (const Dof& dof : bone.dofs) {
        EXPECT_GE(session_->pose()->pose.dofs[d], dof.lower - 1e-6) << bone.name;
        EXPECT_LE(session_->pose()->pose.dofs[d++], dof.upper + 1e-6) << bone.name;
      }
  }

  fs::path file_;
  std::optional<LabelProject> project_;
  std::optional<LabelSession> session_;
};

TEST_F(PoseDragTest, ANewPoseStandsUprightAndFacesTheCamera) {
  ASSERT_NE(session_->pose(), nullptr);
  EXPECT_GT(Place_m("left_ankle").y(), 0.7);
  EXPECT_LT(Place_m("head_top").y(), -0.5);
  EXPECT_GT(Place_m("left_shoulder").x(), 0.1);  // in the picture the left is at the right
  EXPECT_GT(Place_m("left_wrist").y(), Place_m("left_elbow").y());
  EXPECT_TRUE(session_->pose()->unmet_hints.empty());
  ExpectBonesOfTheSkeletonWithinLimits();
}

TEST_F(PoseDragTest, AWristGoesWhereItIsDraggedAndTheFeetStay) {
  const Pose3 before_m = Joints_m();
  const Eigen::Vector3d to_m = Drag("left_wrist", {0.1, -0.2, -0.1});
  EXPECT_LT((Place_m("left_wrist") - to_m).norm(), 0.03);
  for (const char* name : {"left_ankle", "right_ankle", "left_foot", "right_foot", "right_wrist"})
    EXPECT_LT(Moved_m(name, before_m), 0.03) << name;
  EXPECT_LT(Moved_m("head_top", before_m), 0.05);
  ExpectBonesOfTheSkeletonWithinLimits();
}

TEST_F(PoseDragTest, ThePoseAnswersOnTheWayAndTheLabelsWaitForTheRelease) {
  const std::string before = LabelsText(project_->labels());
  const Eigen::Vector3d from_m = Place_m("left_wrist"), by_m(0.0, -0.2, -0.1);
  ASSERT_TRUE(session_->PressHandle(Handle("left_wrist"), Way::kFree));
  session_->MoveHandle(from_m + by_m);
  session_->WaitUntilSolved();
  EXPECT_LT((Place_m("left_wrist") - from_m - by_m).norm(), 0.03);
  EXPECT_EQ(LabelsText(project_->labels()), before);
  session_->Release();
  EXPECT_NE(LabelsText(project_->labels()), before);
  EXPECT_EQ(project_->history().UndoName(), "pose left wrist");
}

TEST_F(PoseDragTest, APressWithoutAMoveChangesNothing) {
  ASSERT_TRUE(session_->PressHandle(Handle("left_wrist"), Way::kFree));
  session_->Release();
  EXPECT_FALSE(project_->history().CanUndo());
}

TEST_F(PoseDragTest, JointsDraggedOneAfterTheOtherStayWhereTheyWerePut) {
  const Eigen::Vector3d left_m = Drag("left_wrist", {0.15, -0.3, -0.1});
  const Eigen::Vector3d right_m = Drag("right_wrist", {-0.1, -0.3, -0.2});
  const Eigen::Vector3d ankle_m = Drag("right_ankle", {-0.1, -0.15, -0.1});
  EXPECT_LT((Place_m("left_wrist") - left_m).norm(), 0.04);
  EXPECT_LT((Place_m("right_wrist") - right_m).norm(), 0.04);
  EXPECT_LT((Place_m("right_ankle") - ankle_m).norm(), 0.04);
  EXPECT_TRUE(session_->PinnedAt(Handle("left_wrist")));
  EXPECT_FALSE(session_->PinnedAt(Handle("left_ankle")));
  ExpectBonesOfTheSkeletonWithinLimits();
}

TEST_F(PoseDragTest, UndoAndTheFileGiveTheSamePose) {
  const Pose3 standing_m = Joints_m();
  Drag("left_wrist", {0.15, -0.3, -0.1});
  const Pose3 raised_m = Joints_m();
  Drag("right_knee", {0.0, -0.2, -0.2}, Way::kByAngles);
  session_->Do(Action::kUndo);
  session_->WaitUntilSolved();
  EXPECT_TRUE(testing::MatrixNear(Joints_m(), raised_m, 1e-9));
  session_->Do(Action::kUndo);
  session_->WaitUntilSolved();
  EXPECT_TRUE(testing::MatrixNear(Joints_m(), standing_m, 1e-9));
  session_->Do(Action::kRedo);
  session_->Do(Action::kSave);
  Open();
  EXPECT_TRUE(testing::MatrixNear(Joints_m(), raised_m, 1e-6));  // six decimals in the file
}

TEST_F(PoseDragTest, ByAnglesTheLimbAloneMoves) {
  const Pose3 before_m = Joints_m();
  const Eigen::Vector3d to_m = Drag("left_wrist", {0.1, -0.25, -0.2}, Way::kByAngles);
  EXPECT_LT((Place_m("left_wrist") - to_m).norm(), 0.03);
  for (const PoseHandle& handle : session_->handles())
    if (!HangsOn(handle.joint, joint::kLeftShoulder)) {
      EXPECT_LT(Moved_m(handle.name, before_m), 0.01) << handle.name;
    }
  ExpectBonesOfTheSkeletonWithinLimits();
}

TEST_F(PoseDragTest, ByAnglesAPinnedElbowEndsTheLimb) {
  session_->TogglePin(Handle("left_elbow"));
  session_->WaitUntilSolved();
  const Pose3 before_m = Joints_m();
  Drag("left_wrist", {0.0, -0.2, -0.15}, Way::kByAngles);
  EXPECT_GT(Moved_m("left_wrist", before_m), 0.1);
  EXPECT_LT(Moved_m("left_elbow", before_m), 0.02);
}

TEST_F(PoseDragTest, WhatHangsOnNoLimbIsNotDraggedByAngles) {
  EXPECT_FALSE(session_->PressHandle(Handle("left_hip"), Way::kByAngles));
  EXPECT_NE(session_->Status().find("left hip"), std::string::npos);
  EXPECT_TRUE(session_->PressHandle(Handle("left_hip"), Way::kFree));
}

TEST_F(PoseDragTest, ThePelvisGoesDownBetweenFeetThatStay) {
  for (const char* foot : {"left_ankle", "right_ankle"}) session_->TogglePin(Handle(foot));
  session_->WaitUntilSolved();
  const Eigen::Vector3d ankle_m = Place_m("left_ankle"), by_m(0.0, 0.25, 0.0);
  Drag("pelvis", by_m);
  EXPECT_LT((Place_m("left_ankle") - (ankle_m - by_m)).norm(), 0.04);
  EXPECT_LT(Place_m("head_top").y(), -0.5);  // still upright
  ExpectBonesOfTheSkeletonWithinLimits();
}

TEST_F(PoseDragTest, APinIsPutWhereTheJointIsAndTakenAgain) {
  const Pose3 before_m = Joints_m();
  session_->Hover(Handle("left_foot"));
  session_->Do(Action::kPinJoint);
  session_->WaitUntilSolved();
  ASSERT_TRUE(session_->PinnedAt(Handle("left_foot")));
  EXPECT_LT(Moved_m("left_foot", before_m), 0.01);
  Drag("right_ankle", {-0.2, -0.3, 0.0});
  EXPECT_LT(Moved_m("left_foot", before_m), 0.02);
  const Pose3 dragged_m = Joints_m();
  session_->Do(Action::kPinJoint);
  session_->WaitUntilSolved();
  EXPECT_FALSE(session_->PinnedAt(Handle("left_foot")));
  EXPECT_LT((Joints_m() - dragged_m).colwise().norm().maxCoeff(), 0.03);
}

TEST_F(PoseDragTest, AMouseThatLeavesTheWindowAsksForNothingImpossible) {
  Drag("left_wrist", {1e5, -1e9, 300.0});
  EXPECT_TRUE(session_->PinnedAt(Handle("left_wrist")));
  ASSERT_NE(session_->pose(), nullptr);
  ExpectBonesOfTheSkeletonWithinLimits();
  for (int i = 0; i < 4; ++i) Drag("pelvis", {0.0, 4.0, 0.0});
  EXPECT_EQ(WhatIsWrongWith(session_->Hints().back(), session_->layout()), "");
}

TEST_F(PoseDragTest, AHeightMakesAllOfThePoseSmaller) {
  const Pose3 before_m = Joints_m();
  session_->GiveHeight(1.2);
  session_->WaitUntilSolved();
  EXPECT_LT(session_->pose()->size, 0.8);
  EXPECT_LT((Joints_m() - before_m).colwise().norm().maxCoeff(), 0.02);  // at the skeleton's size
}

TEST_F(PoseDragTest, KeyFramesAreCopiedPosedAndRemoved) {
  session_->Do(Action::kAddKeyFrame);
  EXPECT_EQ(session_->frame_index(), 1U);
  session_->WaitUntilSolved();
  const Pose3 standing_m = Joints_m();
  Drag("left_wrist", {0.15, -0.3, -0.1});
  session_->GoToFrame(0);
  session_->WaitUntilSolved();
  EXPECT_TRUE(testing::MatrixNear(Joints_m(), standing_m, 1e-9));
  session_->Do(Action::kAddKeyFrame);  // between the two
  session_->WaitUntilSolved();
  EXPECT_EQ(project_->labels().frames.size(), 3U);
  EXPECT_TRUE(testing::MatrixNear(Joints_m(), standing_m, 1e-9));
  session_->Do(Action::kRemoveFrame);
  EXPECT_EQ(project_->labels().frames.size(), 2U);
  const fs::path folder = ScratchDir() / "hero";
  session_->Export(folder);
  session_->WaitUntilExported();
  EXPECT_EQ(ReadMotion(folder / "poses.bvh").frames.size(), 16U);  // half a second
  session_->Do(Action::kUndo);
  EXPECT_EQ(project_->labels().frames.size(), 3U);
  session_->Do(Action::kRemoveFrame);
  session_->Do(Action::kRemoveFrame);
  session_->Do(Action::kRemoveFrame);
  EXPECT_EQ(project_->labels().frames.size(), 1U);
  EXPECT_NE(session_->Status().find("last key frame"), std::string::npos);
  const std::string text = LabelsText(project_->labels());
  Open();
  EXPECT_EQ(LabelsText(project_->labels()), text);
}

TEST_F(PoseDragTest, ThePictureShowsAllOfThePose) {
  const Eigen::Matrix2Xd joints_px = session_->PictureCamera().Project(Joints_m());
  EXPECT_GT(joints_px.minCoeff(), 0.0);
  EXPECT_LT(joints_px.maxCoeff(), 1000.0);
  EXPECT_GT(joints_px.row(1).maxCoeff() - joints_px.row(1).minCoeff(), 500.0);
}

TEST_F(PoseDragTest, LabelsInThePictureCountFromFourOn) {
  const Pose3 before_m = Joints_m();
  session_->Press({500.0, 500.0}, 5.0);
  session_->Release();
  session_->WaitUntilSolved();
  EXPECT_TRUE(testing::MatrixNear(Joints_m(), before_m, 1e-9));
}

// Of the sample picture, whose labels stay in force.
class PoseDragOnLabels : public PoseDragTest {
 protected:
  PoseDragOnLabels() {
    for (const char* left : {"kick.labels.json", ".kick.labels.json.journal"})
      fs::remove(ScratchDir() / left);
    file_ = ScratchDir() / "kick.labels.json";
    CreateLabelsFile(file_, ReadLabels(SourcePath("samples/photo/kick.labels.json")));
    Open();
  }
};

TEST_F(PoseDragOnLabels, ADragInDepthCompletesWhatThePictureDoesNotShow) {
  const double rms_px = session_->pose()->reprojection_rms_px;
  const Eigen::Vector3d from_m = Place_m("left_wrist");
  Drag("left_wrist", {0.0, 0.0, 0.12});
  EXPECT_GT(Place_m("left_wrist").z() - from_m.z(), 0.06);
  EXPECT_LT(session_->pose()->reprojection_rms_px, 1.5 * rms_px + 3.0);
  ASSERT_EQ(session_->Hints().size(), 1U);
  EXPECT_TRUE(IsFirmPin(session_->Hints()[0]));
  session_->TogglePin(Handle("left_wrist"));
  EXPECT_TRUE(session_->Hints().empty());
}

TEST_F(PoseDragOnLabels, ByAnglesTheRestHoldsStill) {
  const Pose3 before_m = Joints_m();
  const Eigen::Vector3d to_m = Drag("left_wrist", {0.0, 0.0, 0.1}, Way::kByAngles);
  EXPECT_LT((Place_m("left_wrist") - to_m).norm(), 0.05);
  for (const char* name : {"right_wrist", "left_ankle", "right_ankle", "head_top"})
    EXPECT_LT(Moved_m(name, before_m), 0.03) << name;
}

TEST_F(PoseDragOnLabels, MetresArePeoplesWhoseHeightIsKnown) {
  session_->GiveHeight(1.2);
  session_->WaitUntilSolved();
  const double size = session_->pose()->size;
  ASSERT_LT(size, 0.9);
  session_->TogglePin(Handle("left_wrist"));
  const LabelHint pin = session_->Hints().back();
  EXPECT_TRUE(testing::MatrixNear(pin.x_in_cam_m, size * Place_m("left_wrist"), 1e-9));
}

TEST(PoseHandles, AreTheJointsByTheNamesOfHints) {
  for (const Layout& layout : AllLayouts()) {
    const auto handles = PoseHandles(layout);
    EXPECT_EQ(handles.front().name, "pelvis");
    EXPECT_GE(handles.size(), 20U);
    for (const PoseHandle& handle : handles)
      EXPECT_EQ(WhatIsWrongWith({.kind = LabelHint::Kind::kPin, .joint = handle.name}, layout), "");
  }
  EXPECT_EQ(PoseHandles(*FindLayout("joints23")).size(), 23U);
}

TEST(PoseHandles, LimbsBeginBehindHipsShouldersAndPelvis) {
  using namespace joint;  // NOLINT(google-build-using-namespace)
  EXPECT_EQ(LimbUpTo(kLeftWrist), (std::vector<int>{kLeftWrist, kLeftElbow}));
  EXPECT_EQ(LimbUpTo(kRightFoot), (std::vector<int>{kRightFoot, kRightAnkle, kRightKnee}));
  EXPECT_EQ(LimbUpTo(kThorax), (std::vector<int>{kThorax, kUpperBack, kLowerBack}));
  EXPECT_TRUE(LimbUpTo(kLeftShoulder).empty());
  EXPECT_TRUE(HangsOn(kLeftHand, kThorax));
  EXPECT_FALSE(HangsOn(kLeftHand, kLeftHand));
}

TEST_F(PoseDragTest, APressTakesTheNearestJointAndTheViewGivesItsPlaceBack) {
  const Scene stage = PoseStage({.joints_in_cam_m = Joints_m()});
  for (const PoseOrbit& orbit : {PoseOrbit{}, PoseOrbit{.yaw_rad = 2.0, .pitch_rad = 0.8},
                                 PoseOrbit{.yaw_rad = 0.0, .pitch_rad = 0.0, .zoom = 2.0}}) {
    const Projection projection = PoseProjection(stage, orbit, 500);
    const Eigen::Vector3d wrist_m = Place_m("left_wrist");
    const Eigen::Vector2d at_px = projection.Flat(wrist_m);
    EXPECT_TRUE(testing::MatrixNear(projection.InCam(at_px, wrist_m), wrist_m, 1e-9));
    const auto hit =
        HitHandle(session_->handles(), Joints_m(), projection, at_px + Eigen::Vector2d(2, 1), 12.0);
    ASSERT_TRUE(hit);
    EXPECT_EQ(session_->handles()[*hit].name, "left_wrist");
    EXPECT_FALSE(HitHandle(session_->handles(), Joints_m(), projection, {3.0, 3.0}, 12.0));
  }
}

}  // namespace
}  // namespace poselift
