// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <vector>

#include "lift/temporal/segment_points.h"

namespace poselift {

// Y. A. Malkov, D. A. Yashunin, Efficient and Robust Approximate Nearest Neighbor
// Search Using Hierarchical Navigable Small World Graphs, 2016, by hnswlib: a
// search that needs no start. Copies the points.
class HnswIndex {
 public:
  // Their M and ef_construction. Deterministic.
  HnswIndex(const SegmentPoints& points, int max_links, int build_width);
  ~HnswIndex();

  // The `width` nearest that it finds, nearest first.
  void Search(const float* query, int width, std::vector<Candidate>* found) const;

  // The lowest layer of the graph: by point, the points it links to.
  std::vector<std::vector<int>> Links() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poselift
