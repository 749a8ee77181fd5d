// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "calib/edge_width.h"
#include "calib/tag_detector.h"

namespace poselift {
namespace {

double Median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

TagFacts CheckTags(const std::vector<cv::Mat>& pictures, const std::string& family_name) {
  const TagFamily family(family_name);
  TagDetector detector(family);
  TagFacts facts;
  std::vector<double> sharper_px, wider_px;
  for (const cv::Mat& grey : pictures) {
    for (const TagDetection& tag : detector.Detect(grey)) {
      ++facts.num_found;
      const auto [a_px, b_px] = EdgeWidths_px(grey, tag, family.cells_of_size());
      if (!std::isfinite(a_px + b_px)) continue;
      sharper_px.push_back(std::min(a_px, b_px));
      wider_px.push_back(std::max(a_px, b_px));
    }
    cv::Mat mirrored;
    cv::flip(grey, mirrored, 1);
    facts.num_found_mirrored += static_cast<int>(detector.Detect(mirrored).size());
  }
  facts.sharper_edge_px = Median(std::move(sharper_px));
  facts.wider_edge_px = Median(std::move(wider_px));
  return facts;
}

}  // namespace poselift
