// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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
// Links of a point: of its nearest points each that is nearer to it than to any
// link chosen before, so that they lead to other trials too and not only along
// its own (Malkov and Yashunin 2016, algorithm 4). Points are added one by one in
// order of time, their nearest found by the same search.
class SegmentGraph {
 public:
  // At most max_links links a point and direction; build_width: the width of the
  // searches that find them. `points` outlives the graph. Deterministic.
  SegmentGraph(const SegmentPoints& points, int max_links, int build_width);

  // walk->found: up to `width` points, nearest first.
  void Search(const float* query, int width, GraphWalk* walk) const;

 private:
  void Start(const float* query, int width, GraphWalk* walk) const;
  void Visit(const float* query, int width, int point, GraphWalk* walk) const;
  void Add(int point, GraphWalk* walk);
  void Link(int from, Candidate to);
  // Keeps what leads somewhere new, at most `most`, of candidates sorted by distance.
  void Thin(size_t most, std::vector<Candidate>* candidates) const;

  std::span<const int> Links(int point) const {
    return {links_.data() + static_cast<size_t>(point) * most_links_,
            static_cast<size_t>(num_links_[point])};
  }
  void SetLinks(int point, const std::vector<Candidate>& links);

  const SegmentPoints& points_;
  size_t most_links_;  // both directions
  int num_points_ = 0;
  std::vector<int> links_;  // most_links_ places a point
  std::vector<int> num_links_;
  std::vector<Candidate> thinned_, crowded_;  // storage of Add and Link
};

}  // namespace poselift
