// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: a pose from nothing, dragged and keyed as an animator does, its labels file and journal,
// the files that are exported, also by the program. Checked: times are kept, undone and found
// again; the motion passes the key frames at their times, in the session and in all files; a frame
// between becomes a key frame as it is to be seen.
#include <gtest/gtest.h>

#include "lift/dictionary_file.h"
#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/io/labels.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "src/io/text_scanner.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"
#include "ui/label/label_session.h"
#include "ui/label/new_pose.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

const PhotoLifter& TheLifter() {
  static const Dictionary kDictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  static const PhotoLifter kLifter(kDictionary);
  return kLifter;
}

class LabelSessionKeysTest : public ::testing::Test {
 protected:
  LabelSessionKeysTest() : folder_(testing::ScratchDir()), file_(folder_ / "hero.labels.json") {
    for (const char* left : {"hero.labels.json", ".hero.labels.json.journal"})
      fs::remove(folder_ / left);
    CreatePoseFile(file_, "body15", TheLifter().dictionary().skeleton);
    Open();
  }

  void Open() {
    session_.reset();
    project_.reset();
    project_.emplace(file_);
    session_.emplace(&*project_, TheLifter(), nullptr);
    Wait();
  }
  void Wait() {
    session_->WaitUntilSolved();
    session_->WaitUntilSmoothed();
  }
  void Do(Action action) {
    session_->Do(action);
    Wait();
  }
  void Drag(std::string_view name, const Eigen::Vector3d& by_m) {
    const auto& handles = session_->handles();
    const auto handle = std::ranges::find(handles, name, &PoseHandle::name);
    const Eigen::Vector3d from_m = handle->In(session_->pose()->joints_in_cam_m);
    ASSERT_TRUE(
        session_->PressHandle(static_cast<size_t>(handle - handles.begin()), PoseDrag::Way::kFree));
    session_->MoveHandle(from_m + by_m);
    session_->Release();
    Wait();
  }
  // Standing; an arm up; a knee up besides.
  void MakeThree() {
    Do(Action::kAddKeyFrame);
    Drag("left_wrist", {0.15, -0.6, -0.2});
    Do(Action::kAddKeyFrame);
    Drag("right_knee", {0.0, -0.2, -0.25});
  }
  std::vector<int> Numbers() const { return session_->Keys().numbers; }
  Pose3 KeyJoints_m(size_t key) {
    session_->GoToFrame(key);
    Wait();
    return session_->pose()->joints_in_cam_m;
  }
  const Pose3& ShownJoints_m() const { return session_->ShownPose()->joints_in_cam_m; }

  fs::path folder_, file_;
  std::optional<LabelProject> project_;
  std::optional<LabelSession> session_;
};

// From the pelvis; the file has y up.
Pose3 InCam_m(const Motion& motion, size_t frame) {
  Pose3 joints_m = JointPositions(motion.skeleton, motion.frames[frame]);
  joints_m.colwise() -= Eigen::Vector3d(joints_m.col(joint::kPelvis));
  return Eigen::Vector3d(1, -1, -1).asDiagonal() * joints_m;
}

TEST_F(LabelSessionKeysTest, KeyFramesAreHalfASecondApartUntilTheyAreMoved) {
  MakeThree();
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
  EXPECT_EQ(session_->Keys().fps, 30.0);
  EXPECT_EQ(project_->labels().frames[2].time_s, 1.0);
  session_->GoToFrame(1);
  Do(Action::kKeyLater);
  Do(Action::kKeyLater);
  Do(Action::kKeyEarlier);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 16, 30}));
  EXPECT_EQ(session_->frame_index(), 1U);
  EXPECT_NE(session_->Status().find("key frame 2 of 3, frame 16, 0.53 s"), std::string::npos)
      << session_->Status();
  Do(Action::kUndo);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
}

TEST_F(LabelSessionKeysTest, TimesAreFoundAgainSavedOrNot) {
  MakeThree();
  session_->MoveKey(1, 5, Along::kAllBehind);
  session_->ChangeRate(24.0);
  const std::string text = LabelsText(project_->labels());
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 4, 16}));
  Open();  // from the journal
  EXPECT_EQ(LabelsText(project_->labels()), text);
  EXPECT_EQ(session_->Keys().fps, 24.0);
  Do(Action::kUndo);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 5, 20}));
  Do(Action::kRedo);
  Do(Action::kSave);
  Open();
  EXPECT_EQ(LabelsText(project_->labels()), text);
  EXPECT_EQ(LabelsText(ReadLabels(file_)), text);
}

TEST_F(LabelSessionKeysTest, ARateThatIsChosenFirstHoldsForKeyFramesToCome) {
  session_->ChangeRate(24.0);
  Do(Action::kAddKeyFrame);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 12}));
  EXPECT_EQ(project_->labels().frames[1].time_s, 0.5);
}

