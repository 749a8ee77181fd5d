// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

namespace poselift {

// What all pictures share: the palette, and strokes that any coordinates are
// safe for. Everything draws on 8-bit BGR, positions in pixels of the canvas
// (integer = pixel centre), anti-aliased and with sub-pixel places and widths.
//
// Left and right are told apart twice: by colour (sky blue and orange of Okabe
// and Ito, distinct in every common colour blindness) and by form (left bones
// solid with round joints, right bones banded with square joints). Each stroke
// has a dark outline: bright core and dark rim read on any picture.

enum class Side { kLeft, kRight, kCentre };
Side SideOf(int joint);
Side SideOf(std::string_view landmark);  // by its name: left_..., right_...

namespace palette {  // BGR
inline const cv::Scalar kLeft(233, 180, 86), kRight(0, 159, 230), kCentre(250, 250, 250),
    kInk(32, 32, 32), kFar(228, 228, 228), kFarInk(86, 86, 86), kPaper(248, 247, 246),
    kGrid(222, 219, 216), kMetre(190, 184, 178), kShadow(208, 202, 196), kGhost(176, 172, 168),
    kError(150, 50, 235);
}  // namespace palette
const cv::Scalar& ColorOf(Side side);

// a at t = 0, b at t = 1.
cv::Scalar Mixed(const cv::Scalar& a, const cv::Scalar& b, double t);

// Finite, and not so large that sums of squares are not.
bool IsDrawable(const Eigen::Ref<const Eigen::VectorXd>& x);

struct Stroke {
  cv::Scalar color;
  double width_px = 1.0;      // where it starts
  double end_width_px = 1.0;  // where it ends
  double dash_px = 0.0;       // length of a dash and of a gap; 0: solid
};

// Nothing is drawn where an end is not drawable; the part outside the canvas
// costs nothing however far away the end is.
void DrawStroke(cv::Mat* canvas, const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
                const Stroke& stroke);
void DrawLine(cv::Mat* canvas, const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
              const cv::Scalar& color, double width_px, double dash_px = 0.0);

// A filled mark with a rim: a square for the right side, else a disc.
struct MarkStyle {
  cv::Scalar color;
  double radius_px = 3.0;  // without the rim
  double rim_px = 1.0;
  cv::Scalar rim_color = palette::kInk;
};
void DrawMark(cv::Mat* canvas, const Eigen::Vector2d& center_px, Side side, const MarkStyle& style);

void FillTriangle(cv::Mat* canvas, const std::array<Eigen::Vector2d, 3>& corners_px,
                  const cv::Scalar& color);

// A hollow circle with an ink rim on both sides; dashed ones have three gaps.
void DrawRing(cv::Mat* canvas, const Eigen::Vector2d& center_px, double radius_px,
              const cv::Scalar& color, double width_px, bool dashed);

// One line of ASCII; others become '?'. at_px is the middle of its height and,
// by anchor, its left end (0), middle (0.5) or right end (1).
struct TextStyle {
  cv::Scalar color = palette::kInk;
  double height_px = 12.0;  // of a capital letter
  double anchor = 0.0;
  bool outlined = false;  // with ink behind it
};
void DrawText(cv::Mat* canvas, const Eigen::Vector2d& at_px, const std::string& text,
              const TextStyle& style);
double TextWidth(const std::string& text, double height_px);

// 1.75 -> "1.8", with this many digits after the point.
std::string Fixed(double value, int digits);

}  // namespace poselift
