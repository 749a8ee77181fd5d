// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the models that ship. Made up: a person in tags who swings arms and legs, and what
// a detector sees of it. Checked: poses against the truth, what happens to tags that are
// wrong, lost or lean both ways, and what is foretold.
#include "lift/tracking/tag_tracker.h"

#include <gtest/gtest.h>

#include <random>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "lift/tracking/tracked_person.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/level_camera.h"
#include "tests/support/support.h"
#include "tests/support/tagged_person.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;

constexpr double kFrameTime_s = 1.0 / 30.0;
constexpr double kNoise_px = 0.1;

class TagTrackerTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    dictionary_ = new Dictionary(ReadDictionary(testing::SourcePath("data/default.pldict")));
    codebook_ = std::make_shared<MotionCodebook>(
        WithMirrored(ReadMotionCodebook(testing::SourcePath("data/default.plmotion"))));
  }
  static void TearDownTestSuite() {
    codebook_.reset();
    delete dictionary_;
  }

  TagTrackerTest() : lifter_(*dictionary_), person_(dictionary_->skeleton) {}

  TagTracker Tracker(const TagTrackerOptions& options = {}) const {
    return {person_.skeleton, person_.worn, person_.camera, kLevelFromCam,
            lifter_,          codebook_,    options};
  }

  static double TimeOf(int frame) { return frame * kFrameTime_s; }
  std::vector<TagSighting> Seen(int frame) {
    return person_.Sight(person_.PoseAt(TimeOf(frame)), kNoise_px, &rng_);
  }
  double Error_mm(const TrackedFrame& frame) const {
    const Pose3 found = JointPositions(person_.skeleton, frame.body.pose);
    const Pose3 truth = JointPositions(person_.skeleton, person_.PoseAt(frame.body.time_s));
    return 1e3 * (found - truth).colwise().norm().mean();
  }

  static const Dictionary* dictionary_;
  static std::shared_ptr<const MotionCodebook> codebook_;
  PhotoLifter lifter_;
  testing::TaggedPerson person_;
  std::mt19937_64 rng_ = testing::TestRng();
};

const Dictionary* TagTrackerTest::dictionary_ = nullptr;
std::shared_ptr<const MotionCodebook> TagTrackerTest::codebook_;

TEST_F(TagTrackerTest, FollowsAPersonFromTheFirstFrameOn) {
  TagTracker tracker = Tracker();
  double sum_mm = 0.0;
  for (int f = 0; f < 45; ++f) {
    tracker.Add(TimeOf(f), Seen(f));
    const auto frame = tracker.Take();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->body.kind, Kind::kMeasured);
    EXPECT_LT(Error_mm(*frame), 60.0) << f;
    for (const TrackedTag& tag : frame->tags) EXPECT_TRUE(tag.is_believed) << f << " " << tag.id;
    sum_mm += Error_mm(*frame);
  }
  EXPECT_LT(sum_mm / 45, 20.0);
}

TEST_F(TagTrackerTest, TheBodyTellsWhichWayTagsLean) {
  TagTracker tracker = Tracker();
  for (int f = 0; f < 20; ++f) {
    std::vector<TagSighting> seen = Seen(f);
    for (TagSighting& tag : seen) {
      std::reverse(tag.poses.begin(), tag.poses.end());
      tag.is_ambiguous = true;
    }
    tracker.Add(TimeOf(f), seen);
    const auto frame = tracker.Take();
    ASSERT_TRUE(frame);
    EXPECT_LT(Error_mm(*frame), 60.0) << f;
  }
}

TEST_F(TagTrackerTest, ATagThatIsElsewhereIsNotBelieved) {
  TagTracker tracker = Tracker();
  for (int f = 0; f < 20; ++f) {
    std::vector<TagSighting> seen = Seen(f);
    seen[1].detection.corners_px.array() += 80.0;
    tracker.Add(TimeOf(f), seen);
    const auto frame = tracker.Take();
    ASSERT_TRUE(frame);
    for (const TrackedTag& tag : frame->tags)
      EXPECT_EQ(tag.is_believed, tag.id != seen[1].detection.id) << f << " " << tag.id;
    EXPECT_LT(Error_mm(*frame), 60.0) << f;
  }
}

