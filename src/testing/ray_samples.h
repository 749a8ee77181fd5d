// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "src/testing/ray_map.h"
#include "src/testing/seen_body.h"

namespace poselift::testing {

// What some rays a pixel meet first, of those pixels of a part of the picture that have
// a slot.
class RaySamples {
 public:
  struct Meeting {
    float depth_m;
    int surface;  // -1: none
  };

  // All pixels of the part, row by row.
  RaySamples(const cv::Rect& part_px, std::span<const Eigen::Vector2f> steps_px);
  // Those of slot_of_pixel, row by row, that are not -1: 0, 1, 2 ... num_slots - 1.
  RaySamples(const cv::Rect& part_px, std::span<const Eigen::Vector2f> steps_px,
             std::vector<int> slot_of_pixel, int num_slots);

  void Cast(const SeenBody& body, const RayMap& rays);

  std::span<const Meeting> At(int slot) const {
    return {&meetings_[slot * steps_px_.size()], steps_px_.size()};
  }

 private:
  template <typename Shape>
  void Cast(const Shape& shape, int surface, const cv::Rect& box_px, const RayMap& rays);

  cv::Rect part_px_;
  std::span<const Eigen::Vector2f> steps_px_;
  std::vector<int> slot_of_pixel_;  // empty: the pixel's own number
  std::vector<Meeting> meetings_;
};

}  // namespace poselift::testing
