// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/hnsw_index.h"

// hnswlib 0.6 leaves these out.
#include <mutex>
#include <unordered_map>

// Defines functions that are not inline: included here alone.
#include <hnswlib/hnswlib.h>

namespace poselift {

struct HnswIndex::Impl {
  Impl(const SegmentPoints& points, int max_links, int build_width)
      : space(static_cast<size_t>(points.dim())),
        index(&space, static_cast<size_t>(points.size()), static_cast<size_t>(max_links),
              static_cast<size_t>(build_width)) {}

  hnswlib::L2Space space;  // the index keeps a pointer to it
  hnswlib::HierarchicalNSW<float> index;
};

HnswIndex::HnswIndex(const SegmentPoints& points, int max_links, int build_width)
    : impl_(std::make_unique<Impl>(points, max_links, build_width)) {
  for (int i = 0; i < points.size(); ++i)
    impl_->index.addPoint(points.Point(i), static_cast<hnswlib::labeltype>(i));
}

HnswIndex::~HnswIndex() = default;

void HnswIndex::Search(const float* query, int width, std::vector<Candidate>* found) const {
  auto nearest = impl_->index.searchKnn(query, static_cast<size_t>(width));
  found->resize(nearest.size());
  for (size_t i = nearest.size(); i-- > 0; nearest.pop())
    (*found)[i] = {nearest.top().first, static_cast<int>(nearest.top().second)};
}

}  // namespace poselift
