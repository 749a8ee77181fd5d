// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk whose contacts are known, at any floor height, size and frame
// rate; and captured walking, running and jumping, of which is known what legs do.
#include "lift/temporal/foot_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lift/frame_span.h"
#include "lift/temporal/resample.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::PlantedWalk;
using testing::PlantWalk;

// As many contacts, and each end within a few frames: a foot that leaves is slow
// at first.
void ExpectContacts(const std::vector<bool>& found, const std::vector<bool>& planted, int frames) {
  const std::vector<FrameSpan> a = SpansOf(found);
  const std::vector<FrameSpan> b = SpansOf(planted);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE(std::abs(a[i].first - b[i].first), frames) << i;
    EXPECT_LE(std::abs(a[i].last - b[i].last), frames) << i;
  }
}

TEST(FootContact, FindsThePlantedStancesWhateverTheFloorsHeight) {
  for (const double floor_m : {0.0, -3.0, 12.5}) {
    const PlantedWalk walk = PlantWalk(200, 0.6, floor_m);
    const FootContacts contacts = FindFootContacts(walk.motion);
    ExpectContacts(contacts.Left(), walk.left, 5);
    ExpectContacts(contacts.Right(), walk.right, 5);
    EXPECT_NEAR(contacts.floors[0][0], floor_m + 0.08, 0.01);
    EXPECT_NEAR(contacts.floors[1][0], floor_m + 0.03, 0.01);
  }
}

TEST(FootContact, FindsThemOnATiltedFloor) {
  PlantedWalk walk = PlantWalk(200, 0.6, 0.0);
  for (SkeletonPose& pose : walk.motion.frames)
    pose.root_in_world_m.y() += 0.015 * pose.root_in_world_m.z();
  const FootContacts contacts = FindFootContacts(walk.motion);
  ExpectContacts(contacts.Left(), walk.left, 5);
  ExpectContacts(contacts.Right(), walk.right, 5);
}

TEST(FootContact, ScalesWithTheBody) {
  PlantedWalk walk = PlantWalk(150, 0.6, 0.0);
  const FootContacts whole = FindFootContacts(walk.motion);
  // A child half as tall, walking sqrt(2) times as fast: the same Froude number.
  for (Bone& bone : walk.motion.skeleton.bones) {
    bone.offset_m *= 0.5;
    bone.tip_m *= 0.5;
  }
  for (SkeletonPose& pose : walk.motion.frames) pose.root_in_world_m *= 0.5;
  walk.motion.frame_time_s *= std::sqrt(0.5);
  FootContactOptions options;
  options.speed_window_s *= std::sqrt(0.5);
  options.min_contact_s *= std::sqrt(0.5);
  const FootContacts half = FindFootContacts(walk.motion, options);
  EXPECT_EQ(half.joints, whole.joints);
  EXPECT_NEAR(half.leg_length_m, 0.5 * whole.leg_length_m, 1e-12);
}

TEST(FootContact, TheFrameRateHardlyMatters) {
  const PlantedWalk walk = PlantWalk(180, 0.6, 0.0);
  const Motion slower = Resample(walk.motion, 1.0 / 30.0);
  std::vector<bool> planted;
  for (size_t t = 0; t < walk.left.size(); t += 2) planted.push_back(walk.left[t]);
  ExpectContacts(FindFootContacts(slower).Left(), planted, 3);
}

TEST(FootContact, NeitherABodyInTheAirNorAnUnknownFrameStands) {
  PlantedWalk walk = PlantWalk(150, 0.6, 0.0);
  for (int t = 60; t < 90; ++t) walk.motion.frames[t].root_in_world_m.y() += 0.3;
  for (int t = 100; t < 104; ++t) walk.motion.frames[t] = UnknownPose(walk.motion.skeleton);
  const FootContacts contacts = FindFootContacts(walk.motion);
  for (int t = 0; t < 150; ++t) {
    const bool aloft_or_unknown = (t >= 60 && t < 90) || (t >= 100 && t < 104);
    const bool stands = contacts.Left()[t] || contacts.Right()[t];
    EXPECT_FALSE(aloft_or_unknown && stands) << t;
  }
  EXPECT_TRUE(contacts.Left()[20]);
}

TEST(FootContact, SlideIsTheDistanceFromTheMeanPlace) {
  Motion motion{testing::TrimmedCmuLikeSkeleton(), 1.0 / 60.0, {}};
  motion.frames.assign(10, SkeletonPose::Rest(motion.skeleton));
  for (int t = 0; t < 10; ++t) motion.frames[t].root_in_world_m.x() = t % 2 == 0 ? 0.01 : -0.01;
  FootContacts contacts;
  for (auto& joint : contacts.joints) joint.assign(10, false);
  EXPECT_EQ(FootSlide_mm(motion, contacts), -1.0);
  contacts.joints[2].assign(10, true);
  EXPECT_NEAR(FootSlide_mm(motion, contacts), 10.0, 1e-9);
}

// Two contacts a stride; walkers stand on a foot for about six tenths of it,
// runners for less than half.
TEST(FootContact, CapturedWalkingAndRunningHaveTheirStances) {
  POSELIFT_DATA_OR_SKIP(data);
  const auto stance = [&](const std::string& asf, const std::string& amc) {
    const Motion motion =
        ReadAmc(data / "mocap/cmu" / amc, ReadAsfSkeleton(data / "mocap/cmu" / asf));
    const std::vector<bool> left = FindFootContacts(motion).Left();
    const std::vector<FrameSpan> spans = SpansOf(left);
    EXPECT_GE(spans.size(), 2u) << amc;
    // From one strike to the next.
    const int frames = spans.back().first - spans.front().first;
    return static_cast<double>(std::count(left.begin() + spans.front().first,
                                          left.begin() + spans.back().first, true)) /
           frames;
  };
  const double walking = stance("07/07.asf", "07/07_05.amc");
  EXPECT_GT(walking, 0.52);
  EXPECT_LT(walking, 0.72);
  const double running = stance("09/09.asf", "09/09_05.amc");
  EXPECT_GT(running, 0.15);
  EXPECT_LT(running, 0.45);
}

TEST(FootContact, BadOptionsAndLeglessSkeletonsAreRefused) {
  const PlantedWalk walk = PlantWalk(5, 0.6, 0.0);
  EXPECT_THROW(FindFootContacts(walk.motion, {.ankle = {0.0, 0.1, 0.3, 0.4}}), InputError);
  EXPECT_THROW(FindFootContacts(walk.motion, {.ankle = {0.1, 0.05, 0.3, 0.4}}), InputError);
  EXPECT_THROW(FindFootContacts(walk.motion, {.ball = {0.1, 0.1, 0.3, 0.1}}), InputError);
  EXPECT_THROW(FindFootContacts(walk.motion, {.speed_window_s = 0.0}), InputError);
  Motion legless = walk.motion;
  for (Bone& bone : legless.skeleton.bones)
    if (bone.name == "lfoot") bone.name = "stump";
  EXPECT_THROW(FindFootContacts(legless), InputError);
}

}  // namespace
}  // namespace poselift
