// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/segment_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "lift/temporal/hnsw_index.h"
#include "src/input_error.h"

namespace poselift {
namespace {

using Method = SegmentSearchOptions::Method;

void ScanAll(const SegmentPoints& points, const float* query, size_t width,
             std::vector<Candidate>* found) {
  found->clear();
  for (int point = 0; point < points.size(); ++point) {
    const Candidate candidate(points.SquaredDistance(query, point), point);
    if (found->size() == width) {
      if (candidate > found->front()) continue;
      std::pop_heap(found->begin(), found->end());
      found->pop_back();
    }
    found->push_back(candidate);
    std::push_heap(found->begin(), found->end());
  }
  std::sort_heap(found->begin(), found->end());
}

}  // namespace

std::string SegmentSearchOptions::Validate() const {
  if (exclusion_frames < 0)
    return fmt::format("SegmentSearchOptions::exclusion_frames = {}, wanted at least 0",
                       exclusion_frames);
  const std::pair<const char*, int> counts[] = {{"num_frames", num_frames},
                                                {"num_nearest", num_nearest},
                                                {"width", width},
                                                {"build_width", build_width}};
  for (const auto& [name, count] : counts)
    if (count < 1)
      return fmt::format("SegmentSearchOptions::{} = {}, wanted at least 1", name, count);
  if (max_links < 2)  // hnswlib divides by the logarithm
    return fmt::format("SegmentSearchOptions::max_links = {}, wanted at least 2", max_links);
  return "";
}

struct SegmentSearch::Impl {
  Impl(const MotionDatabase& database, const FeatureVector& row_weights,
       const SegmentSearchOptions& wanted)
      : options(wanted),
        weights(row_weights),
        trials(database.trials),
        points(database, row_weights, wanted.num_frames) {
    if (points.size() == 0) return;
    if (options.method == Method::kHnsw)
      hnsw = std::make_unique<HnswIndex>(points, options.max_links, options.build_width);
    if (options.method == Method::kGraph)
      graph.emplace(points, options.max_links, options.build_width);
  }

  // How many of the nearest are sure to hold K when each that is taken excludes
  // all around it.
  int NumCandidates() const {
    const long enough = options.num_nearest * (2L * options.exclusion_frames + 1L);
    return static_cast<int>(std::clamp<long>(enough, 0, points.size()));
  }

  int TrialOf(int frame) const {
    const auto after =
        std::upper_bound(trials.begin(), trials.end(), frame,
                         [](int f, const Trial& trial) { return f < trial.first_frame; });
    return static_cast<int>(after - trials.begin());
  }

  bool Excludes(int frame, int other) const {
    return std::abs(frame - other) <= options.exclusion_frames && TrialOf(frame) == TrialOf(other);
  }

  void Take(const std::vector<Candidate>& found, std::vector<SegmentMatch>* matches) const {
    matches->clear();
    for (const auto& [squared_distance, point] : found) {
      if (matches->size() == static_cast<size_t>(options.num_nearest)) return;
      const int frame = points.EndFrame(point);
      const bool excluded = options.exclusion_frames > 0 &&
                            std::any_of(matches->begin(), matches->end(), [&](const auto& match) {
                              return Excludes(frame, match.end_frame);
                            });
      if (!excluded) matches->push_back({frame, squared_distance});
    }
  }

  SegmentSearchOptions options;
  FeatureVector weights;
  std::vector<Trial> trials;
  SegmentPoints points;
  std::unique_ptr<HnswIndex> hnsw;
  std::optional<SegmentGraph> graph;
};

SegmentSearch::SegmentSearch(const MotionDatabase& database, const FeatureVector& row_weights,
                             const SegmentSearchOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  impl_ = std::make_unique<const Impl>(database, row_weights, options);
}

SegmentSearch::~SegmentSearch() = default;

const SegmentSearchOptions& SegmentSearch::options() const { return impl_->options; }

const FeatureVector& SegmentSearch::row_weights() const { return impl_->weights; }

int SegmentSearch::NumSegments() const { return impl_->points.size(); }

void SegmentSearch::FindNearest(const Eigen::Ref<const FeatureMatrix>& query, SearchCursor* cursor,
                                std::vector<SegmentMatch>* matches) const {
  const SegmentPoints& points = impl_->points;
  if (query.cols() != impl_->options.num_frames)
    throw std::invalid_argument(
        fmt::format("a query of {} frames, wanted {}", query.cols(), impl_->options.num_frames));
  matches->clear();
  cursor->num_visited = 0;
  if (points.size() == 0) return;
  cursor->scaled_query = (impl_->weights.asDiagonal() * query).cast<float>();
  const float* point = cursor->scaled_query.data();
  const int num_candidates = impl_->NumCandidates();
  const int width = std::max(num_candidates, impl_->options.width);
  std::vector<Candidate>& found = cursor->walk.found;
  switch (impl_->options.method) {
    case Method::kBruteForce:
      ScanAll(points, point, static_cast<size_t>(num_candidates), &found);
      cursor->num_visited = points.size();
      break;
    case Method::kHnsw:
      impl_->hnsw->Search(point, width, &found);
      break;
    case Method::kGraph:
      impl_->graph->Search(point, width, &cursor->walk);
      cursor->num_visited = cursor->walk.num_visited;
      break;
  }
  impl_->Take(found, matches);
}

}  // namespace poselift
