// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the labels of the sample picture of a kick, clicked again without a window, and the
// dictionary that ships. Checked: what the mouse and the keys leave in the labels, which landmark
// is asked for next, and that the newest labels are answered.
#include "ui/label/label_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "lift/dictionary_file.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "tests/support/walk_labels.h"

namespace poselift {
namespace {

constexpr double kReach_px = 8.0;

class LabelSessionTest : public ::testing::Test {
 protected:
  LabelSessionTest() : dictionary_(ReadDictionary(testing::SourcePath("data/default.pldict"))) {
    const auto file = testing::ScratchDir() / "kick.labels.json";
    for (const char* left : {"kick.labels.json", ".kick.labels.json.journal"})
      std::filesystem::remove(testing::ScratchDir() / left);
    Labels empty = ReadLabels(testing::SourcePath("samples/photo/kick.labels.json"));
    person_ = empty.frames[0].people[0];
    empty.frames[0].people.clear();
    empty.frames.push_back(empty.frames[0]);
    CreateLabelsFile(file, empty);
    project_.emplace(file);
    session_.emplace(&*project_, lifter_, nullptr);
  }

  const Eigen::Vector2d& Place_px(std::string_view name) const {
    return LabelSession::Find(person_, name)->x_px;
  }
  void Click(const Eigen::Vector2d& x_px) {
    session_->Press(x_px, kReach_px);
    session_->Release();
  }
  void ClickAll() {
    for (const Landmark& landmark : session_->layout().landmarks) Click(Place_px(landmark.name));
  }
  std::string AtHand() const {
    return std::string(
        session_->layout().landmarks[static_cast<size_t>(session_->landmark())].name);
  }
  const std::vector<PersonLabels>& People() const { return session_->labels().frames[0].people; }
  const LandmarkLabel* Label(std::string_view name, size_t person = 0) const {
    return LabelSession::Find(People().at(person), name);
  }

