// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: a neck that goes right by a pixel a frame.
#include "ui/label/trail.h"

#include <gtest/gtest.h>

namespace poselift {
namespace {

constexpr int kPerson = 2;

Labels Video(int count, const std::string& image = "walk.mp4") {
  Labels labels{.layout = "body15", .frames = {}};
  for (int f = 0; f < count; ++f) {
    FrameLabels& frame = labels.frames.emplace_back();
    frame.image = image;
    frame.frame = f;
    frame.people = {{.id = kPerson, .landmarks = {{.name = "neck", .x_px = {f, 0.0}}}}};
  }
  return labels;
}

std::vector<int> FramesAway(const std::vector<TrailPoint>& trail) {
  std::vector<int> frames;
  for (const TrailPoint& point : trail) frames.push_back(point.away);
  return frames;
}

TEST(TrailOf, IsWhereTheLandmarkIsInTheFramesAround) {
  const std::vector<TrailPoint> trail = TrailOf(Video(100), {50, kPerson}, "neck");
  ASSERT_EQ(trail.size(), 2U * TrailPoint::kMostAway + 1);
  for (const TrailPoint& point : trail)
    EXPECT_EQ(point.x_px, Eigen::Vector2d(50 + point.away, 0.0));
  EXPECT_TRUE(TrailOf(Video(100), {50, kPerson}, "pelvis").empty());
  EXPECT_TRUE(TrailOf(Video(100), {50, kPerson + 1}, "neck").empty());
}

TEST(TrailOf, LeavesOutWhereItIsAbsent) {
  Labels labels = Video(6);
  labels.frames[1].people.clear();
  labels.frames[4].people[0].landmarks[0].state = LabelState::kAbsent;
  labels.frames[5].people[0].landmarks[0].state = LabelState::kOccluded;
  EXPECT_EQ(FramesAway(TrailOf(labels, {2, kPerson}, "neck")), (std::vector{-2, 0, 1, 3}));
}

TEST(TrailOf, EndsWhereTheVideoDoes) {
  Labels labels = Video(3);
  for (FrameLabels& frame : Video(4, "run.mp4").frames) labels.frames.push_back(frame);
  EXPECT_EQ(FramesAway(TrailOf(labels, {1, kPerson}, "neck")), (std::vector{-1, 0, 1}));
  EXPECT_EQ(FramesAway(TrailOf(labels, {3, kPerson}, "neck")), (std::vector{0, 1, 2, 3}));
}

TEST(TrailOf, PicturesOfTheirOwnHaveNone) {
  Labels labels = Video(5);
  for (FrameLabels& frame : labels.frames) frame.frame.reset();
  EXPECT_TRUE(TrailOf(labels, {2, kPerson}, "neck").empty());
  for (FrameLabels& frame : labels.frames) frame.time_s = 0.0;
  EXPECT_EQ(TrailOf(labels, {2, kPerson}, "neck").size(), 5U);
}

}  // namespace
}  // namespace poselift
