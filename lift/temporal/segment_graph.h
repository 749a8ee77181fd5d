// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <vector>

#include "lift/temporal/segment_points.h"

namespace poselift {

// What a series of searches carries along: where the last one ended, and storage.
struct GraphWalk {
  std::vector<Candidate> found;  // of the last search, nearest first; empty: a new series
  int num_visited = 0;           // points whose distance the last search took

  // Storage of SegmentGraph.
  std::vector<Candidate> last, frontier;
  std::vector<std::uint32_t> seen;  // by point: the round of the last visit
  std::uint32_t round = 0;
  int next_landmark = 0;
};

// The neighbour graph of J. Chai, J. K. Hodgins, Performance Animation from
// Low-dimensional Control Signals, 2005 (section 5.1): motion is smooth, so what
// is near to the pose of now is linked to what was near to the one before.
//
// A search begins at the last answers and at the segments that follow them in
// their trials, and goes on from the nearest point whose links it has not
// followed, until that is farther than the `width` nearest found. A new series
// begins at landmarks, every 32nd segment (half a second at 60 Hz); each search
// looks at a part of them besides, so that a series which lost its way finds
// back.
//
// The links are those of the lowest layer of an HnswIndex: of the points near to a
// point each that is nearer to it than to any taken before, so that they lead to
// other trials too and not only along its own.
class SegmentGraph {
 public:
  // max_links, build_width: as HnswIndex has them. `points` outlives the graph.
  SegmentGraph(const SegmentPoints& points, int max_links, int build_width);

  // walk->found: up to `width` points, nearest first.
  void Search(const float* query, int width, GraphWalk* walk) const;

 private:
  void Start(const float* query, int width, GraphWalk* walk) const;
  void Visit(const float* query, int width, int point, GraphWalk* walk) const;

  const SegmentPoints& points_;
  std::vector<std::vector<int>> links_;  // by point
};

}  // namespace poselift
