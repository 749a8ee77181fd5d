// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: twelve tags that move before clutter and go behind a board for a while, with noise.
// Checked: regions find what full frames at full resolution find, at the same places, and are
// what most frames are looked at through.
#include "calib/tag_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "src/input_error.h"
#include "tests/support/rendered_tags.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr int kNumFrames = 24;

cv::Mat Frame(int t, const cv::Mat& room, const TagFamily& family, std::mt19937_64* rng) {
  cv::Mat grey = room.clone();
  std::vector<testing::PlacedTag> tags;
  for (int id = 0; id < 12; ++id) {
    const double phase = 0.25 * t + id;
    const Eigen::Vector2d centre_px(90.0 + 95.0 * (id % 6) + 25.0 * std::cos(phase),
                                    110.0 + 210.0 * (id / 6) + 40.0 * std::sin(phase));
    tags.push_back({id, testing::PxFromTag(centre_px, 26.0 + 2.0 * id, 0.05 * t + id)});
  }
  testing::DrawTags(family, tags, &grey, 210.0, 40.0, 24);
  // A board that hides two of them for some frames.
  if (t >= 8 && t < 14) grey(cv::Rect(40, 40, 200, 150)).setTo(90);
  testing::AddNoise(3.0, rng, &grey);
  return grey;
}

TEST(TagSearchTest, RegionsFindWhatFullFramesFindAtTheSamePlaces) {
  std::mt19937_64 rng = testing::TestRng();
  const TagFamily family("tag36h11");
  const cv::Mat room = testing::Clutter({640, 480}, &rng);
  TagDetector full(family);
  TagSearch search(family), rare(family, {.glance_every = 8});
  int num_whole = 0, num_tags = 0, num_lost = 0, num_lost_by_rare = 0;
  for (int t = 0; t < kNumFrames; ++t) {
    const cv::Mat grey = Frame(t, room, family, &rng);
    const std::vector<TagDetection> all = full.Detect(grey), found = search.Detect(grey);
    num_whole += search.last_look() != TagSearch::Look::kRegions ? 1 : 0;
    num_tags += static_cast<int>(all.size());
    num_lost_by_rare += static_cast<int>(all.size() - rare.Detect(grey).size());
    for (const TagDetection& tag : all) {
      const auto same = std::find_if(found.begin(), found.end(),
                                     [&](const TagDetection& other) { return other.id == tag.id; });
      num_lost += same == found.end() ? 1 : 0;
      if (same == found.end()) continue;
      // A tag's corners are those of the same pixels, whatever is around.
      EXPECT_TRUE(testing::MatrixNear(same->corners_px, tag.corners_px, 0.1)) << t << " " << tag.id;
    }
    std::set<int> ids;
    for (const TagDetection& tag : found) EXPECT_TRUE(ids.insert(tag.id).second);
  }
  EXPECT_GT(num_tags, 11 * kNumFrames);
  EXPECT_LT(num_whole, kNumFrames / 2 + 1);
  // What comes from behind the board waits for the next glance, and for nothing else.
  EXPECT_LE(num_lost, 2 * 3);
  EXPECT_LE(num_lost_by_rare, 2 * 8);
  RecordProperty("whole frames", num_whole);
  RecordProperty("found later", num_lost);
}

TEST(TagSearchTest, PredictedTagsAreFoundWhereTheyWereNeverSeen) {
  const TagFamily family("tag36h11");
  TagSearch search(family, {.glance_every = 1000, .full_every = 1000});
  cv::Mat first(480, 640, CV_8U, cv::Scalar(110)), second = first.clone();
  const testing::PlacedTag stays{1, testing::PxFromTag({100, 100}, 50.0, 0.1)},
      comes{2, testing::PxFromTag({500, 400}, 50.0, 0.4)};
  testing::DrawTags(family, {stays}, &first);
  testing::DrawTags(family, {stays, comes}, &second);
  using Look = TagSearch::Look;
  EXPECT_EQ(search.Detect(first).size(), 1U);
  EXPECT_EQ(search.last_look(), Look::kFull);
  EXPECT_EQ(search.Detect(second).size(), 1U);
  EXPECT_EQ(search.last_look(), Look::kRegions);
  EXPECT_EQ(search.Detect(second, {{2, comes.Corners()}}).size(), 2U);
  EXPECT_EQ(search.last_look(), Look::kRegions);
  // A lost one brings one glance, not one after the other.
  EXPECT_EQ(search.Detect(first).size(), 1U);
  EXPECT_EQ(search.last_look(), Look::kGlance);
  EXPECT_EQ(search.Detect(first).size(), 1U);
  EXPECT_EQ(search.last_look(), Look::kRegions);
}

