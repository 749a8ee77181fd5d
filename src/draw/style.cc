// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "src/joints.h"
#include "src/units.h"

namespace poselift {
namespace {

using Eigen::Vector2d;

constexpr int kShift = 4;                     // OpenCV's fixed point: 1/16 px
constexpr double kLargestCoordinate = 1e100;  // its square is still finite
constexpr double kHersheyCapitalPx = 21.0;    // of FONT_HERSHEY_SIMPLEX at scale 1
constexpr int kLargestMarkPx = 4096;

cv::Point ToFixed(const Vector2d& x_px) {
  return {cvRound(x_px.x() * (1 << kShift)), cvRound(x_px.y() * (1 << kShift))};
}

// The part of a segment inside the canvas and a margin around it, as
// parameters of the segment (Liang and Barsky).
std::optional<std::pair<double, double>> Clipped(const cv::Mat& canvas, const Vector2d& from_px,
                                                 const Vector2d& to_px, double margin_px) {
  const Vector2d step = to_px - from_px;
  const Vector2d limit(canvas.cols + margin_px, canvas.rows + margin_px);
  double begin = 0.0, end = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double to_low = -margin_px - from_px[axis];
    const double to_high = limit[axis] - from_px[axis];
    if (step[axis] == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return std::nullopt;
      continue;
    }
    const double at_low = to_low / step[axis], at_high = to_high / step[axis];
    begin = std::max(begin, std::min(at_low, at_high));
    end = std::min(end, std::max(at_low, at_high));
  }
  if (begin > end) return std::nullopt;
  return std::pair(begin, end);
}

bool IsNear(const cv::Mat& canvas, const Vector2d& x_px, double margin_px) {
  return x_px.x() > -margin_px && x_px.y() > -margin_px && x_px.x() < canvas.cols + margin_px &&
         x_px.y() < canvas.rows + margin_px;
}

void FillTaper(cv::Mat* canvas, const Vector2d& from_px, const Vector2d& to_px, double width_px,
               double end_width_px, const cv::Scalar& color) {
  const Vector2d along = (to_px - from_px).normalized();
  const Vector2d across(-along.y(), along.x());
  // The anti-aliased edge of fillConvexPoly lies about half a pixel outside.
  const double a = std::max(0.1, 0.5 * width_px - 0.4), b = std::max(0.1, 0.5 * end_width_px - 0.4);
  const std::array<cv::Point, 4> corners = {
      ToFixed(from_px + a * across), ToFixed(to_px + b * across), ToFixed(to_px - b * across),
      ToFixed(from_px - a * across)};
  cv::fillConvexPoly(*canvas, corners.data(), 4, color, cv::LINE_AA, kShift);
}

void FillSquare(cv::Mat* canvas, const Vector2d& center_px, double half_px,
                const cv::Scalar& color) {
  const Vector2d side(half_px, 0.0);
  FillTaper(canvas, center_px - side, center_px + side, 2 * half_px, 2 * half_px, color);
}

void FillDisc(cv::Mat* canvas, const Vector2d& center_px, double radius_px,
              const cv::Scalar& color) {
  cv::circle(*canvas, ToFixed(center_px), cvRound(radius_px * (1 << kShift)), color, cv::FILLED,
             cv::LINE_AA, kShift);
}

}  // namespace

Side SideOf(std::string_view landmark) {
  if (landmark.starts_with("left_")) return Side::kLeft;
  if (landmark.starts_with("right_")) return Side::kRight;
  return Side::kCentre;
}

Side SideOf(int joint) { return SideOf(Joints()[joint].name); }

const cv::Scalar& ColorOf(Side side) {
  if (side == Side::kLeft) return palette::kLeft;
  return side == Side::kRight ? palette::kRight : palette::kCentre;
}

cv::Scalar Mixed(const cv::Scalar& a, const cv::Scalar& b, double t) {
  return a * (1.0 - t) + b * t;
}

bool IsDrawable(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return (x.array().abs() < kLargestCoordinate).all();
}

