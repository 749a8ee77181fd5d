// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/calibration_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "src/draw/style.h"

namespace poselift {
namespace {

using Eigen::Vector2d;

constexpr double kLongerSide_px = 1000.0;
constexpr int kMargin_px = 24, kHead_px = 84, kFoot_px = 56, kLeastWidth_px = 680;
const cv::Scalar kCovered(196, 158, 86), kUsed(60, 60, 60), kArrow(30, 60, 220),
    kDropped(150, 50, 235);

struct Frame {
  double scale;
  cv::Rect area;  // of the camera's picture on the canvas
  Vector2d At(const Vector2d& x_px) const {
    return Vector2d(area.x, area.y) + scale * (x_px + Vector2d::Constant(0.5));
  }
};

void DrawCells(const CalibrationCoverage& coverage, const Frame& frame, cv::Mat* canvas) {
  const double most = std::max(1, coverage.corners.maxCoeff());
  const auto rows = static_cast<int>(coverage.corners.rows());
  const auto columns = static_cast<int>(coverage.corners.cols());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const cv::Point from(frame.area.x + frame.area.width * column / columns,
                           frame.area.y + frame.area.height * row / rows);
      const cv::Point to(frame.area.x + frame.area.width * (column + 1) / columns,
                         frame.area.y + frame.area.height * (row + 1) / rows);
      const int count = coverage.corners(row, column);
      const double depth = count == 0 ? 0.0 : 0.15 + 0.6 * std::sqrt(count / most);
      const cv::Rect cell(from, to);
      cv::rectangle(*canvas, cell, Mixed(palette::kPaper, kCovered, depth), cv::FILLED);
      cv::rectangle(*canvas, cell, palette::kGrid, 1);
      DrawText(canvas, {from.x + 6.0, from.y + 12.0}, std::to_string(count),
               {.color = palette::kFarInk, .height_px = 8.0});
    }
  cv::rectangle(*canvas, frame.area, palette::kInk, 1);
}

// So that a typical arrow is well seen: 1, 2 or 5 times a power of ten.
double Enlargement(const CalibrationResult& result, double scale) {
  constexpr double kTypical_px = 14.0;
  const double wanted = kTypical_px / std::max(1e-6, result.rms_px * scale);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double step : {5.0, 2.0})
    if (wanted >= step * power) return step * power;
  return power;
}

void DrawViews(const std::vector<BoardView>& views, const CalibrationResult& result,
               const Frame& frame, double enlargement, cv::Mat* canvas) {
  for (size_t v = 0; v < views.size() && v < result.views.size(); ++v) {
    const CalibratedView& view = result.views[v];
    for (Eigen::Index i = 0; i < views[v].corners_px.cols(); ++i) {
      const Vector2d at = frame.At(views[v].corners_px.col(i));
      DrawMark(canvas, at, Side::kCentre,
               {.color = view.is_used ? kUsed : kDropped, .radius_px = 1.6, .rim_px = 0.0});
      if (i < view.residuals_px.cols() && view.is_used)
        DrawLine(canvas, at, at + enlargement * frame.scale * view.residuals_px.col(i), kArrow,
                 1.2);
    }
  }
}

}  // namespace

cv::Mat DrawCalibration(const std::vector<BoardView>& views, const CalibrationResult& result,
                        const CalibrationCoverage& coverage, const std::string& title) {
  const Camera& camera = result.camera;
  const double scale = kLongerSide_px / std::max(camera.width_px, camera.height_px);
  const Frame frame{scale, cv::Rect(kMargin_px, kHead_px, cvRound(scale * camera.width_px),
                                    cvRound(scale * camera.height_px))};
  constexpr double kTitle_px = 12.0;
  const int width_px =
      std::max({frame.area.width, kLeastWidth_px, cvRound(TextWidth(title, kTitle_px))});
  cv::Mat canvas(frame.area.height + kHead_px + kFoot_px, width_px + 2 * kMargin_px, CV_8UC3,
                 palette::kPaper);
  DrawCells(coverage, frame, &canvas);
  const double enlargement = Enlargement(result, scale);
  DrawViews(views, result, frame, enlargement, &canvas);
  DrawText(&canvas, {kMargin_px, 24.0}, title, {.height_px = kTitle_px});
  const int num_dropped = static_cast<int>(views.size()) - result.num_used();
  DrawText(&canvas, {kMargin_px, 52.0},
           fmt::format("{} views, {} dropped; rms {:.3f} px; cells: corners seen there, {:.0f} % "
                       "of the picture",
                       result.num_used(), num_dropped, result.rms_px, 100.0 * coverage.share),
           {.color = palette::kFarInk, .height_px = 10.0});
  const double y = frame.area.br().y + 28.0;
  DrawLine(&canvas, {kMargin_px, y}, {kMargin_px + enlargement * scale * result.rms_px, y}, kArrow,
           2.0);
  DrawText(&canvas, {kMargin_px + enlargement * scale * result.rms_px + 12.0, y},
           fmt::format("seen minus calibrated, {:g} times enlarged: {:.3f} px", enlargement,
                       result.rms_px),
           {.color = palette::kFarInk, .height_px = 10.0});
  return canvas;
}

}  // namespace poselift
