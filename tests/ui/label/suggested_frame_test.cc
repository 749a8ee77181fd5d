// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: labels of frames, and how sure a motion is of them.
#include "ui/label/suggested_frame.h"

#include <gtest/gtest.h>

#include <limits>

namespace poselift {
namespace {

constexpr int kPerson = 3;

Labels LabelledAt(size_t count, const std::vector<size_t>& frames) {
  Labels labels{.layout = "body15", .frames = std::vector<FrameLabels>(count)};
  for (const size_t f : frames)
    labels.frames[f].people = {{.id = kPerson, .landmarks = {{.name = "neck"}}}};
  return labels;
}

PersonMotion MotionWithSigmas_deg(const std::vector<double>& sigmas_deg) {
  PersonMotion motion{.person_id = kPerson};
  motion.angles_sigma_deg =
      Eigen::Map<const Eigen::RowVectorXd>(sigmas_deg.data(), std::ssize(sigmas_deg));
  return motion;
}

TEST(SuggestedFrame, IsTheFarthestFromAnyWithLabels) {
  EXPECT_EQ(SuggestedFrame(LabelledAt(9, {}), kPerson, nullptr), 0U);
  EXPECT_EQ(SuggestedFrame(LabelledAt(9, {0}), kPerson, nullptr), 8U);
  EXPECT_EQ(SuggestedFrame(LabelledAt(9, {0, 8}), kPerson, nullptr), 4U);
  EXPECT_EQ(SuggestedFrame(LabelledAt(9, {0, 4, 8}), kPerson + 1, nullptr), 0U);
  EXPECT_EQ(SuggestedFrame(LabelledAt(2, {0, 1}), kPerson, nullptr), std::nullopt);
  EXPECT_EQ(SuggestedFrame(LabelledAt(0, {}), kPerson, nullptr), std::nullopt);
}

TEST(SuggestedFrame, WhatWasPropagatedIsNotLabelled) {
  Labels labels = LabelledAt(3, {0, 1, 2});
  labels.frames[1].people[0].is_propagated = true;
  EXPECT_EQ(SuggestedFrame(labels, kPerson, nullptr), 1U);
}

TEST(SuggestedFrame, IsWhereTheMotionOfThePersonIsLeastSure) {
  const Labels labels = LabelledAt(5, {0, 4});
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  PersonMotion motion = MotionWithSigmas_deg({20.0, 4.0, 3.0, kUnknown, 20.0});
  EXPECT_EQ(SuggestedFrame(labels, kPerson, &motion), 1U);
  motion.person_id = kPerson + 1;
  EXPECT_EQ(SuggestedFrame(labels, kPerson, &motion), 2U);
}

}  // namespace
}  // namespace poselift
