// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/segment_graph.h"

#include <algorithm>
#include <functional>

#include "lift/temporal/hnsw_index.h"

namespace poselift {
namespace {

constexpr int kLandmarkStride = 32;
constexpr int kLandmarkShares = 32;  // searches until all landmarks were looked at
constexpr size_t kNumStarts = 32;    // of the last answers

}  // namespace

SegmentGraph::SegmentGraph(const SegmentPoints& points, int max_links, int build_width)
    : points_(points), links_(HnswIndex(points, max_links, build_width).Links()) {}

void SegmentGraph::Search(const float* query, int width, GraphWalk* walk) const {
  Start(query, width, walk);
  const std::greater<> nearest_on_top;
  while (!walk->frontier.empty()) {
    const auto [squared_distance, point] = walk->frontier.front();
    if (walk->found.size() == static_cast<size_t>(width) &&
        squared_distance > walk->found.front().first)
      break;
    std::pop_heap(walk->frontier.begin(), walk->frontier.end(), nearest_on_top);
    walk->frontier.pop_back();
    for (const int next : links_[point]) Visit(query, width, next, walk);
  }
  std::sort_heap(walk->found.begin(), walk->found.end());
}

void SegmentGraph::Start(const float* query, int width, GraphWalk* walk) const {
  walk->seen.resize(static_cast<size_t>(points_.size()));
  if (++walk->round == 0) {
    std::fill(walk->seen.begin(), walk->seen.end(), 0);
    walk->round = 1;
  }
  walk->num_visited = 0;
  walk->last.swap(walk->found);
  walk->found.clear();
  walk->frontier.clear();
  const size_t num_starts = std::min(walk->last.size(), kNumStarts);
  for (size_t i = 0; i < num_starts; ++i) {
    const int point = walk->last[i].second;
    Visit(query, width, point, walk);
    if (const int next = points_.Next(point); next >= 0) Visit(query, width, next, walk);
  }
  const int num_landmarks = (points_.size() + kLandmarkStride - 1) / kLandmarkStride;
  const int share =
      walk->last.empty() ? num_landmarks : (num_landmarks + kLandmarkShares - 1) / kLandmarkShares;
  for (int i = 0; i < share; ++i) {
    if (walk->next_landmark >= num_landmarks) walk->next_landmark = 0;
    Visit(query, width, kLandmarkStride * walk->next_landmark++, walk);
  }
}

void SegmentGraph::Visit(const float* query, int width, int point, GraphWalk* walk) const {
  if (walk->seen[point] == walk->round) return;
  walk->seen[point] = walk->round;
  ++walk->num_visited;
  const Candidate candidate(points_.SquaredDistance(query, point), point);
  std::vector<Candidate>& found = walk->found;  // the farthest on top
  if (found.size() == static_cast<size_t>(width)) {
    if (candidate >= found.front()) return;
    std::pop_heap(found.begin(), found.end());
    found.pop_back();
  }
  found.push_back(candidate);
  std::push_heap(found.begin(), found.end());
  walk->frontier.push_back(candidate);
  std::push_heap(walk->frontier.begin(), walk->frontier.end(), std::greater<>());
}

}  // namespace poselift