// Tags of all sizes and at all heights: across strips, on their rims, larger than they overlap.
TEST(TagSearchTest, StripsOfThreadsShowWhatOneThreadDoes) {
  std::mt19937_64 rng = testing::TestRng();
  const TagFamily family("tag36h11");
  for (int round = 0; round < 6; ++round) {
    cv::Mat grey = testing::Clutter({1280, 720}, &rng);
    std::vector<testing::PlacedTag> tags;
    for (int id = 0; id < 8; ++id)
      tags.push_back({id, testing::PxFromTag({80.0 + 130.0 * id, 150.0 + 60.0 * (id + round) / 1.4},
                                             22.0 + 8.0 * id, 0.1 * round)});
    tags.push_back({8, testing::PxFromTag({1080.0, 300.0 + 20.0 * round}, 190.0, 0.02)});
    testing::DrawTags(family, tags, &grey, 210.0, 40.0, 24);
    testing::AddNoise(2.0, &rng, &grey);
    const std::vector<TagDetection> one = TagSearch(family).Detect(grey);
    EXPECT_EQ(one.size(), 9U) << round;
    for (const int threads : {2, 3}) {
      const std::vector<TagDetection> found = TagSearch(family, {.threads = threads}).Detect(grey);
      ASSERT_EQ(found.size(), one.size()) << round << " " << threads;
      for (size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].id, one[i].id);
        EXPECT_TRUE(testing::MatrixNear(found[i].corners_px, one[i].corners_px, 0.05)) << round;
      }
    }
  }
}

TEST(TagSearchTest, WholeFramesShowWhatComes) {
  const TagFamily family("tag36h11");
  TagSearch search(family, {.glance_every = 3, .full_every = 9});
  cv::Mat none(480, 640, CV_8U, cv::Scalar(110)), two = none.clone();
  testing::DrawTags(family,
                    {{1, testing::PxFromTag({100, 100}, 50.0, 0.1)},
                     {2, testing::PxFromTag({500, 400}, 14.0, 0.4)}},
                    &two);  // the second is too small for a glance
  EXPECT_TRUE(search.Detect(none).empty());
  std::vector<size_t> num_found;
  for (int t = 1; t <= 10; ++t) num_found.push_back(search.Detect(two).size());
  EXPECT_EQ(num_found, (std::vector<size_t>{0, 0, 1, 1, 1, 1, 1, 1, 2, 2}));
}

TEST(TagSearchTest, PredictionsOutsideThePictureAndNoNumbersDoNoHarm) {
  TagSearch search(TagFamily("tag36h11"), {});
  cv::Mat grey(480, 640, CV_8U, cv::Scalar(110));
  testing::DrawTags(TagFamily("tag36h11"), {{1, testing::PxFromTag({100, 100}, 50.0, 0.1)}}, &grey);
  TagSearch::Corners far_px = TagSearch::Corners::Constant(-1e30), none_px;
  none_px.setConstant(std::nan(""));
  for (int t = 0; t < 3; ++t)
    EXPECT_EQ(search.Detect(grey, {{5, far_px}, {6, none_px}}).size(), 1U);
  EXPECT_TRUE(search.Detect(cv::Mat()).empty());
  EXPECT_THROW(TagSearch(TagFamily("tag36h11"), {.full_every = 0}), InputError);
  EXPECT_THROW(TagSearch(TagFamily("tag36h11"), {.glance_every = 0}), InputError);
  EXPECT_THROW(TagSearch(TagFamily("tag36h11"), {.threads = 0}), InputError);
}

}  // namespace
}  // namespace poselift
