// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample picture of a kick with its labels, and the dictionary that ships. Moved: that
// picture, by so many pixels from file to file, so that every label has its truth.
#include "ui/label/label_flow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lift/dictionary_file.h"
#include "src/input_error.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

constexpr size_t kFrames = 7;
const Eigen::Vector2d kStep_px(3.5, -1.25);

class LabelFlowTest : public ::testing::Test {
 protected:
  LabelFlowTest() : dir_(testing::ScratchDir()) {
    labels_ = ReadLabels(testing::SourcePath("samples/photo/kick.labels.json"));
    person_ = labels_.frames[0].people[0];
    const cv::Mat kick = cv::imread(testing::SourcePath("samples/photo/kick.jpg").string());
    const FrameLabels first = labels_.frames[0];
    labels_.frames.clear();
    for (size_t f = 0; f < kFrames; ++f) {
      const Eigen::Vector2d by_px = static_cast<double>(f) * kStep_px;
      const cv::Matx23d shift(1, 0, by_px.x(), 0, 1, by_px.y());
      cv::Mat moved;
      cv::warpAffine(kick, moved, shift, kick.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      FrameLabels& frame = labels_.frames.emplace_back(first);
      frame.image = std::to_string(f) + ".png";
      if (f > 0) frame.people.clear();
      cv::imwrite((dir_ / frame.image).string(), moved);
    }
  }

  Eigen::Vector2d Truth_px(const std::string& name, size_t frame) const {
    return LabelSession::Find(person_, name)->x_px + static_cast<double>(frame) * kStep_px;
  }
  double WorstError_px(const PersonLabels& person, size_t frame) const {
    double worst_px = 0.0;
    for (const LandmarkLabel& label : person.landmarks)
      if (label.state == LabelState::kVisible)
        worst_px = std::max(worst_px, (label.x_px - Truth_px(label.name, frame)).norm());
    return worst_px;
  }
  void MakeKey(size_t frame) {
    PersonLabels& person = labels_.frames[frame].people.emplace_back(person_);
    for (LandmarkLabel& label : person.landmarks) label.x_px = Truth_px(label.name, frame);
  }

  std::filesystem::path dir_;
  Labels labels_;
  PersonLabels person_;
  Dictionary dictionary_ = ReadDictionary(testing::SourcePath("data/default.pldict"));
  PhotoLifter lifter_{dictionary_};
};

TEST_F(LabelFlowTest, LabelsAreFollowedThroughTheRowOfPictures) {
  const GuessedLabels guesses = FollowPerson(labels_, dir_, {0, 0}, Reach::kForwards);
  ASSERT_EQ(guesses.frames.size(), kFrames - 1);
  for (const auto& [frame, person] : guesses.frames) {
    EXPECT_TRUE(person.is_propagated);
    EXPECT_GT(person.landmarks.size(), 12U);
    EXPECT_LT(WorstError_px(person, frame), 3.0) << frame;
  }
}

TEST_F(LabelFlowTest, BackwardsGoesToTheKeyFrameBeforeAndForwardsToTheNext) {
  MakeKey(4);
  const auto frames_of = [](const GuessedLabels& guesses) {
    std::vector<size_t> frames;
    for (const auto& [frame, person] : guesses.frames) frames.push_back(frame);
    return frames;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(frames_of(FollowPerson(labels_, dir_, {4, 0}, Reach::kBackwards)),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(frames_of(FollowPerson(labels_, dir_, {0, 0}, Reach::kForwards)),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(frames_of(FollowPerson(labels_, dir_, {2, 0}, Reach::kAround)),
              ElementsAre(1, 2, 3, 5, 6));
  EXPECT_THROW(FollowPerson(labels_, dir_, {2, 0}, Reach::kForwards), InputError);
}

TEST_F(LabelFlowTest, PicturesOfAnotherSizeEndTheRow) {
  labels_.frames[3].width_px += 1;
  const GuessedLabels guesses = FollowPerson(labels_, dir_, {0, 0}, Reach::kAround);
  EXPECT_EQ(guesses.frames.rbegin()->first, 2U);
}

TEST_F(LabelFlowTest, WhatAPersonSaidStays) {
  GuessedLabels guesses = FollowPerson(labels_, dir_, {0, 0}, Reach::kForwards);
  MakeKey(2);
  const LabelEdit edit = PutGuesses(labels_, guesses);
  EXPECT_FALSE(edit.people.contains(2));
  EXPECT_TRUE(edit.people.contains(3));
  guesses.replaces = true;
  EXPECT_TRUE(PutGuesses(labels_, guesses).people.contains(2));
  ApplyEdit(edit, &labels_);
  EXPECT_FALSE(IsKeyFrame(labels_, {3, 0}));
  ApplyEdit(AcceptGuess(labels_, {3, 0}), &labels_);
  EXPECT_TRUE(IsKeyFrame(labels_, {3, 0}));
}

TEST_F(LabelFlowTest, OneThatIsTouchedIsAKeyFrameAndWhereItIsPutItIsSure) {
  ApplyEdit(PutGuesses(labels_, FollowPerson(labels_, dir_, {0, 0}, Reach::kForwards)), &labels_);
  ASSERT_TRUE(FindLandmark(labels_, {1, 0}, "left_knee")->radius_px.has_value());
  ApplyEdit(MoveLandmark(labels_, {1, 0}, "left_knee", {10, 20}), &labels_);
  EXPECT_TRUE(IsKeyFrame(labels_, {1, 0}));
  EXPECT_FALSE(FindLandmark(labels_, {1, 0}, "left_knee")->radius_px.has_value());
  EXPECT_TRUE(FindLandmark(labels_, {1, 0}, "neck")->radius_px.has_value());
}

TEST_F(LabelFlowTest, FromThePictureBeforeComesWhatHadNoLabelToo) {
  std::erase_if(labels_.frames[0].people[0].landmarks,
                [](const LandmarkLabel& label) { return label.name == "left_wrist"; });
  const GuessedLabels guesses = FollowFromFrameBefore(labels_, dir_, {1, 0}, lifter_);
  const PersonLabels& person = guesses.frames.at(1);
  EXPECT_EQ(person.landmarks.size(), 15U);
  EXPECT_LT(WorstError_px(person, 1), 3.0);
  EXPECT_EQ(LabelSession::Find(person, "left_wrist")->state, LabelState::kOccluded);
  EXPECT_THROW(FollowFromFrameBefore(labels_, dir_, {3, 0}, lifter_), InputError);
}

TEST_F(LabelFlowTest, PosesBetweenGoEvenlyFromOneToTheOther) {
  EXPECT_THROW(PosesBetween(labels_, {2, 0}, lifter_), InputError);
  MakeKey(6);
  const GuessedLabels guesses = PosesBetween(labels_, {2, 0}, lifter_);
  ASSERT_EQ(guesses.frames.size(), 5U);
  const LiftResult lifted = lifter_.LiftPhoto(Observe(person_, *FindLayout(labels_.layout)));
  const double pose_px = lifted.poses.front().reprojection_rms_px;
  for (const auto& [frame, person] : guesses.frames) {
    double sum_px2 = 0.0;
    for (const LandmarkLabel& label : person.landmarks)
      sum_px2 += (label.x_px - Truth_px(label.name, frame)).squaredNorm();
    // As far off as the pose of a key frame is.
    EXPECT_NEAR(std::sqrt(sum_px2 / static_cast<double>(person.landmarks.size())), pose_px, 1.0);
  }
}

TEST_F(LabelFlowTest, TheSessionFollowsInTheBackgroundAsOneStep) {
  const auto file = dir_ / "flow.labels.json";
  for (const char* left : {"flow.labels.json", ".flow.labels.json.journal"})
    std::filesystem::remove(dir_ / left);
  CreateLabelsFile(file, labels_);
  LabelProject project(file);
  LabelSession session(&project, lifter_, nullptr);
  EXPECT_TRUE(session.Do(Action::kFollowAll));
  EXPECT_TRUE(session.FollowProgress().has_value());
  session.WaitUntilFollowed();
  EXPECT_FALSE(session.FollowProgress().has_value());
  EXPECT_EQ(session.labels().frames[6].people.size(), 1U);
  EXPECT_TRUE(session.Do(Action::kUndo));
  EXPECT_TRUE(session.labels().frames[6].people.empty());
  session.GoToFrame(1);
  session.Do(Action::kCopyFollowed);
  session.WaitUntilFollowed();
  ASSERT_EQ(session.labels().frames[1].people.size(), 1U);
  session.GoToLandmark(0);
  session.Do(Action::kNudgeLeft);
  const auto nudged_px = session.labels().frames[1].people[0].landmarks[0].x_px;
  session.Do(Action::kCopyFollowed);  // replaces what a person said
  session.WaitUntilFollowed();
  EXPECT_NE(session.labels().frames[1].people[0].landmarks[0].x_px, nudged_px);
  session.GoToFrame(6);
  session.Do(Action::kFollowForwards);
  session.WaitUntilFollowed();
  EXPECT_THAT(session.Status(), ::testing::HasSubstr("wanted some to follow"));
}

}  // namespace
}  // namespace poselift
