// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/hnsw_index.h"

#include <algorithm>
#include <mutex>  // hnswlib 0.6 leaves this and the last out
#include <numeric>
#include <random>
#include <unordered_map>

// Defines functions that are not inline: included here alone.
#ifdef __SANITIZE_ADDRESS__  // what its SSE code prefetches lies behind the list's end
#define NO_MANUAL_VECTORIZATION
#endif
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
  // In order of time they would be linked along their trials and little else.
  std::vector<hnswlib::labeltype> order(static_cast<size_t>(points.size()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
  for (const hnswlib::labeltype i : order)
    impl_->index.addPoint(points.Point(static_cast<int>(i)), i);
}

HnswIndex::~HnswIndex() = default;

void HnswIndex::Search(const float* query, int width, std::vector<Candidate>* found) const {
  auto nearest = impl_->index.searchKnn(query, static_cast<size_t>(width));
  found->resize(nearest.size());
  for (size_t i = nearest.size(); i-- > 0; nearest.pop())
    (*found)[i] = {nearest.top().first, static_cast<int>(nearest.top().second)};
}

std::vector<std::vector<int>> HnswIndex::Links() const {
  const auto& index = impl_->index;
  std::vector<std::vector<int>> links(index.cur_element_count);
  for (hnswlib::tableint i = 0; i < index.cur_element_count; ++i) {
    hnswlib::linklistsizeint* list = index.get_linklist0(i);
    const auto* first = reinterpret_cast<const hnswlib::tableint*>(list + 1);
    for (int k = 0; k < index.getListCount(list); ++k)
      links[index.getExternalLabel(i)].push_back(
          static_cast<int>(index.getExternalLabel(first[k])));
  }
  return links;
}

}  // namespace poselift
