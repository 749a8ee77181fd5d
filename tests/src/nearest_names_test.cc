// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/nearest_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace poselift {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(NearestNames, AreRankedByLettersThatDiffer) {
  const std::vector<std::string> names = {"right_knee", "left_hip", "left_knee", "head"};
  EXPECT_THAT(NearestNames("left_kne", names, 2), ElementsAre("left_knee", "left_hip"));
  EXPECT_THAT(NearestNames("rigth_knee", names, 1), ElementsAre("right_knee"));
  EXPECT_EQ(NearestNames("x", names, 9).size(), 4u);
  EXPECT_THAT(NearestNames("x", {}, 3), IsEmpty());
  EXPECT_EQ(NearestNames(std::string(1000000, 'x'), names, 1).size(), 1u);
}

}  // namespace
}  // namespace poselift