  Dictionary dictionary_;
  PhotoLifter lifter_{dictionary_};
  PersonLabels person_;
  std::optional<LabelProject> project_;
  std::optional<LabelSession> session_;
};

TEST_F(LabelSessionTest, ClicksPlaceTheLandmarksInOrder) {
  ClickAll();
  ASSERT_EQ(People().size(), 1U);
  ASSERT_EQ(People()[0].landmarks.size(), session_->layout().landmarks.size());
  for (const LandmarkLabel& label : People()[0].landmarks)
    EXPECT_EQ(label.x_px, Place_px(label.name)) << label.name;
  session_->WaitUntilSolved();
  ASSERT_NE(session_->pose(), nullptr);
  EXPECT_LT(session_->pose()->reprojection_rms_px, 8.0);
  EXPECT_TRUE(session_->Residual_px("left_knee").has_value());
}

// Hips lie on each other from the side.
TEST_F(LabelSessionTest, AClickNearAnotherLabelPlacesWhatIsStillMissing) {
  Click({100, 100});
  Click({103, 101});
  EXPECT_EQ(Label("pelvis")->x_px, Eigen::Vector2d(100, 100));
  EXPECT_EQ(Label("neck")->x_px, Eigen::Vector2d(103, 101));
}

TEST_F(LabelSessionTest, APressThatMovesDragsAndOneThatShakesIsAClick) {
  ClickAll();
  const Eigen::Vector2d knee_px = Place_px("left_knee"), by_px(30, -12);
  session_->Press(knee_px + Eigen::Vector2d(2, 1), kReach_px);
  session_->Move(knee_px + Eigen::Vector2d(3, 1));
  session_->Release();
  EXPECT_EQ(Label("left_knee")->x_px, knee_px);
  EXPECT_EQ(AtHand(), "left_knee");
  session_->Press(knee_px + Eigen::Vector2d(2, 1), kReach_px);
  session_->Move(knee_px + Eigen::Vector2d(2, 1) + by_px);
  EXPECT_EQ(Label("left_knee")->x_px, knee_px);  // until it is let go
  session_->Release();
  EXPECT_EQ(Label("left_knee")->x_px, knee_px + by_px);
  ASSERT_TRUE(session_->Do(Action::kUndo));
  EXPECT_EQ(Label("left_knee")->x_px, knee_px);
}

TEST_F(LabelSessionTest, AllOfAPersonIsMovedAsOneStep) {
  ClickAll();
  const Eigen::Vector2d by_px(11, 7);
  session_->PressPerson({50, 50});
  session_->Move({55, 50});
  session_->Move(Eigen::Vector2d(50, 50) + by_px);
  session_->Release();
  for (const LandmarkLabel& label : People()[0].landmarks)
    EXPECT_TRUE(testing::MatrixNear(label.x_px, Place_px(label.name) + by_px, 1e-9));
  session_->TurnPersonBy(0.1);
  session_->TurnPersonBy(-0.3);
  session_->Do(Action::kUndo);
  session_->Do(Action::kUndo);
  for (const LandmarkLabel& label : People()[0].landmarks)
    EXPECT_TRUE(testing::MatrixNear(label.x_px, Place_px(label.name), 1e-9));
}

TEST_F(LabelSessionTest, PeopleHaveLabelsOfTheirOwn) {
  Click({10, 10});
  session_->Do(Action::kNewPerson);
  EXPECT_EQ(AtHand(), "pelvis");
  Click({200, 10});
  ASSERT_EQ(People().size(), 2U);
  EXPECT_EQ(Label("pelvis", 1)->x_px, Eigen::Vector2d(200, 10));
  session_->Do(Action::kNextPerson);
  EXPECT_EQ(session_->person_index(), 0U);
  EXPECT_EQ(AtHand(), "neck");
  session_->Do(Action::kRemovePerson);
  ASSERT_EQ(People().size(), 1U);
  EXPECT_EQ(Label("pelvis")->x_px, Eigen::Vector2d(200, 10));
}

TEST_F(LabelSessionTest, KeysGoThroughPicturesAndCopyLabels) {
  Click({10, 10});
  session_->Do(Action::kNextUnlabelled);
  EXPECT_EQ(session_->frame_index(), 1U);
  EXPECT_EQ(AtHand(), "pelvis");
  session_->Do(Action::kCopyPrevious);
  EXPECT_EQ(session_->labels().frames[1].people.at(0).landmarks.at(0).x_px,
            Eigen::Vector2d(10, 10));
  session_->Do(Action::kForward10);
  EXPECT_EQ(session_->frame_index(), 1U);
  session_->Do(Action::kFirstFrame);
  EXPECT_EQ(session_->frame_index(), 0U);
}

TEST_F(LabelSessionTest, SaysHowMuchIsDone) {
  EXPECT_EQ(session_->NumLabels() + session_->NumLabelledFrames(), 0U);
  Click({10, 10});
  Click({60, 10});
  EXPECT_EQ(session_->NumLabels(), 2U);
  session_->Do(Action::kNextFrame);
  EXPECT_EQ(session_->NumLabels(), 0U);
  EXPECT_EQ(session_->NumLabelledFrames(), 1U);
}

TEST_F(LabelSessionTest, WhatIsTakenBackIsSeen) {
  Click({10, 10});
  session_->Do(Action::kLastFrame);
  session_->Do(Action::kUndo);
  EXPECT_EQ(session_->frame_index(), 0U);
  EXPECT_TRUE(People().empty());
  session_->Do(Action::kLastFrame);
  session_->Do(Action::kRedo);
  EXPECT_EQ(session_->frame_index(), 0U);
  EXPECT_EQ(Label("pelvis")->x_px, Eigen::Vector2d(10, 10));
  session_->Do(Action::kUndo);  // at the frame at hand
  EXPECT_EQ(session_->frame_index(), 0U);
}

TEST_F(LabelSessionTest, AKeyGoesToThePictureThatWasChangedLast) {
  session_->Do(Action::kLastChanged);
  EXPECT_EQ(session_->frame_index(), 0U);
  session_->Do(Action::kNextFrame);
  Click({10, 10});
  session_->Do(Action::kFirstFrame);
  session_->Do(Action::kLastChanged);
  EXPECT_EQ(session_->frame_index(), 1U);
}

TEST_F(LabelSessionTest, KeysGoFromVideoToVideo) {
  Labels videos = session_->labels();
  const FrameLabels picture = videos.frames[0];
  videos.frames.clear();
  for (const char* image : {"a.mp4", "a.mp4", "b.mp4", "b.mp4", "c.mp4"}) {
    videos.frames.push_back(picture);
    videos.frames.back().image = image;
    videos.frames.back().frame = static_cast<int>(videos.frames.size());
  }
  LabelProject project(testing::FreshLabelsFile(testing::ScratchDir(), videos));
  LabelSession session(&project, lifter_, nullptr);
  const auto goes_to = [&](Action action) {
    session.Do(action);
    return session.frame_index();
  };
  session.GoToFrame(1);
  EXPECT_EQ(goes_to(Action::kNextVideo), 2U);
  EXPECT_EQ(goes_to(Action::kNextVideo), 4U);
  EXPECT_EQ(goes_to(Action::kNextVideo), 4U);  // there is no other
  EXPECT_EQ(goes_to(Action::kPreviousVideo), 2U);
  session.GoToFrame(3);
  EXPECT_EQ(goes_to(Action::kPreviousVideo), 0U);
  EXPECT_EQ(goes_to(Action::kPreviousVideo), 0U);
}

TEST_F(LabelSessionTest, KeysChangeTheLandmarkAtHand) {
  Click({10, 10});
  session_->Do(Action::kPreviousJoint);
  session_->Do(Action::kCycleState);
  EXPECT_EQ(Label("pelvis")->state, LabelState::kOccluded);
  session_->Do(Action::kNudgeRight);
  session_->Do(Action::kNudgeDown);
  EXPECT_TRUE(testing::MatrixNear(Label("pelvis")->x_px, Eigen::Vector2d(10.1, 10.1), 1e-9));
  session_->Do(Action::kRemove);
  EXPECT_EQ(Label("pelvis"), nullptr);
}

TEST_F(LabelSessionTest, ALimbIsFlippedAndTheFlipUndone) {
  ClickAll();
  session_->WaitUntilSolved();
  const auto depth_m = [&] {
    const Pose3& x = session_->pose()->joints_in_cam_m;
    return x(2, joint::kRightKnee) - x(2, *FindJoint("right_hip"));
  };
  const double before_m = depth_m();
  session_->GoToLandmark(*session_->layout().Find("right_knee"));
  session_->Do(Action::kFlipLimb);
  session_->WaitUntilSolved();
  EXPECT_FALSE(session_->Hints().empty());
  EXPECT_LT(depth_m() * before_m, 0.0);
  EXPECT_TRUE(session_->pose()->unmet_hints.empty());
  session_->Do(Action::kUndo);
  session_->WaitUntilSolved();
  EXPECT_TRUE(session_->Hints().empty());
  EXPECT_NEAR(depth_m(), before_m, 1e-6);
}

TEST_F(LabelSessionTest, AnAlternativeIsKeptByHints) {
  ClickAll();
  session_->WaitUntilSolved();
  ASSERT_GT(session_->result().poses.size(), 1U);
  session_->Do(Action::kNextPose);
  const Pose3 wanted_m = session_->pose()->joints_in_cam_m;
  const Pose3 other_m = session_->result().poses[0].joints_in_cam_m;
  session_->Do(Action::kKeepPose);
  session_->WaitUntilSolved();
  const Pose3& kept_m = session_->pose()->joints_in_cam_m;
  EXPECT_LT((kept_m - wanted_m).norm(), (kept_m - other_m).norm());
}

TEST_F(LabelSessionTest, OneJointIsSaidToBeNearerThanAnother) {
  ClickAll();
  session_->GoToLandmark(*session_->layout().Find("left_wrist"));
  session_->Do(Action::kNearer);
  EXPECT_NE(session_->Status().find("farther from the camera than left wrist"), std::string::npos);
  Click(Place_px("head_top"));
  ASSERT_EQ(session_->Hints().size(), 1U);
  EXPECT_EQ(session_->Hints()[0].joint, "left_wrist");
  EXPECT_EQ(session_->Hints()[0].other, "head_top");
  session_->WaitUntilSolved();
  const Pose3& x = session_->pose()->joints_in_cam_m;
  EXPECT_LT(x(2, *FindJoint("left_wrist")), x(2, *FindJoint("head_top")));
  session_->GiveHeight(1.6);
  session_->GiveHeight(1.9);
  EXPECT_EQ(session_->Hints().size(), 2U);
  session_->RemoveHintAt(0);
  EXPECT_EQ(session_->Hints().at(0).kind, LabelHint::Kind::kHeight);
  session_->Do(Action::kForgetHints);
  EXPECT_TRUE(session_->Hints().empty());
}

TEST_F(LabelSessionTest, AHintThatSaysNothingIsAnsweredInWords) {
  ClickAll();
  session_->GoToLandmark(*session_->layout().Find("pelvis"));
  session_->Do(Action::kTowardsCamera);
  EXPECT_TRUE(session_->Hints().empty());
  EXPECT_NE(session_->Status().find("pelvis"), std::string::npos);
}

TEST_F(LabelSessionTest, TheNewestLabelsAreAnswered) {
  ClickAll();
  session_->WaitUntilSolved();
  const Pose3 before_m = session_->pose()->joints_in_cam_m;
  session_->Press(Place_px("left_ankle"), kReach_px);
  for (int step = 1; step <= 20; ++step)
    session_->Move(Place_px("left_ankle") + Eigen::Vector2d(2.0 * step, 0.0));
  session_->Release();
  session_->WaitUntilSolved();
  EXPECT_FALSE(session_->is_solving());
  EXPECT_GT((session_->pose()->joints_in_cam_m - before_m).norm(), 0.01);
  const auto& points = session_->observation().points;
  const auto ankle = std::ranges::find(points, "left_ankle", &ObservedPoint::name);
  ASSERT_NE(ankle, points.end());
  EXPECT_EQ(ankle->x.head<2>(), Place_px("left_ankle") + Eigen::Vector2d(40.0, 0.0));
}

}  // namespace
}  // namespace poselift
