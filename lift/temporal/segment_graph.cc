// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/segment_graph.h"

#include <algorithm>
#include <functional>

namespace poselift {
namespace {

constexpr int kLandmarkStride = 32;
constexpr int kLandmarkShares = 32;  // searches until all landmarks were looked at
constexpr size_t kNumStarts = 32;    // of the last answers

}  // namespace

SegmentGraph::SegmentGraph(const SegmentPoints& points, int max_links, int build_width)
    : points_(points),
      most_links_(2 * static_cast<size_t>(max_links)),
      links_(most_links_ * static_cast<size_t>(points.size())),
      num_links_(static_cast<size_t>(points.size())) {
  GraphWalk walk;
  for (int point = 0; point < points.size(); ++point) {
    if (point > 0 && points.Next(point - 1) < 0) walk.found.clear();  // another trial
    Search(points.Point(point), build_width, &walk);
    Add(point, &walk);
  }
}

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
    for (const int next : Links(point)) Visit(query, width, next, walk);
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
    if (const int next = points_.Next(point); next >= 0 && next < num_points_)
      Visit(query, width, next, walk);
  }
  const int num_landmarks = (num_points_ + kLandmarkStride - 1) / kLandmarkStride;
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

void SegmentGraph::Add(int point, GraphWalk* walk) {
  thinned_ = walk->found;
  Thin(most_links_ / 2, &thinned_);
  SetLinks(point, thinned_);
  num_points_ = point + 1;
  for (const auto& [squared_distance, other] : thinned_) Link(other, {squared_distance, point});
}

void SegmentGraph::Link(int from, Candidate to) {
  const std::span<const int> links = Links(from);
  if (links.size() < most_links_) {
    links_[static_cast<size_t>(from) * most_links_ + links.size()] = to.second;
    ++num_links_[from];
    return;
  }
  crowded_.assign(1, to);
  for (const int other : links)
    crowded_.emplace_back(points_.SquaredDistance(points_.Point(from), other), other);
  std::sort(crowded_.begin(), crowded_.end());
  Thin(most_links_, &crowded_);
  SetLinks(from, crowded_);
}

void SegmentGraph::Thin(size_t most, std::vector<Candidate>* candidates) const {
  size_t num_kept = 0;
  for (const Candidate& candidate : *candidates) {
    if (num_kept == most) break;
    const float* point = points_.Point(candidate.second);
    const bool leads_elsewhere = std::all_of(
        candidates->begin(), candidates->begin() + num_kept, [&](const Candidate& kept) {
          return points_.SquaredDistance(point, kept.second) >= candidate.first;
        });
    if (leads_elsewhere) (*candidates)[num_kept++] = candidate;
  }
  candidates->resize(num_kept);
}

void SegmentGraph::SetLinks(int point, const std::vector<Candidate>& links) {
  num_links_[point] = static_cast<int>(links.size());
  for (size_t i = 0; i < links.size(); ++i)
    links_[static_cast<size_t>(point) * most_links_ + i] = links[i].second;
}

}  // namespace poselift
