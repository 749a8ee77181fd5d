// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/nearest_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace poselift {
namespace {

size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0]++;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> NearestNames(std::string_view name, std::vector<std::string> names,
                                      size_t count) {
  constexpr size_t kLongestName = 64;  // a longer one resembles nothing
  std::vector<std::pair<size_t, std::string>> ranked;
  for (std::string& other : names) {
    const size_t distance = EditDistance(name.substr(0, kLongestName), other);
    ranked.emplace_back(distance, std::move(other));
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  ranked.resize(std::min(count, ranked.size()));
  std::vector<std::string> nearest;
  for (auto& [distance, other] : ranked) nearest.push_back(std::move(other));
  return nearest;
}

}  // namespace poselift
