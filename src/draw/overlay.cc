// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "src/draw/figure.h"
#include "src/draw/style.h"

namespace poselift {
namespace {

using Eigen::Vector2d;

// Sizes of what is drawn, in pixels of the result.
struct Sizes {
  double bone;
  double text;
  double extent;  // of the person

  double Ring() const { return 1.15 * bone + 1.5; }
  double Line() const { return std::max(1.2, 0.4 * bone); }
};

double Diagonal(const cv::Mat& canvas) { return std::hypot(canvas.cols, canvas.rows); }

Sizes SizesFor(const cv::Mat& canvas, const OverlayPerson& person) {
  Pose3 spread = person.joints_in_px;
  if (spread.cols() == 0) {
    spread = Pose3::Zero(3, static_cast<Eigen::Index>(person.labels.size()));
    for (Eigen::Index i = 0; i < spread.cols(); ++i)
      spread.col(i).head<2>() = person.labels[i].x_px;
  }
  Sizes sizes;
  sizes.extent = FigureExtent(spread);
  sizes.bone = std::max(1.5, std::min(Diagonal(canvas) / 190.0, sizes.extent / 85.0));
  sizes.text = std::max(8.0, Diagonal(canvas) / 80.0);
  return sizes;
}

cv::Size StatedSize(const OverlayInput& input) {
  if (input.width_px > 0 && input.height_px > 0) return {input.width_px, input.height_px};
  Vector2d high(0.0, 0.0);
  const auto include = [&](const Vector2d& x_px) {
    if (IsDrawable(x_px)) high = high.cwiseMax(x_px);
  };
  for (const OverlayPerson& person : input.people) {
    for (int j = 0; j < person.joints_in_px.cols(); ++j)
      include(person.joints_in_px.col(j).head<2>());
    for (const OverlayLabel& label : person.labels) include(label.x_px);
  }
  const Vector2d size = (1.1 * high).cwiseMax(64.0).cwiseMin(1e6);
  return {cvRound(size.x()), cvRound(size.y())};
}

cv::Size Limited(const cv::Size& size, double scale) {
  return {std::max(1, cvRound(size.width * scale)), std::max(1, cvRound(size.height * scale))};
}

// Dimmed and half grey: the colours that are drawn keep to themselves.
cv::Mat DimmedPhoto(const cv::Mat& image, const cv::Size& size) {
  cv::Mat canvas = image;
  if (image.size() != size) cv::resize(image, canvas, size, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat grey, grey_bgr, dimmed;
  cv::cvtColor(canvas, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, grey_bgr, cv::COLOR_GRAY2BGR);
  cv::addWeighted(canvas, 0.45, grey_bgr, 0.37, 0.0, dimmed);
  return dimmed;
}

cv::Mat GridCanvas(const cv::Size& size, double out_from_px) {
  cv::Mat canvas(size, CV_8UC3, cv::Scalar(128, 126, 124));
  double step_px = 10.0 * out_from_px;
  for (int i = 0; step_px < std::max(size.width, size.height) / 16.0; ++i)
    step_px *= i % 2 == 0 ? 5.0 : 2.0;
  for (int i = 1; i * step_px < size.width; ++i)
    DrawLine(&canvas, {i * step_px, 0.0}, {i * step_px, size.height * 1.0}, {144, 142, 140}, 1.5);
  for (int i = 1; i * step_px < size.height; ++i)
    DrawLine(&canvas, {0.0, i * step_px}, {size.width * 1.0, i * step_px}, {144, 142, 140}, 1.5);
  return canvas;
}

// Pixel centres are integers: (x + 1/2) scales, not x.
void Rescale(double out_from_px, OverlayPerson* person) {
  const double shift = 0.5 * out_from_px - 0.5;
  person->joints_in_px *= out_from_px;
  person->joints_in_px.topRows<2>().array() += shift;
  for (OverlayLabel& label : person->labels) {
    label.x_px = (label.x_px * out_from_px).array() + shift;
    if (label.reprojected_px)
      label.reprojected_px = (*label.reprojected_px * out_from_px).array() + shift;
  }
}

cv::Scalar ResidualColor(double residual_px, double large_px) {
  return Mixed(palette::kCentre, palette::kError, std::min(1.0, residual_px / large_px));
}

void DrawResidual(cv::Mat* canvas, const OverlayLabel& label, const Sizes& sizes, double large_px) {
  if (label.state == LabelState::kAbsent || !label.reprojected_px) return;
  const double residual_px = (*label.reprojected_px - label.x_px).norm();
  DrawLine(canvas, label.x_px, *label.reprojected_px, palette::kInk, sizes.Line() + 2.0);
  DrawLine(canvas, label.x_px, *label.reprojected_px, ResidualColor(residual_px, large_px),
           sizes.Line());
}

void DrawLabel(cv::Mat* canvas, const OverlayLabel& label, const Sizes& sizes) {
  if (label.state == LabelState::kAbsent) return;
  DrawRing(canvas, label.x_px, sizes.Ring(), ColorOf(SideOf(label.name)), 0.4 * sizes.bone,
           label.state == LabelState::kOccluded);
}

// Beside the label, on the side away from the reprojection.
void DrawResidualNumber(cv::Mat* canvas, const OverlayLabel& label, const Sizes& sizes,
                        double large_px, double out_from_px) {
  if (label.state == LabelState::kAbsent || !label.reprojected_px) return;
  const double residual_px = (*label.reprojected_px - label.x_px).norm();
  if (!(residual_px >= large_px)) return;
  const bool goes_right = label.x_px.x() >= label.reprojected_px->x();
  const double gap_px = 1.6 * sizes.Ring();
  DrawText(
      canvas, label.x_px + Vector2d(goes_right ? gap_px : -gap_px, 0.0),
      Fixed(residual_px / out_from_px, 0) + " px",
      {Mixed(palette::kCentre, palette::kError, 0.4), sizes.text, goes_right ? 0.0 : 1.0, true});
}

void DrawPerson(cv::Mat* canvas, const OverlayPerson& person, const OverlayOptions& options,
                double out_from_px) {
  const Sizes sizes = SizesFor(*canvas, person);
  const double large_px = std::max(2.0, options.large_residual * sizes.extent);
  if (person.joints_in_px.cols() > 0)
    DrawFigure(canvas, person.joints_in_px, {sizes.bone, sizes.text});
  for (const OverlayLabel& label : person.labels) DrawResidual(canvas, label, sizes, large_px);
  for (const OverlayLabel& label : person.labels) DrawLabel(canvas, label, sizes);
  for (const OverlayLabel& label : person.labels)
    DrawResidualNumber(canvas, label, sizes, large_px, out_from_px);
}

// A line of the legend: a sample at the left, centred on a point, and its text.
struct LegendRow {
  std::function<void(cv::Mat*, const Vector2d&)> draw_sample;
  std::string text;
};

std::vector<LegendRow> LegendRows(const OverlayInput& input, double text_px) {
  const double half_px = 1.1 * text_px, width_px = 0.45 * text_px;
  const auto bone = [=](Side side) {
    return [=](cv::Mat* canvas, const Vector2d& at_px) {
      const Vector2d half(half_px, 0.0);
      DrawLine(canvas, at_px - half, at_px + half, ColorOf(side), width_px,
               side == Side::kRight ? 0.5 * text_px : 0.0);
    };
  };
  const auto ring = [=](bool dashed) {
    return [=](cv::Mat* canvas, const Vector2d& at_px) {
      DrawRing(canvas, at_px, 0.55 * text_px, palette::kCentre, 0.18 * text_px, dashed);
    };
  };
  const auto taper = [=](cv::Mat* canvas, const Vector2d& at_px) {
    const Vector2d half(half_px, 0.0);
    DrawStroke(canvas, at_px - half, at_px + half, {palette::kCentre, 0.7 * text_px, 1.0});
  };
  const auto residual = [=](cv::Mat* canvas, const Vector2d& at_px) {
    const Vector2d half(half_px, 0.0);
    DrawLine(canvas, at_px - half, at_px + half, palette::kError, 0.25 * text_px);
  };
  std::vector<LegendRow> rows = {{bone(Side::kLeft), "left"},  {bone(Side::kRight), "right"},
                                 {taper, "near - far"},        {ring(false), "label"},
                                 {ring(true), "hidden label"}, {residual, "error"}};
  for (const OverlayPerson& person : input.people)
    if (person.reprojection_rms_px && std::isfinite(*person.reprojection_rms_px) &&
        rows.size() < 12)
      rows.push_back({nullptr, "RMS " + Fixed(*person.reprojection_rms_px, 1) + " px"});
  return rows;
}

// The corner with the fewest joints and labels in it.
cv::Rect EmptiestCorner(const cv::Mat& canvas, const OverlayInput& input, const cv::Size& size) {
  const int right = canvas.cols - size.width, below = canvas.rows - size.height;
  const std::array<cv::Rect, 4> corners = {cv::Rect({0, 0}, size), cv::Rect({right, 0}, size),
                                           cv::Rect({0, below}, size),
                                           cv::Rect({right, below}, size)};
  std::array<int, 4> counts = {};
  for (size_t c = 0; c < corners.size(); ++c) {
    const cv::Rect2d corner = corners[c];
    for (const OverlayPerson& person : input.people) {
      for (int j = 0; j < person.joints_in_px.cols(); ++j)
        counts[c] += corner.contains({person.joints_in_px(0, j), person.joints_in_px(1, j)});
      for (const OverlayLabel& label : person.labels)
        counts[c] += corner.contains({label.x_px.x(), label.x_px.y()});
    }
  }
  return corners[std::min_element(counts.begin(), counts.end()) - counts.begin()];
}

void DrawLegend(cv::Mat* canvas, const OverlayInput& input) {
  const double text_px = std::max(8.0, Diagonal(*canvas) / 85.0);
  const std::vector<LegendRow> rows = LegendRows(input, text_px);
  const double row_px = 1.75 * text_px, text_x_px = 3.4 * text_px;
  double width_px = 0.0;
  for (const LegendRow& row : rows) width_px = std::max(width_px, TextWidth(row.text, text_px));
  const cv::Size size(cvRound(text_x_px + width_px + text_px),
                      cvRound(row_px * (rows.size() + 0.5)));
  if (2 * size.width > canvas->cols || 2 * size.height > canvas->rows) return;
  cv::Mat box = (*canvas)(EmptiestCorner(*canvas, input, size));
  cv::Mat(box * 0.3).copyTo(box);
  for (size_t i = 0; i < rows.size(); ++i) {
    const double y_px = row_px * (i + 0.75);
    if (rows[i].draw_sample) rows[i].draw_sample(&box, {1.9 * text_px, y_px});
    DrawText(&box, {rows[i].draw_sample ? text_x_px : 0.8 * text_px, y_px}, rows[i].text,
             {palette::kCentre, text_px});
  }
}

void Check(const cv::Mat& image, const OverlayInput& input, const OverlayOptions& options) {
  if (!image.empty() && image.type() != CV_8UC3)
    throw std::invalid_argument("DrawOverlay: the image is not 8-bit BGR");
  for (const OverlayPerson& person : input.people)
    if (person.joints_in_px.cols() != kNumJoints && person.joints_in_px.cols() != 0)
      throw std::invalid_argument("DrawOverlay: wanted 23 joints or none");
  if (const std::string wrong = options.Validate(); !wrong.empty())
    throw std::invalid_argument("DrawOverlay: " + wrong);
}

}  // namespace

std::string OverlayOptions::Validate() const {
  if (max_side_px < 64 || max_side_px > 32000)
    return "max_side_px = " + std::to_string(max_side_px) + ", wanted 64 to 32000";
  if (!(large_residual > 0.0))
    return "large_residual = " + std::to_string(large_residual) + ", wanted more than 0";
  return {};
}

cv::Mat DrawOverlay(const cv::Mat& image_or_empty, const OverlayInput& input,
                    const OverlayOptions& options) {
  Check(image_or_empty, input, options);
  const cv::Size full = image_or_empty.empty() ? StatedSize(input) : image_or_empty.size();
  const double out_from_px =
      std::min(1.0, options.max_side_px / static_cast<double>(std::max(full.width, full.height)));
  const cv::Size size = Limited(full, out_from_px);
  cv::Mat canvas =
      image_or_empty.empty() ? GridCanvas(size, out_from_px) : DimmedPhoto(image_or_empty, size);
  OverlayInput scaled = input;
  for (OverlayPerson& person : scaled.people) {
    Rescale(out_from_px, &person);
    DrawPerson(&canvas, person, options, out_from_px);
  }
  DrawLegend(&canvas, scaled);
  return canvas;
}

}  // namespace poselift
