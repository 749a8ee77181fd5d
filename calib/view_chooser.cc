// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/view_chooser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace poselift {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Between corners that both views show, rms; infinite when few are common.
double Difference_px(const BoardView& a, const BoardView& b) {
  double sum_px2 = 0.0, num = 0.0;
  for (size_t i = 0, j = 0; i < a.ids.size() && j < b.ids.size();) {
    if (a.ids[i] == b.ids[j]) {
      sum_px2 += (a.corners_px.col(static_cast<Eigen::Index>(i)) -
                  b.corners_px.col(static_cast<Eigen::Index>(j)))
                     .squaredNorm();
      num += 1.0;
      ++i, ++j;
    } else if (a.ids[i] < b.ids[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  const auto fewer = static_cast<double>(std::min(a.ids.size(), b.ids.size()));
  return num < 0.5 * fewer || num == 0.0 ? kInfinity : std::sqrt(sum_px2 / num);
}

double SharpnessAt(const cv::Mat& patch) {
  double low = 0.0, high = 0.0;
  cv::minMaxLoc(patch, &low, &high);
  int steepest = 0;
  for (int y = 1; y + 1 < patch.rows; ++y)
    for (int x = 1; x + 1 < patch.cols; ++x) {
      const int across = patch.at<uchar>(y, x + 1) - patch.at<uchar>(y, x - 1);
      const int down = patch.at<uchar>(y + 1, x) - patch.at<uchar>(y - 1, x);
      steepest = std::max({steepest, std::abs(across), std::abs(down)});
    }
  return high > low ? 0.5 * steepest / (high - low) : 0.0;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The stiller one; of those about as still the sharper.
bool IsBetter(const ChosenView& a, const ChosenView& b) {
  constexpr double kStep = 0.02;
  const double speed_a = std::floor(a.speed / kStep), speed_b = std::floor(b.speed / kStep);
  return speed_a != speed_b ? speed_a < speed_b : a.sharpness > b.sharpness;
}

}  // namespace

std::string ViewChooserOptions::Validate() const {
  if (!(least_difference > 0.0 && largest_speed > 0.0 && least_sharpness >= 0.0))
    return "least_difference, largest_speed: wanted more than 0";
  if (most_views < 1) return fmt::format("most_views: found {}, wanted 1 or more", most_views);
  return {};
}

ViewChooser::ViewChooser(cv::Size size_px, const ViewChooserOptions& options)
    : options_(options), diagonal_px_(std::hypot(size_px.width, size_px.height)) {
  if (const std::string flaw = options.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
}

double ViewChooser::SpeedOf(const BoardView& view, double time_s) const {
  constexpr double kLongest_s = 1.0;  // what was before is no guide
  if (last_.empty() || time_s - last_s_ > kLongest_s || time_s <= last_s_) return 0.0;
  const double difference_px = Difference_px(last_, view);
  return std::isfinite(difference_px) ? difference_px / diagonal_px_ / (time_s - last_s_) : 0.0;
}

bool ViewChooser::Offer(const cv::Mat& grey, const BoardView& view, int frame, double time_s) {
  if (view.empty()) return false;
  const ChosenView offered{view, frame, time_s, EdgeSharpness(grey, view), SpeedOf(view, time_s)};
  last_ = view;
  last_s_ = time_s;
  if (offered.speed > options_.largest_speed) return false;
  const auto is_alike = [&](const ChosenView& other) {
    return Difference_px(other.view, view) < options_.least_difference * diagonal_px_;
  };
  const auto alike = std::find_if(views_.begin(), views_.end(), is_alike);
  if (alike == views_.end()) {
    if (static_cast<int>(views_.size()) >= options_.most_views) return false;
    views_.push_back(offered);
    return true;
  }
  // It may stand in for one view only, else a board that drifts would empty the set.
  if (!IsBetter(offered, *alike) || std::any_of(alike + 1, views_.end(), is_alike)) return false;
  *alike = offered;
  return true;
}

std::vector<ChosenView> ViewChooser::SharpViews() const {
  if (views_.empty()) return {};
  std::vector<double> sharpness;
  for (const ChosenView& view : views_) sharpness.push_back(view.sharpness);
  const double least = options_.least_sharpness * Median(sharpness);
  std::vector<ChosenView> sharp;
  for (const ChosenView& view : views_)
    if (view.sharpness >= least) sharp.push_back(view);
  std::sort(sharp.begin(), sharp.end(),
            [](const ChosenView& a, const ChosenView& b) { return a.frame < b.frame; });
  return sharp;
}

double EdgeSharpness(const cv::Mat& grey, const BoardView& view) {
  constexpr int kHalf_px = 7;
  std::vector<double> sharpness;
  for (Eigen::Index i = 0; i < view.corners_px.cols(); ++i) {
    const cv::Rect patch =
        cv::Rect(cvRound(view.corners_px(0, i)) - kHalf_px,
                 cvRound(view.corners_px(1, i)) - kHalf_px, 2 * kHalf_px + 1, 2 * kHalf_px + 1) &
        cv::Rect(0, 0, grey.cols, grey.rows);
    if (patch.width > 2 && patch.height > 2) sharpness.push_back(SharpnessAt(grey(patch)));
  }
  return sharpness.empty() ? 0.0 : Median(sharpness);
}

}  // namespace poselift
