// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/flow_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/video/tracking.hpp>

#include "src/observation.h"

namespace poselift {
namespace {

constexpr int kLeastWindow_px = 9;
constexpr int kLargestWindow_px = 61;

}  // namespace

std::string FlowOptions::Validate() const {
  if (!(window > 0.0)) return fmt::format("FlowOptions::window = {}, wanted more than 0", window);
  if (pyramid_levels < 0 || pyramid_levels > 10)
    return fmt::format("FlowOptions::pyramid_levels = {}, wanted 0 to 10", pyramid_levels);
  if (!(max_round_trip > 0.0))
    return fmt::format("FlowOptions::max_round_trip = {}, wanted more than 0", max_round_trip);
  if (!(step_sigma > 0.0))
    return fmt::format("FlowOptions::step_sigma = {}, wanted more than 0", step_sigma);
  return "";
}

FlowPyramid MakeFlowPyramid(const cv::Mat& grey, const FlowOptions& options) {
  FlowPyramid pyramid;
  cv::buildOpticalFlowPyramid(grey, pyramid, {kLargestWindow_px, kLargestWindow_px},
                              options.pyramid_levels);
  return pyramid;
}

FlowFollower::FlowFollower(const FrameLabels& labels, const FlowOptions& options)
    : options_(options) {
  for (const PersonLabels& person : labels.people) {
    const double half_px = std::min<double>(options.window * Extent_px(person) / 2.0, 1e3);
    windows_px_.push_back(
        std::clamp(2 * static_cast<int>(half_px) + 1, kLeastWindow_px, kLargestWindow_px));
    auto& points = points_.emplace_back();
    for (const LandmarkLabel& label : person.landmarks)
      points.push_back({label.x_px, 0.0, label.state == LabelState::kVisible});
  }
}

void FlowFollower::Step(const FlowPyramid& from, const FlowPyramid& to) {
  for (size_t person = 0; person < points_.size(); ++person) StepPerson(from, to, person);
}

void FlowFollower::StepPerson(const FlowPyramid& from, const FlowPyramid& to, size_t person) {
  const int window_px = windows_px_[person];
  std::vector<FollowedPoint*> followed;
  std::vector<cv::Point2f> x, y, back;
  for (FollowedPoint& point : points_[person]) {
    if (!point.known) continue;
    followed.push_back(&point);
    x.emplace_back(static_cast<float>(point.x_px.x()), static_cast<float>(point.x_px.y()));
  }
  if (followed.empty()) return;
  const auto flow = [&](const FlowPyramid& a, const FlowPyramid& b, const auto& in, auto* out) {
    std::vector<uchar> found;
    cv::calcOpticalFlowPyrLK(a, b, in, *out, found, cv::noArray(), {window_px, window_px},
                             options_.pyramid_levels);
    return found;
  };
  const std::vector<uchar> found = flow(from, to, x, &y);
  const std::vector<uchar> found_back = flow(to, from, y, &back);
  const cv::Size size_px = to.front().size();
  const double step_sigma_px = options_.step_sigma * window_px;
  for (size_t i = 0; i < followed.size(); ++i) {
    const double round_trip_px = cv::norm(back[i] - x[i]);
    const bool inside = y[i].x > -0.5F && y[i].y > -0.5F &&
                        y[i].x < static_cast<float>(size_px.width) - 0.5F &&
                        y[i].y < static_cast<float>(size_px.height) - 0.5F;
    followed[i]->known =
        found[i] && found_back[i] && inside && round_trip_px <= options_.max_round_trip * window_px;
    followed[i]->x_px << y[i].x, y[i].y;
    followed[i]->variance_px2 += step_sigma_px * step_sigma_px + round_trip_px * round_trip_px;
  }
}

}  // namespace poselift
