// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the dictionary that ships, poses of pins lifted from nothing. Checked: when key frames are,
// of whatever is said; and that the motion through them has all frames, passes each key frame at
// its time and leaves no joint beyond its limits between.
#include "lift/key_frames.h"

#include <gtest/gtest.h>

#include "lift/dictionary_file.h"
#include "lift/lifted_files.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/support.h"
#include "tests/support/walk_labels.h"
#include "ui/label/new_pose.h"

namespace poselift {
namespace {

const PhotoLifter& TheLifter() {
  static const Dictionary kDictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  static const PhotoLifter kLifter(kDictionary);
  return kLifter;
}

const Skeleton& TheSkeleton() { return TheLifter().dictionary().skeleton; }

FrameLabels Standing() { return NewPose(*FindLayout("body15"), TheSkeleton()).frames[0]; }

FrameLabels With(FrameLabels frame, std::string_view joint, const Eigen::Vector3d& by_m) {
  for (LabelHint& hint : frame.people[0].hints)
    if (hint.joint == joint) {
      hint.x_in_cam_m += by_m;
      hint.metres_m = 0.01;
    }
  return frame;
}

FrameLabels At(FrameLabels frame, std::optional<int> number, std::optional<double> time_s) {
  frame.frame = number;
  frame.time_s = time_s;
  return frame;
}

// Standing, an arm raised, and a knee lifted besides.
Labels ThreeKeys(double fps, const std::vector<int>& numbers) {
  const FrameLabels wave = With(Standing(), "left_wrist", {0.1, -0.9, -0.1});
  const std::vector<FrameLabels> poses = {Standing(), wave,
                                          With(wave, "right_knee", {0.0, -0.25, -0.3})};
  Labels labels{"body15", {}};
  for (size_t k = 0; k < poses.size(); ++k)
    labels.frames.push_back(At(poses[k], numbers[k], numbers[k] / fps));
  return labels;
}

std::vector<int> NumbersOf(const std::vector<FrameLabels>& frames) {
  return KeyTimesOf({"body15", frames}).numbers;
}

TEST(KeyFrames, AreOfPinsWithoutPictures) {
  EXPECT_TRUE(AreKeyFrames(ThreeKeys(30.0, {0, 15, 30})));
  Labels walk = testing::ShortWalk(4, -1);
  for (FrameLabels& frame : walk.frames) frame.image.clear();
  EXPECT_FALSE(AreKeyFrames(walk));
  Labels pinned{"body15", {Standing()}};
  pinned.frames[0].image = "skier.jpg";
  EXPECT_FALSE(AreKeyFrames(pinned));
}

TEST(KeyFrames, TellTheirTimesAndTheRate) {
  const KeyTimes times = KeyTimesOf(ThreeKeys(24.0, {2, 7, 31}));
  EXPECT_EQ(times.fps, 24.0);
  EXPECT_EQ(times.numbers, (std::vector<int>{2, 7, 31}));
  EXPECT_EQ(times.KeyAt(0), 0U);
  EXPECT_EQ(times.KeyAt(7), 1U);
  EXPECT_EQ(times.KeyAt(30), 1U);
  EXPECT_EQ(times.KeyAt(99), 2U);
  EXPECT_EQ(KeyTimesOf(ThreeKeys(30000.0 / 1001.0, {0, 100, 101})).fps, 29.97);
  EXPECT_EQ(KeyTimesOf({"body15", {At(Standing(), 0, 0.0)}}, 24.0).fps, 24.0);
}

TEST(KeyFrames, ThatSayNothingAreHalfASecondApartAndAllGrow) {
  const FrameLabels unsaid = At(Standing(), {}, {});
  EXPECT_EQ(NumbersOf({unsaid, unsaid, unsaid}), (std::vector<int>{0, 15, 30}));
  EXPECT_EQ(NumbersOf({At(unsaid, {}, 0.1), At(unsaid, {}, 0.7)}), (std::vector<int>{3, 21}));
  EXPECT_EQ(NumbersOf({At(unsaid, 5, {}), At(unsaid, 5, {}), At(unsaid, 1, {})}),
            (std::vector<int>{5, 6, 7}));
  EXPECT_EQ(NumbersOf({At(unsaid, {}, -1e9), At(unsaid, {}, 1e9)}).front(), 0);
}

TEST(KeyFrames, BecomeAMotionThatPassesThem) {
  const Labels keys = ThreeKeys(24.0, {4, 10, 40});
  EXPECT_EQ(WhyFramesAlone(keys), "");
  std::vector<double> parts;
  const LiftedLabels motion =
      LiftKeyFrames(TheLifter(), keys, [&](double part) { parts.push_back(part); });
  EXPECT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts.back(), 1.0);
  const LiftedLabels alone = LiftLabels(TheLifter(), keys, std::nullopt, {});
  ASSERT_EQ(motion.results.size(), 37U);
  for (size_t k = 0; k < 3; ++k) {
    const auto frame = static_cast<size_t>(*keys.frames[k].frame - 4);
    EXPECT_TRUE(testing::MatrixNear(motion.results[frame][0].poses[0].joints_in_cam_m,
                                    alone.results[k][0].poses[0].joints_in_cam_m, 0.0));
  }
  const Motion written = ToMotionOverTime(motion, TheSkeleton());
  EXPECT_EQ(written.frames.size(), 37U);
  EXPECT_DOUBLE_EQ(written.frame_time_s, 1.0 / 24.0);
  Pose3 before_m = motion.results[0][0].poses[0].joints_in_cam_m;
  for (size_t f = 0; f < motion.results.size(); ++f) {
    EXPECT_DOUBLE_EQ(*motion.poses.frames[f].time_s, (4.0 + static_cast<double>(f)) / 24.0);
    EXPECT_EQ(motion.poses.frames[f].people[0].status, "ok");
    const LiftedPose& pose = motion.results[f][0].poses[0];
    EXPECT_LT((pose.joints_in_cam_m - before_m).colwise().norm().maxCoeff(), 0.35) << f;
    EXPECT_NEAR(JointPositions(written.skeleton, written.frames[f]).row(1).minCoeff(), 0.0, 1e-9);
    before_m = pose.joints_in_cam_m;
    Eigen::Index d = 0;
    for (const Bone& bone : TheSkeleton().bones)
      for (const Dof& dof : bone.dofs) {
        EXPECT_GE(pose.pose.dofs[d], dof.lower - 1e-6) << bone.name;
        EXPECT_LE(pose.pose.dofs[d++], dof.upper + 1e-6) << bone.name;
      }
  }
}

TEST(KeyFrames, ThatCannotBeLiftedDoNotCountAndOthersLeaveNoGap) {
  Labels keys = ThreeKeys(30.0, {0, 10, 20});
  keys.frames[1].people[0].hints.clear();
  PersonLabels late = keys.frames[2].people[0];
  late.id = 3;
  keys.frames[2].people.push_back(late);
  const LiftedLabels motion = LiftKeyFrames(TheLifter(), keys, {});
  ASSERT_EQ(motion.results.size(), 21U);
  for (size_t f = 0; f < 21; ++f) {
    EXPECT_EQ(motion.results[f].size(), f == 20 ? 2U : 1U) << f;
    EXPECT_EQ(motion.poses.frames[f].people.size(), motion.results[f].size());
    EXPECT_TRUE(motion.results[f][0].IsUsable()) << f;
  }
}

TEST(KeyFrames, TooFarApartAreRefused) {
  EXPECT_THROW(LiftKeyFrames(TheLifter(), ThreeKeys(30.0, {0, 1, 2000000000}), {}), InputError);
}

}  // namespace
}  // namespace poselift
