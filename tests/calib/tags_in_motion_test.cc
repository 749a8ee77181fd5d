// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The real detector on rendered pictures of people who walk with tags on, from made-up
// motion and, where it is there, from motion capture.
#include <gtest/gtest.h>

#include "calib/tag_detector.h"
#include "src/io/motion_file.h"
#include "src/testing/body_renderer.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "tests/support/detection_tally.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::DetectionTally;

struct View {
  double distance_m = 2.5;
  double size_m = 0.08;
  double exposure_s = 0.0;
};

// Five pictures a second.
DetectionTally Tally(const Motion& motion, const View& view) {
  const TagFamily family("tag36h11");
  const Motion spot = testing::OnTheSpot(motion);
  const testing::PlacedCamera placed = testing::CameraBefore(spot, view.distance_m);
  const BodyTags tags = testing::DefaultTagPlacement(spot.skeleton, {.size_m = view.size_m});
  const auto print_of = [&](int id) -> testing::TagPrint {
    return {family.Image(id), family.cells_of_size()};
  };
  const testing::BodyRenderer renderer(
      spot.skeleton, tags, print_of, placed.camera, placed.cam_from_world,
      {.exposure_s = view.exposure_s, .noise_grey_levels = 2.0, .seed = 3});
  TagDetector detector(family);
  DetectionTally tally;
  const double length_s = spot.frame_time_s * static_cast<double>(spot.frames.size() - 1);
  for (double time_s = 0.1; time_s < length_s; time_s += 0.2) {
    const testing::RenderedFrame frame = renderer.Render(testing::PosesOver(spot), time_s);
    tally.Add(frame.truth, detector.Detect(frame.picture));
  }
  return tally;
}

TEST(TagsInMotionTest, WholeTagsOfAMadeUpWalkAreFound) {
  const DetectionTally tally = Tally(testing::PlantWalk(121, 0.6, 0.0).motion, {});
  EXPECT_GT(tally.visible, 60);
  EXPECT_GT(tally.Share(), 0.95);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_LT(tally.CornerRms_px(), 0.15);
}

TEST(TagsInMotionTest, WholeTagsOfMadeUpGaitsAreFound) {
  const DetectionTally tally = Tally(testing::MadeUpGaits().Gait(121, 0.5), {});
  EXPECT_GT(tally.visible, 40);
  EXPECT_GT(tally.Share(), 0.9);
  EXPECT_EQ(tally.wrong, 0);
}

TEST(TagsInMotionTest, ALongExposureLosesTagsAndAShortOneDoesNot) {
  const Motion walk = testing::PlantWalk(61, 0.6, 0.0).motion;
  const double still = Tally(walk, {}).Share();
  EXPECT_GT(Tally(walk, {.exposure_s = 1.0 / 500}).Share(), still - 0.05);
  EXPECT_LT(Tally(walk, {.exposure_s = 1.0 / 15}).Share(), still - 0.15);
}

TEST(TagsInMotionTest, TagsOfCapturedWalkingAreFound) {
  POSELIFT_DATA_OR_SKIP(data);
  Motion walk = ReadMotion(data / "mocap/cmu/16/16_15.amc");
  walk.frames.erase(walk.frames.begin(), walk.frames.begin() + 60);
  const DetectionTally tally = Tally(walk, {.exposure_s = 1.0 / 250});
  EXPECT_GT(tally.visible, 60);
  EXPECT_GT(tally.Share(), 0.9);
  EXPECT_EQ(tally.wrong, 0);
}

}  // namespace
}  // namespace poselift
