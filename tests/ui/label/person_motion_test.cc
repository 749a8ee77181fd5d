// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: labels of a walk in every frame, a part of them, the dictionary and the motion codebook
// that ship. Checked: a person's motion is what the program lifts; marks tell whose labels changed
// and where.
#include "ui/label/person_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift/dictionary_file.h"
#include "lift/lifted_files.h"
#include "src/input_error.h"
#include "src/joint_angles.h"
#include "tests/support/support.h"
#include "tests/support/walk_labels.h"

namespace poselift {
namespace {

using testing::ShortWalk;

class PersonMotionTest : public ::testing::Test {
 protected:
  Dictionary dictionary_ = ReadDictionary(testing::SourcePath("data/default.pldict"));
  PhotoLifter lifter_{dictionary_};
};

TEST_F(PersonMotionTest, IsWhatLiftMakesOfLabelsWithTimes) {
  Labels walk = ShortWalk(20, 8);
  PersonLabels other = walk.frames[3].people[0];
  other.id = 7;
  walk.frames[3].people.insert(walk.frames[3].people.begin(), other);
  const int id = walk.frames[0].people[0].id;
  const PersonMotion motion = LiftPersonAsMotion(lifter_, walk, id, 0, {});
  ASSERT_TRUE(motion.HasPoses()) << motion.message;
  walk.frames[3].people.erase(walk.frames[3].people.begin());
  const LiftedLabels wanted = LiftAsMotion(lifter_, walk, {});
  for (size_t f = 0; f < walk.frames.size(); ++f) {
    EXPECT_EQ(motion.is_filled[f], f >= 8 && f < 11) << f;
    ASSERT_NE(motion.PoseOf(f), nullptr) << f;
    EXPECT_TRUE(testing::MatrixNear(motion.PoseOf(f)->joints_in_cam_m,
                                    wanted.results[f][0].poses[0].joints_in_cam_m, 0.0));
    const auto& angles = wanted.poses.frames[f].people[0].angles_deg;
    for (size_t a = 0; a < angles.size(); ++a) {
      EXPECT_EQ(angles[a].first, JointAngles()[a].name);
      EXPECT_EQ(motion.angles_deg(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(f)),
                angles[a].second);
    }
    EXPECT_GT(motion.Sigma_deg(f), 0.0);
  }
  EXPECT_EQ(motion.PoseOf(walk.frames.size()), nullptr);
  EXPECT_TRUE(std::isnan(motion.Sigma_deg(walk.frames.size())));
}

TEST_F(PersonMotionTest, IsOfTheVideoOfTheFrame) {
  const Labels alone = ShortWalk(6, -1);
  const int id = alone.frames[0].people[0].id;
  Labels both = alone;
  both.frames.insert(both.frames.end(), alone.frames.begin(), alone.frames.end());
  for (size_t f = 0; f < both.frames.size(); ++f) {
    both.frames[f].image = f < 6 ? "a.mp4" : "b.mp4";
    both.frames[f].frame = static_cast<int>(f % 6);
  }
  both.frames[1].people.clear();
  EXPECT_EQ(FramesOfVideo(both, 5), (FrameSpan{0, 5}));
  EXPECT_EQ(FramesOfVideo(both, 6), (FrameSpan{6, 11}));
  EXPECT_NE(WhyFramesAlone(both).find("a.mp4 and b.mp4"), std::string::npos);
  const PersonMotion motion = LiftPersonAsMotion(lifter_, both, id, 7, {});
  ASSERT_TRUE(motion.HasPoses()) << motion.message;
  const PersonMotion wanted = LiftPersonAsMotion(lifter_, alone, id, 0, {});
  EXPECT_EQ(motion.times_s.tail(6), wanted.times_s);
  EXPECT_EQ(motion.angles_deg.rightCols(6), wanted.angles_deg);
  for (size_t f = 0; f < 6; ++f) {
    EXPECT_EQ(motion.PoseOf(f), nullptr);
    EXPECT_TRUE(std::isnan(motion.Sigma_deg(f)));
    EXPECT_EQ(motion.PoseOf(6 + f)->joints_in_cam_m, wanted.PoseOf(f)->joints_in_cam_m);
  }
  both.frames[2].people.clear();  // of the other video
  EXPECT_EQ(LabelMarks(both, id, motion.video), motion.label_marks);
  both.frames[8].people.clear();
  EXPECT_NE(LabelMarks(both, id, motion.video), motion.label_marks);
}

TEST_F(PersonMotionTest, SaysWhyThereIsNone) {
  Labels walk = ShortWalk(6, -1);
  const int id = walk.frames[0].people[0].id;
  EXPECT_NE(LiftPersonAsMotion(lifter_, walk, id + 1, 0, {}).message, "");
  Labels two = walk;
  two.frames.resize(2);
  EXPECT_NE(LiftPersonAsMotion(lifter_, two, id, 0, {}).message.find("2 frames"),
            std::string::npos);
  Labels untimed = walk;
  untimed.frames[4].time_s.reset();
  EXPECT_NE(LiftPersonAsMotion(lifter_, untimed, id, 0, {}).message.find("frame 5"),
            std::string::npos);
  Labels back = walk;
  back.frames[3].time_s = 0.0;
  EXPECT_FALSE(LiftPersonAsMotion(lifter_, back, id, 0, {}).HasPoses());
  for (FrameLabels& frame : walk.frames) *frame.time_s *= 10.0;
  EXPECT_NE(LiftPersonAsMotion(lifter_, walk, id, 0, {}).message.find("between frames"),
            std::string::npos);
}

TEST(LabelMarks, TellWhoseLabelsChangedAndWhere) {
  Labels walk = ShortWalk(5, -1);
  const int id = walk.frames[0].people[0].id;
  const auto before = LabelMarks(walk, id, {0, 4});
  PersonLabels other = walk.frames[2].people[0];
  other.id = id + 1;
  walk.frames[2].people.push_back(other);
  EXPECT_EQ(LabelMarks(walk, id, {0, 4}), before);
  walk.frames[2].people[0].landmarks[0].x_px.x() += 0.1;
  walk.frames[4].people[0].hints.push_back(
      {.kind = LabelHint::Kind::kOnFloor, .joint = "left_foot"});
  const auto after = LabelMarks(walk, id, {0, 4});
  for (size_t f = 0; f < after.size(); ++f) EXPECT_EQ(after[f] != before[f], f == 2 || f == 4) << f;
}

TEST_F(PersonMotionTest, IsWrittenByTheEndingOfTheFile) {
  const Labels walk = ShortWalk(8, -1);
  const LiftedLabels lifted = LiftAsMotion(lifter_, walk, {});
  const auto folder = testing::ScratchDir();
  WriteLifted(lifted, walk, dictionary_.skeleton, true, 30.0, folder);
  for (const LiftedFormat& format : LiftedFormats()) {
    const auto file = folder / ("one" + std::string(format.ending));
    WriteLiftedMotion(lifted, dictionary_.skeleton, file);
    EXPECT_GT(std::filesystem::file_size(file), 100U) << file;
  }
  EXPECT_THROW(WriteLiftedMotion(lifted, dictionary_.skeleton, folder / "one.fbx"), InputError);
  EXPECT_THROW(WriteLiftedMotion(lifted, dictionary_.skeleton, "/dev/null/one.bvh"), InputError);
  EXPECT_THROW(WriteLiftedMotion({}, dictionary_.skeleton, folder / "none.bvh"), InputError);
}

}  // namespace
}  // namespace poselift
