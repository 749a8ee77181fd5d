// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/ray_samples.h"

#include <limits>
#include <utility>
#include <variant>

namespace poselift::testing {
namespace {

constexpr RaySamples::Meeting kNone = {std::numeric_limits<float>::infinity(), -1};

}  // namespace

RaySamples::RaySamples(const cv::Rect& part_px, std::span<const Eigen::Vector2f> steps_px)
    : RaySamples(part_px, steps_px, {}, part_px.area()) {}

RaySamples::RaySamples(const cv::Rect& part_px, std::span<const Eigen::Vector2f> steps_px,
                       std::vector<int> slot_of_pixel, int num_slots)
    : part_px_(part_px),
      steps_px_(steps_px),
      slot_of_pixel_(std::move(slot_of_pixel)),
      meetings_(num_slots * steps_px.size(), kNone) {}

void RaySamples::Cast(const SeenBody& body, const RayMap& rays) {
  for (size_t i = 0; i < body.surfaces().size(); ++i) {
    const SeenBody::Surface& surface = body.surfaces()[i];
    std::visit([&](const auto& shape) { Cast(shape, static_cast<int>(i), surface.box_px, rays); },
               surface.shape);
  }
}

template <typename Shape>
void RaySamples::Cast(const Shape& shape, int surface, const cv::Rect& box_px, const RayMap& rays) {
  const cv::Rect box = box_px & part_px_;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const int row = (y - part_px_.y) * part_px_.width - part_px_.x;
    for (int x = box.x; x < box.x + box.width; ++x) {
      const int slot = slot_of_pixel_.empty() ? row + x : slot_of_pixel_[row + x];
      if (slot < 0) continue;
      for (size_t s = 0; s < steps_px_.size(); ++s) {
        const float depth_m = shape.Depth_m(rays.At(x, y, steps_px_[s]));
        Meeting& meeting = meetings_[slot * steps_px_.size() + s];
        if (depth_m < meeting.depth_m) meeting = {depth_m, surface};
      }
    }
  }
}

}  // namespace poselift::testing