TEST_F(TagTrackerTest, WhoIsLostIsForetoldLessAndLessSurely) {
  TagTracker tracker = Tracker();
  for (int f = 0; f < 20; ++f) tracker.Add(TimeOf(f), Seen(f));
  while (tracker.Take()) {
  }
  double before = 0.0;
  int num_filled = 0, num_unknown = 0;
  for (int f = 20; f < 40; ++f) {
    tracker.Add(TimeOf(f), {});
    const auto frame = tracker.Take();
    ASSERT_TRUE(frame);
    if (frame->body.kind == Kind::kNotKnown) {
      ++num_unknown;
      continue;
    }
    EXPECT_EQ(frame->body.kind, Kind::kFilled);
    EXPECT_EQ(num_unknown, 0);
    const double deviation = frame->body.deviations.norm();
    EXPECT_GT(deviation, before);
    before = deviation;
    ++num_filled;
  }
  EXPECT_EQ(num_filled, 15);  // half a second
  tracker.Add(TimeOf(40), Seen(40));
  const auto back = tracker.Take();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->body.kind, Kind::kMeasured);
  EXPECT_LT(Error_mm(*back), 60.0);
}

TEST_F(TagTrackerTest, TagsAreExpectedWhereTheyComeToBe) {
  TagTracker tracker = Tracker();
  for (int f = 0; f < 20; ++f) tracker.Add(TimeOf(f), Seen(f));
  const std::vector<TagDetection> expected = tracker.Expected(TimeOf(20));
  int num_found = 0;
  for (const TagSighting& seen : Seen(20))
    for (const TagDetection& tag : expected) {
      if (tag.id != seen.detection.id) continue;
      ++num_found;
      EXPECT_LT((tag.corners_px - seen.detection.corners_px).colwise().norm().maxCoeff(), 8.0)
          << tag.id;
    }
  EXPECT_EQ(num_found, static_cast<int>(Seen(20).size()));
}

TEST_F(TagTrackerTest, TagsByJointsAreEnough) {
  for (BodyTag& tag : person_.worn.tags) {
    const Bone& bone =
        person_.skeleton.bones[static_cast<size_t>(*person_.skeleton.FindBone(tag.on_bone->bone))];
    if (tag.on_bone->bone == "root") continue;
    const auto joint = std::find_if(Joints().begin(), Joints().end(), [&](const JointInfo& info) {
      return info.cmu_bone == tag.on_bone->bone;
    });
    TagOnJoint on_joint{std::string(joint->name), tag.on_bone->bone_from_tag.inverse() * bone.tip_m,
                        0.005};
    tag.on_joint = on_joint;
  }
  BodyTags by_joints = person_.worn;
  for (BodyTag& tag : by_joints.tags)
    if (tag.on_joint) tag.on_bone.reset();
  TagTracker tracker(person_.skeleton, by_joints, person_.camera, kLevelFromCam, lifter_,
                     codebook_);
  double sum_mm = 0.0;
  for (int f = 0; f < 30; ++f) {
    tracker.Add(TimeOf(f), Seen(f));
    const auto frame = tracker.Take();
    ASSERT_TRUE(frame);
    sum_mm += Error_mm(*frame);
  }
  EXPECT_LT(sum_mm / 30, 60.0);
}

TEST_F(TagTrackerTest, StrangersTagsAndTooFewTagsGiveNoPose) {
  TagTracker tracker = Tracker();
  std::vector<TagSighting> seen = Seen(0);
  for (TagSighting& tag : seen) tag.detection.id += 100;
  tracker.Add(0.0, seen);
  EXPECT_EQ(tracker.Take()->body.kind, Kind::kNotKnown);
  seen = Seen(1);
  seen.resize(2);
  tracker.Add(TimeOf(1), seen);
  EXPECT_EQ(tracker.Take()->body.kind, Kind::kNotKnown);
}

TEST_F(TagTrackerTest, WhatIsWrongIsRefused) {
  EXPECT_THROW(Tracker({.corner_sigma_px = 0.0}), InputError);
  EXPECT_THROW(Tracker({.least_tags = 0}), InputError);
  TagTracker tracker = Tracker();
  tracker.Add(1.0, Seen(0));
  EXPECT_THROW(tracker.Add(1.0, Seen(0)), InputError);
  person_.worn.tags[0].on_bone->bone = "tail";
  EXPECT_THROW(Tracker(), InputError);
}