TEST_F(LabelSessionKeysTest, TheMotionIsThereAfterEachChangeAndPassesTheKeyFrames) {
  MakeThree();
  session_->MoveKey(1, 10, Along::kAlone);
  Wait();
  ASSERT_NE(session_->motion(), nullptr);
  EXPECT_TRUE(session_->IsMotionCurrent());
  EXPECT_EQ(session_->NumMotionFrames(), 31U);
  EXPECT_EQ(session_->motion()->angles_deg.cols(), 31);
  EXPECT_TRUE(session_->motion()->angles_deg.allFinite());
  const std::vector<Pose3> keys_m = {KeyJoints_m(0), KeyJoints_m(1), KeyJoints_m(2)};
  EXPECT_GT((keys_m[1] - keys_m[0]).norm(), 0.3);
  for (const auto& [frame, key] : {std::pair<size_t, size_t>{0, 0}, {10, 1}, {30, 2}}) {
    session_->PlayTo(frame);
    EXPECT_TRUE(session_->ShowsMotion());
    EXPECT_TRUE(testing::MatrixNear(ShownJoints_m(), keys_m[key], 1e-9)) << frame;
  }
  session_->GoToNumber(5);
  EXPECT_TRUE(session_->IsBetween());
  EXPECT_EQ(session_->frame_index(), 0U);
  const double before = (ShownJoints_m() - keys_m[0]).norm();
  const double behind = (ShownJoints_m() - keys_m[1]).norm();
  EXPECT_GT(before, 0.1);
  EXPECT_GT(behind, 0.1);
  EXPECT_FALSE(session_->PressHandle(0, PoseDrag::Way::kFree));
  Do(Action::kStepForward);
  EXPECT_EQ(session_->Number(), 6);
  Do(Action::kRemoveFrame);
  EXPECT_EQ(project_->labels().frames.size(), 3U);
  EXPECT_EQ(session_->Status(), "this is no key frame: go to one first");
  Do(Action::kPreviousFrame);  // the key frame before
  EXPECT_EQ(session_->Number(), 0);
  EXPECT_FALSE(session_->IsBetween());
}

TEST_F(LabelSessionKeysTest, AFrameBetweenBecomesAKeyFrameAsItIsSeen) {
  MakeThree();
  session_->GoToNumber(22);
  Wait();
  const Pose3 seen_m = ShownJoints_m();
  Do(Action::kAddKeyFrame);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 22, 30}));
  EXPECT_EQ(session_->frame_index(), 2U);
  EXPECT_FALSE(session_->IsBetween());
  const double off_m = (session_->pose()->joints_in_cam_m - seen_m).colwise().norm().maxCoeff();
  EXPECT_LT(off_m, 0.03);
  session_->GoToNumber(50);  // behind the last: its pose
  Do(Action::kAddKeyFrame);
  EXPECT_EQ(Numbers().back(), 50);
  EXPECT_LT((KeyJoints_m(4) - KeyJoints_m(3)).colwise().norm().maxCoeff(), 0.03);
  Do(Action::kUndo);
  Do(Action::kUndo);
  EXPECT_EQ(Numbers(), (std::vector<int>{0, 15, 30}));
}

TEST_F(LabelSessionKeysTest, PlayedInRealTime) {
  MakeThree();
  session_->ChangeRate(60.0);
  const Playback playback = session_->PlaybackFrom(10);
  EXPECT_EQ(playback.FrameAt(0.0), 10U);
  EXPECT_EQ(playback.FrameAt(0.5 + 1e-9), 40U);
  EXPECT_EQ(playback.FrameAt(9.0), 60U);
  EXPECT_FALSE(playback.IsOver(0.8));
  EXPECT_TRUE(playback.IsOver(0.84));
}

TEST_F(LabelSessionKeysTest, AllFilesHaveTheMotionAtItsRate) {
  MakeThree();
  session_->ChangeRate(24.0);
  session_->MoveKey(1, 8, Along::kAlone);
  Wait();
  Do(Action::kSave);
  session_->Export(folder_ / "all");
  session_->WaitUntilExported();
  for (const char* file : {"one.bvh", "one.json", "one.csv", "one.amc"}) {
    session_->ExportMotion(folder_ / file);
    session_->WaitUntilExported();
  }
  const auto run = testing::RunProgram("lift --labels " + file_.string() + " --out " +
                                       (folder_ / "program").string());
  EXPECT_EQ(run.code, 0) << run.err;
  for (const fs::path bvh : {"all/poses.bvh", "one.bvh", "program/poses.bvh"}) {
    const Motion motion = ReadMotion(folder_ / bvh);
    ASSERT_EQ(motion.frames.size(), 25U) << bvh;
    EXPECT_NEAR(motion.frame_time_s, 1.0 / 24.0, 1e-7) << bvh;
    for (const auto& [frame, key] : {std::pair<size_t, size_t>{0, 0}, {8, 1}, {24, 2}})
      EXPECT_TRUE(testing::MatrixNear(InCam_m(motion, frame), KeyJoints_m(key), 1e-3)) << bvh;
  }
  for (const fs::path json : {"all/poses.json", "one.json", "program/poses.json"}) {
    const Poses poses = ReadPosesJson(folder_ / json);
    ASSERT_EQ(poses.frames.size(), 25U) << json;
    EXPECT_NEAR(*poses.frames[8].time_s, 1.0 / 3.0, 1e-5) << json;
    EXPECT_TRUE(
        testing::MatrixNear(poses.frames[8].people[0].joints_in_cam_m, KeyJoints_m(1), 1e-5))
        << json;
  }
  for (const fs::path table : {"all/angles.csv", "one.csv", "program/angles.csv"}) {
    const std::string text = ReadTextFile(folder_ / table);
    EXPECT_EQ(std::ranges::count(text, '\n'), 26) << table;
  }
  EXPECT_EQ(ReadMotion(folder_ / "one.amc").frames.size(), 25U);
  EXPECT_FALSE(fs::exists(folder_ / "all/angles_sigma.csv"));
}

}  // namespace
}  // namespace poselift
