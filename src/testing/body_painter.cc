// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/body_painter.h"

#include <algorithm>
#include <array>
#include <vector>

namespace poselift::testing {
namespace {

using Meeting = RaySamples::Meeting;

constexpr float kInk = 0.08f;  // of the paper's brightness

// What a grey picture shows of a colour.
float GreyOf(const Eigen::Vector3f& bgr) {
  return 0.114f * bgr.x() + 0.587f * bgr.y() + 0.299f * bgr.z();
}

// Along x the bits of i turned round, along y 5 i + 3 modulo 16.
std::array<Eigen::Vector2f, kStepsOfPixel> Steps() {
  std::array<Eigen::Vector2f, kStepsOfPixel> steps;
  for (int i = 0; i < kStepsOfPixel; ++i) {
    const int turned = (i & 1) << 3 | (i & 2) << 1 | (i & 4) >> 1 | (i & 8) >> 3;
    const Eigen::Vector2f cell(turned, (5 * i + 3) % kStepsOfPixel);
    steps[i] = (cell.array() + 0.5f) / kStepsOfPixel - 0.5f;
  }
  return steps;
}

std::vector<Eigen::Vector2f> SomeSteps(int first, int count) {
  static const auto kSteps = Steps();
  std::vector<Eigen::Vector2f> steps;
  for (int i = first; i < first + count; ++i) steps.push_back(kSteps[i % kStepsOfPixel]);
  return steps;
}

// Numbers the pixels with a tag or an edge between surfaces; -1 for others.
std::vector<int> SlotsOfEdges(const SeenBody& body, const RaySamples& centres, cv::Size size,
                              int* num_slots) {
  std::vector<int> slots(size.area(), -1);
  const auto surface_at = [&](int pixel) { return centres.At(pixel)[0].surface; };
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int here = y * size.width + x;
      const int surface = surface_at(here);
      if (body.IsTag(surface)) slots[here] = 0;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
        if (x + dx < 0 || x + dx >= size.width || y + dy >= size.height) continue;
        const int there = here + dy * size.width + dx;
        if (surface_at(there) != surface) slots[here] = slots[there] = 0;
      }
    }
  *num_slots = 0;
  for (int& slot : slots)
    if (slot == 0) slot = (*num_slots)++;
  return slots;
}

}  // namespace

Eigen::Vector3f BodyPainter::Color(const SeenBody& body, const Meeting& meeting,
                                   const Ray& ray) const {
  const SeenBody::Surface& surface = body.surfaces()[meeting.surface];
  Eigen::Vector3f normal;
  float brightness = 1.0f;
  if (const auto* paper = std::get_if<SeenPaper>(&surface.shape)) {
    normal = paper->normal();
    brightness = kInk + (1 - kInk) * paper->Brightness(ray, meeting.depth_m);
  } else {
    normal = std::get<SeenRoundCone>(surface.shape).Normal(ray, meeting.depth_m);
  }
  const float lit = std::max(0.0f, normal.dot(light_.towards_in_cam));
  return 255.0f * brightness * (light_.ambient + (1 - light_.ambient) * lit) * surface.albedo_bgr;
}

void BodyPainter::AddPixel(const SeenBody& body, int x, int y, std::span<const Meeting> meetings,
                           std::span<const Eigen::Vector2f> steps_px, float share,
                           cv::Mat* picture) const {
  Eigen::Vector3f color = Eigen::Vector3f::Zero();
  int met = 0;
  for (size_t s = 0; s < meetings.size(); ++s) {
    if (meetings[s].surface < 0) continue;
    color += Color(body, meetings[s], rays_.At(x, y, steps_px[s]));
    ++met;
  }
  if (met == 0) return;
  const float covered = share * static_cast<float>(met) / static_cast<float>(meetings.size());
  color *= share / static_cast<float>(meetings.size());
  if (picture->channels() == 1) {
    picture->at<float>(y, x) += GreyOf(color) - covered * background_.at<float>(y, x);
  } else {
    const auto& behind = background_.at<cv::Vec3f>(y, x);
    for (int c = 0; c < 3; ++c) picture->at<cv::Vec3f>(y, x)[c] += color[c] - covered * behind[c];
  }
}

void BodyPainter::Add(const SeenBody& body, int first, int count, float share,
                      cv::Mat* picture) const {
  const cv::Rect part_px = body.Box_px();
  const std::vector<Eigen::Vector2f> centre_px = {Eigen::Vector2f::Zero()};
  RaySamples coarse(part_px, centre_px);
  coarse.Cast(body, rays_);
  int num_slots = 0;
  const std::vector<int> slots = SlotsOfEdges(body, coarse, part_px.size(), &num_slots);
  const std::vector<Eigen::Vector2f> steps_px = SomeSteps(first, count);
  RaySamples fine(part_px, steps_px, slots, num_slots);
  fine.Cast(body, rays_);
  for (int y = 0; y < part_px.height; ++y)
    for (int x = 0; x < part_px.width; ++x) {
      const int pixel = y * part_px.width + x;
      const bool is_fine = slots[pixel] >= 0;
      AddPixel(body, part_px.x + x, part_px.y + y,
               is_fine ? fine.At(slots[pixel]) : coarse.At(pixel), is_fine ? steps_px : centre_px,
               share, picture);
    }
}

}  // namespace poselift::testing