void DrawStroke(cv::Mat* canvas, const Vector2d& from_px, const Vector2d& to_px,
                const Stroke& stroke) {
  if (!IsDrawable(from_px) || !IsDrawable(to_px)) return;
  const auto inside =
      Clipped(*canvas, from_px, to_px, std::max(stroke.width_px, stroke.end_width_px));
  if (!inside) return;
  const auto [begin, end] = *inside;
  const auto point_at = [&](double t) -> Vector2d { return (1.0 - t) * from_px + t * to_px; };
  const auto width_at = [&](double t) {
    return (1.0 - t) * stroke.width_px + t * stroke.end_width_px;
  };
  const double length_px = (point_at(end) - point_at(begin)).norm();
  if (length_px < 1e-9) return;
  // An odd number of parts: a dash at either end.
  const int parts =
      stroke.dash_px > 0.0 ? 1 + 2 * static_cast<int>(length_px / (2.0 * stroke.dash_px)) : 1;
  for (int i = 0; i < parts; i += 2) {
    const double a = begin + (end - begin) * i / parts;
    const double b = begin + (end - begin) * (i + 1) / parts;
    FillTaper(canvas, point_at(a), point_at(b), width_at(a), width_at(b), stroke.color);
  }
}

void DrawLine(cv::Mat* canvas, const Vector2d& from_px, const Vector2d& to_px,
              const cv::Scalar& color, double width_px, double dash_px) {
  DrawStroke(canvas, from_px, to_px, {color, width_px, width_px, dash_px});
}

void DrawMark(cv::Mat* canvas, const Vector2d& center_px, Side side, const MarkStyle& style) {
  const double radius = std::min<double>(style.radius_px, kLargestMarkPx);
  if (!IsNear(*canvas, center_px, 2.0 * (radius + style.rim_px))) return;
  const auto fill = side == Side::kRight ? FillSquare : FillDisc;
  fill(canvas, center_px, radius + style.rim_px, style.rim_color);
  fill(canvas, center_px, radius, style.color);
}

void FillTriangle(cv::Mat* canvas, const std::array<Vector2d, 3>& corners_px,
                  const cv::Scalar& color) {
  std::array<cv::Point, 3> corners;
  for (int i = 0; i < 3; ++i) {
    if (!IsNear(*canvas, corners_px[i], kLargestMarkPx)) return;
    corners[i] = ToFixed(corners_px[i]);
  }
  cv::fillConvexPoly(*canvas, corners.data(), 3, color, cv::LINE_AA, kShift);
}

void DrawRing(cv::Mat* canvas, const Vector2d& center_px, double radius_px, const cv::Scalar& color,
              double width_px, bool dashed) {
  const double radius = std::min<double>(radius_px, kLargestMarkPx);
  if (!IsNear(*canvas, center_px, 2.0 * radius + width_px)) return;
  const int width = std::max(1, cvRound(width_px));
  const int fixed_radius = cvRound(radius * (1 << kShift));
  const int arcs = dashed ? 3 : 1;
  // Half the turn is drawn; the round ends of an arc are beyond its span.
  const double ends_deg = kDegFromRad * width / std::max(1.0, radius);
  const double span_deg = dashed ? std::max(12.0, 66.0 - ends_deg) : 360.0;
  const auto draw = [&](const cv::Scalar& ink, int thickness) {
    for (int i = 0; i < arcs; ++i) {
      const double start_deg = i * 120.0 - 90.0 - 0.5 * span_deg;
      cv::ellipse(*canvas, ToFixed(center_px), {fixed_radius, fixed_radius}, 0.0, start_deg,
                  start_deg + span_deg, ink, thickness, cv::LINE_AA, kShift);
    }
  };
  draw(palette::kInk, width + 2 * std::max(1, cvRound(0.5 * width_px)));
  draw(color, width);
}

void DrawText(cv::Mat* canvas, const Vector2d& at_px, const std::string& text,
              const TextStyle& style) {
  if (!IsNear(*canvas, at_px, canvas->cols + canvas->rows)) return;
  const cv::Point origin(cvRound(at_px.x() - style.anchor * TextWidth(text, style.height_px)),
                         cvRound(at_px.y() + 0.5 * style.height_px));
  const double scale = style.height_px / kHersheyCapitalPx;
  const int thickness = std::max(1, cvRound(style.height_px / 9.0));
  const auto put = [&](const cv::Scalar& ink, int width) {
    cv::putText(*canvas, text, origin, cv::FONT_HERSHEY_SIMPLEX, scale, ink, width, cv::LINE_AA);
  };
  if (style.outlined) put(palette::kInk, thickness + 2 * std::max(1, thickness));
  put(style.color, thickness);
}

double TextWidth(const std::string& text, double height_px) {
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, height_px / kHersheyCapitalPx, 1, nullptr)
      .width;
}

std::string Fixed(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

}  // namespace poselift
