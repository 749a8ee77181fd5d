// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: all layouts. Checked: their lines join the body to one piece.
#include "ui/label/layout_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "src/joints.h"

namespace poselift {
namespace {

TEST(LayoutEdges, JoinTheLandmarksThatAreJointsToOnePiece) {
  for (const Layout& layout : AllLayouts()) {
    std::vector<int> piece(layout.landmarks.size());
    std::iota(piece.begin(), piece.end(), 0);
    for (const auto& [a, b] : LayoutEdges(layout)) {
      ASSERT_NE(a, b) << layout.name;
      const int from = piece[static_cast<size_t>(a)], to = piece[static_cast<size_t>(b)];
      std::replace(piece.begin(), piece.end(), from, to);
    }
    std::set<int> pieces;
    for (size_t l = 0; l < piece.size(); ++l)
      if (FindJoint(layout.landmarks[l].name) || layout.landmarks[l].name == "mid_hip")
        pieces.insert(piece[l]);
    EXPECT_EQ(pieces.size(), 1U) << layout.name;
  }
}

TEST(LayoutEdges, AForearmGoesFromElbowToWrist) {
  const Layout* layout = FindLayout("body15");
  const auto edges = LayoutEdges(*layout);
  const std::pair<int, int> forearm{*layout->Find("left_elbow"), *layout->Find("left_wrist")};
  EXPECT_EQ(std::count(edges.begin(), edges.end(), forearm), 1);
  EXPECT_EQ(edges.size(), 14U);
}

}  // namespace
}  // namespace poselift
