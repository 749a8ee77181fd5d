// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: libapriltag's families. Checked: sizes that are published, ids and names that
// are refused.
#include "calib/tag_family.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "src/input_error.h"

namespace poselift {
namespace {

TEST(TagFamilyTest, A36h11TagIsTenCellsWideAndEightInsideItsWhiteBorder) {
  const TagFamily family("tag36h11");
  EXPECT_EQ(family.num_ids(), 587);
  EXPECT_EQ(family.cells(), 10);
  EXPECT_EQ(family.cells_of_size(), 8);
  const cv::Mat image = family.Image(0);
  ASSERT_EQ(image.size(), cv::Size(10, 10));
  EXPECT_EQ(image.at<uchar>(0, 0), 255);
  EXPECT_EQ(image.at<uchar>(1, 1), 0);
}

TEST(TagFamilyTest, EveryNameHasItsFamilyAndEveryIdOfItIsDifferent) {
  for (const std::string& name : TagFamily::Names()) {
    if (name == "tagCircle49h12" || name == "tagCustom48h12") continue;  // tens of thousands
    const TagFamily family(name);
    EXPECT_GT(family.num_ids(), 20) << name;
    const cv::Mat first = family.Image(0);
    EXPECT_EQ(first.size(), cv::Size(family.cells(), family.cells())) << name;
    for (const int id : {1, 2, family.num_ids() - 1})
      EXPECT_GT(cv::norm(first, family.Image(id)), 0.0) << name << " " << id;
  }
}

TEST(TagFamilyTest, UnknownNamesAndIdsAreRefused) {
  EXPECT_THROW(TagFamily("tag36h12"), InputError);
  const TagFamily family("tag16h5");
  EXPECT_THROW(family.Image(-1), InputError);
  EXPECT_THROW(family.Image(30), InputError);
}

}  // namespace
}  // namespace poselift
