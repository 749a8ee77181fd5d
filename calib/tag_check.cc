// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_check.h"

#include <apriltag.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>

#include "calib/edge_width.h"
#include "calib/tag_family.h"

namespace poselift {
namespace {

class Finder {
 public:
  explicit Finder(const TagFamily& family) : detector_(apriltag_detector_create(), Destroy) {
    constexpr int kMaxHamming = 1;
    apriltag_detector_add_family_bits(detector_.get(), family.get(), kMaxHamming);
    detector_->quad_decimate = 1.0F;
  }

  std::vector<TagDetection> Find(const cv::Mat& grey) const {
    image_u8_t image{grey.cols, grey.rows, static_cast<int32_t>(grey.step), grey.data};
    zarray_t* const found = apriltag_detector_detect(detector_.get(), &image);
    std::vector<TagDetection> tags;
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(found, i, static_cast<void*>(&detection));
      constexpr float kMinMargin = 20.0F;
      if (detection->decision_margin < kMinMargin) continue;
      TagDetection& tag = tags.emplace_back();
      tag.id = detection->id;
      // libapriltag begins bottom left and goes to the right; its pixels have corners at integers.
      constexpr std::array kOrder = {3, 2, 1, 0};
      for (int corner = 0; corner < 4; ++corner)
        for (int axis = 0; axis < 2; ++axis)
          tag.corners_px(axis, corner) =
              detection->p[kOrder[static_cast<size_t>(corner)]][axis] - 0.5;
    }
    apriltag_detections_destroy(found);
    return tags;
  }

 private:
  static void Destroy(apriltag_detector_t* detector) {
    apriltag_detector_clear_families(detector);
    apriltag_detector_destroy(detector);
  }

  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector_;
};

double Median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

TagFacts CheckTags(const std::vector<cv::Mat>& pictures, const std::string& family_name) {
  const TagFamily family(family_name);
  const Finder finder(family);
  TagFacts facts;
  std::vector<double> sharper_px, wider_px;
  for (const cv::Mat& grey : pictures) {
    for (const TagDetection& tag : finder.Find(grey)) {
      ++facts.num_found;
      const auto [a_px, b_px] = EdgeWidths_px(grey, tag, family.cells_of_size());
      if (!std::isfinite(a_px + b_px)) continue;
      sharper_px.push_back(std::min(a_px, b_px));
      wider_px.push_back(std::max(a_px, b_px));
    }
    cv::Mat mirrored;
    cv::flip(grey, mirrored, 1);
    facts.num_found_mirrored += static_cast<int>(finder.Find(mirrored).size());
  }
  facts.sharper_edge_px = Median(std::move(sharper_px));
  facts.wider_edge_px = Median(std::move(wider_px));
  return facts;
}

}  // namespace poselift