TEST_F(TagTrackerTest, PosesAreBeforeTheCameraAsPosesJsonHasThem) {
  TagTracker tracker = Tracker();
  TrackedPerson converter(person_.skeleton, person_.camera, kLevelFromCam);
  tracker.Add(0.0, Seen(0));
  const PersonPose person = converter.Convert(*tracker.Take());
  EXPECT_EQ(person.status, "ok");
  EXPECT_GE(person.tags.size(), 10U);
  for (const PoseTag& tag : person.tags) EXPECT_TRUE(tag.believed && tag.error_px < 1.0) << tag.id;
  EXPECT_LT((person.pelvis_in_cam_m - kLevelFromCam * person_.PoseAt(0.0).root_in_world_m).norm(),
            0.03);
  EXPECT_LT(person.joints_in_cam_m.col(joint::kPelvis).norm(), 1e-12);
  EXPECT_GT(person.joints_in_cam_m(1, joint::kLeftAnkle), 0.5);  // y is down
  ASSERT_EQ(person.angles_deg.size(), person.angles_sigma_deg.size());
  const JointAngleReader reader(person_.skeleton);
  const Eigen::VectorXd true_deg = reader.ReadDeg(person_.PoseAt(0.0));
  for (size_t a = 0; a < person.angles_deg.size(); ++a) {
    const auto& [name, value] = person.angles_deg[a];
    if (name.ends_with("knee.flexion") || name.ends_with("elbow.flexion")) {
      EXPECT_NEAR(value, true_deg[static_cast<Eigen::Index>(a)], 6.0) << name;
    }
    EXPECT_GT(person.angles_sigma_deg[a].second, 0.0) << name;
  }
}

// However unsure the angles are: no circle is wider, no arm longer.
TEST_F(TagTrackerTest, NoJointIsUnsureBeyondItsReach) {
  TagTracker tracker = Tracker();
  TrackedPerson converter(person_.skeleton, person_.camera, kLevelFromCam);
  tracker.Add(0.0, Seen(0));
  TrackedFrame frame = *tracker.Take();
  frame.covariance *= 1e6;
  const PersonPose person = converter.Convert(frame);
  for (const auto& [name, sigma_deg] : person.angles_sigma_deg)
    EXPECT_LE(sigma_deg, 180.0 / std::sqrt(3.0) + 1e-9) << name;
  double reach_m2 = 0.0;
  for (int j = joint::kLeftHand; j != joint::kPelvis; j = Joints()[static_cast<size_t>(j)].parent)
    reach_m2 += 2.0 * (person.joints_in_cam_m.col(j) -
                       person.joints_in_cam_m.col(Joints()[static_cast<size_t>(j)].parent))
                          .squaredNorm();
  EXPECT_LE(person.joints_sigma_m[joint::kLeftHand], std::sqrt(reach_m2) + 1e-9);
  EXPECT_GT(person.joints_sigma_m[joint::kLeftHand], 0.5);
}

TEST_F(TagTrackerTest, AJointThatNoTagShowsIsUnsure) {
  TagTracker tracker = Tracker();
  TrackedPerson converter(person_.skeleton, person_.camera, kLevelFromCam);
  const auto sigma_m = [&](int frame, const std::vector<TagSighting>& seen) {
    tracker.Add(TimeOf(frame), seen);
    return converter.Convert(*tracker.Take()).joints_sigma_m;
  };
  const Eigen::VectorXd whole = sigma_m(0, Seen(0));
  ASSERT_EQ(whole.size(), kNumJoints);
  EXPECT_EQ(whole[joint::kPelvis], 0.0);  // the others are relative to it
  EXPECT_GT(whole.tail(kNumJoints - 1).minCoeff(), 0.0);
  Eigen::VectorXd without_arm;
  for (int t = 1; t < 15; ++t) {
    std::vector<TagSighting> seen = Seen(t);
    std::erase_if(seen, [&](const TagSighting& tag) {
      const std::string& bone = person_.worn.Find(tag.detection.id)->on_bone->bone;
      return bone == "lhumerus" || bone == "lradius" || bone == "lwrist" || bone == "lhand";
    });
    without_arm = sigma_m(t, seen);
  }
  EXPECT_GT(without_arm[joint::kLeftWrist], 3.0 * whole[joint::kLeftWrist]);
  EXPECT_LT(without_arm[joint::kRightWrist], 2.0 * whole[joint::kRightWrist]);
}

}  // namespace
}  // namespace poselift
