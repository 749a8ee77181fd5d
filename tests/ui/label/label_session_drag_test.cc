// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample picture's labels on disk, the dictionary that ships. Checked of drags beside
// labels, in the picture and in space: the pose answers on the way, from the pose before alone, and
// once the mouse lets go it is what a lift of the labels by itself gives, to the last bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "lift/dictionary_file.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;

class LabelSessionDrag : public ::testing::Test {
 protected:
  LabelSessionDrag() : dictionary_(ReadDictionary(testing::SourcePath("data/default.pldict"))) {
    const auto file = testing::ScratchDir() / "kick.labels.json";
    for (const char* left : {"kick.labels.json", ".kick.labels.json.journal"})
      std::filesystem::remove(testing::ScratchDir() / left);
    CreateLabelsFile(file, ReadLabels(testing::SourcePath("samples/photo/kick.labels.json")));
    project_.emplace(file);
    session_.emplace(&*project_, lifter_, [this] {
      ++count_;
      count_.notify_one();
    });
    session_->WaitUntilSolved();
  }

  const PersonLabels& Person() const { return session_->labels().frames[0].people[0]; }
  Eigen::Vector2d Place_px(std::string_view name) const {
    return LabelSession::Find(Person(), name)->x_px;
  }
  size_t Handle(std::string_view name) const {
    const auto found = std::ranges::find(session_->handles(), name, &PoseHandle::name);
    return static_cast<size_t>(found - session_->handles().begin());
  }
  double Distance_m(const Pose3& pose_m) const {
    return (session_->pose()->joints_in_cam_m - pose_m).norm();
  }
  void ExpectTheBestOfAllViews() const {
    const LiftResult full = lifter_.LiftPhoto(Observe(Person(), session_->layout()));
    ASSERT_EQ(session_->result().poses.size(), full.poses.size());
    for (size_t i = 0; i < full.poses.size(); ++i)
      EXPECT_EQ(session_->result().poses[i].joints_in_cam_m, full.poses[i].joints_in_cam_m);
  }

  Dictionary dictionary_;
  PhotoLifter lifter_{dictionary_};
  std::atomic<int> count_ = 0;  // of answers
  std::optional<LabelProject> project_;
  std::optional<LabelSession> session_;
};

TEST_F(LabelSessionDrag, OfALabelEndsInTheBestOfAllViews) {
  ASSERT_GT(session_->result().poses.size(), 1U);
  const Eigen::Vector2d from_px = Place_px("left_wrist");
  session_->Press(from_px, 8.0);
  for (int step = 1; step <= 10; ++step) {
    session_->Move(from_px + Eigen::Vector2d(-3.0 * step, 2.0 * step));
    session_->WaitUntilSolved();
    ASSERT_EQ(session_->result().poses.size(), 1U);  // from the pose before
    EXPECT_LT(session_->pose()->reprojection_rms_px, 20.0);
  }
  session_->Release();
  session_->WaitUntilSolved();
  ExpectTheBestOfAllViews();
}

TEST_F(LabelSessionDrag, OfAJointInSpaceEndsInTheBestOfAllViews) {
  for (const auto way : {PoseDrag::Way::kFree, PoseDrag::Way::kByAngles}) {
    const size_t wrist = Handle("left_wrist");
    const Eigen::Vector3d from_m = session_->handles()[wrist].In(session_->pose()->joints_in_cam_m);
    ASSERT_TRUE(session_->PressHandle(wrist, way));
    for (int step = 1; step <= 10; ++step) {
      session_->MoveHandle(from_m + Eigen::Vector3d(0.0, 0.0, 0.01 * step));
      session_->WaitUntilSolved();
      ASSERT_EQ(session_->result().poses.size(), 1U);
    }
    EXPECT_GT(session_->handles()[wrist].In(session_->pose()->joints_in_cam_m).z(), from_m.z());
    session_->Release();
    session_->WaitUntilSolved();
    ExpectTheBestOfAllViews();
  }
}

// What is chosen is no longer the best of all views, but the nearest of its alternatives.
TEST_F(LabelSessionDrag, OfALabelFollowsTheChosenAlternativeAndStaysWithIt) {
  ASSERT_GT(session_->result().poses.size(), 1U);
  const Pose3 best_m = session_->pose()->joints_in_cam_m;
  session_->Do(Action::kNextPose);
  const Pose3 chosen_m = session_->pose()->joints_in_cam_m;
  const Eigen::Vector2d from_px = Place_px("left_wrist");
  session_->Press(from_px, 8.0);
  for (int step = 1; step <= 4; ++step) {
    session_->Move(from_px + Eigen::Vector2d(-step, step));
    session_->WaitUntilSolved();
    EXPECT_LT(Distance_m(chosen_m), Distance_m(best_m));
  }
  session_->Release();
  session_->WaitUntilSolved();
  ExpectTheBestOfAllViews();
  EXPECT_GT(session_->pose_index(), 0U);
  EXPECT_LT(Distance_m(chosen_m), Distance_m(best_m));
  EXPECT_THAT(session_->Status(), HasSubstr(", not kept"));
  session_->Do(Action::kNudgeLeft);  // an edit that is no drag
  session_->WaitUntilSolved();
  EXPECT_LT(Distance_m(chosen_m), Distance_m(best_m));
  session_->Do(Action::kUndo);
  session_->WaitUntilSolved();
  EXPECT_EQ(session_->pose_index(), 0U);
}

TEST_F(LabelSessionDrag, OfAJointInSpaceEndsInTheNearestPoseOfAllViews) {
  session_->Do(Action::kNextPose);
  const size_t wrist = Handle("right_wrist");
  const Eigen::Vector3d from_m = session_->handles()[wrist].In(session_->pose()->joints_in_cam_m);
  ASSERT_TRUE(session_->PressHandle(wrist, PoseDrag::Way::kFree));
  session_->MoveHandle(from_m + Eigen::Vector3d(0.02, 0.0, 0.02));
  session_->WaitUntilSolved();
  const Pose3 followed_m = session_->pose()->joints_in_cam_m;
  session_->Release();
  session_->WaitUntilSolved();
  for (const LiftedPose& other : session_->result().poses)
    EXPECT_LE(Distance_m(followed_m), (other.joints_in_cam_m - followed_m).norm());
}

TEST_F(LabelSessionDrag, BackToWhereItBeganLeavesThePoseAsItWas) {
  const LiftResult before = session_->result();
  const Eigen::Vector2d from_px = Place_px("left_wrist");
  session_->Press(from_px, 8.0);
  for (const double by_px : {30.0, 60.0, 0.0}) {
    session_->Move(from_px + Eigen::Vector2d(by_px, 0.0));
    session_->WaitUntilSolved();
  }
  session_->Release();
  session_->WaitUntilSolved();
  ASSERT_EQ(session_->result().poses.size(), before.poses.size());
  EXPECT_EQ(session_->pose()->joints_in_cam_m, before.poses.front().joints_in_cam_m);
}

TEST_F(LabelSessionDrag, OfAllLabelsAndBackIsNoStepAndEndsInTheBestOfAllViews) {
  session_->PressPerson({100.0, 100.0});
  for (const double by_px : {40.0, 80.0, 0.0}) {
    session_->Move({100.0 + by_px, 100.0});
    session_->WaitUntilSolved();
    ASSERT_EQ(session_->result().poses.size(), 1U);
  }
  session_->Release();
  session_->WaitUntilSolved();
  EXPECT_FALSE(project_->history().CanUndo());
  ExpectTheBestOfAllViews();
}

TEST_F(LabelSessionDrag, ThatIsRefusedLeavesThePoseOfTheLabels) {
  LabelProject read_only(testing::ScratchDir() / "kick.labels.json");  // the other one writes
  ASSERT_TRUE(read_only.read_only());
  session_.emplace(&read_only, lifter_, nullptr);
  session_->WaitUntilSolved();
  session_->PressPerson({100.0, 100.0});
  session_->Move({140.0, 100.0});
  session_->WaitUntilSolved();
  session_->Release();
  session_->WaitUntilSolved();
  ExpectTheBestOfAllViews();
  EXPECT_EQ(session_->observation().points.front().x.head<2>(), Person().landmarks.front().x_px);
  session_.reset();
}

TEST_F(LabelSessionDrag, AnswersOfAMomentAgoAreShownWhileTheMouseGoesOn) {
  const Eigen::Vector2d from_px = Place_px("left_wrist");
  session_->Press(from_px, 8.0);
  const int before = count_;
  session_->Move(from_px + Eigen::Vector2d(-10.0, 0.0));
  count_.wait(before);
  session_->Move(from_px + Eigen::Vector2d(-20.0, 0.0));
  EXPECT_TRUE(session_->TakeAnswer());
  const auto& points = session_->observation().points;
  const auto wrist = std::ranges::find(points, "left_wrist", &ObservedPoint::name);
  ASSERT_NE(wrist, points.end());
  EXPECT_LT(wrist->x.x(), from_px.x());
  session_->WaitUntilSolved();
  EXPECT_FALSE(session_->is_solving());
}

TEST_F(LabelSessionDrag, FromTheFirstLabelOfAnotherPersonDoesNotBeginWithThisOnes) {
  session_->GoToPerson(1);
  session_->WaitUntilSolved();
  const PersonLabels first = Person();  // a copy: people move when another joins them
  for (const LandmarkLabel& label : first.landmarks) {
    session_->GoToLandmark(*session_->layout().Find(label.name));
    session_->Press(label.x_px + Eigen::Vector2d(250.0, 10.0), 1.0);
    session_->Release();
  }
  session_->WaitUntilSolved();
  ASSERT_EQ(session_->person_index(), 1U);
  // The other person's label: the first answer knows of all views.
  session_->Press(Place_px("left_wrist"), 8.0);
  session_->Move(Place_px("left_wrist") + Eigen::Vector2d(-10.0, 0.0));
  session_->WaitUntilSolved();
  ASSERT_EQ(session_->person_index(), 0U);
  EXPECT_GT(session_->result().poses.size(), 1U);
}

}  // namespace
}  // namespace poselift
