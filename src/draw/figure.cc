// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/figure.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "src/draw/style.h"
#include "src/joints.h"

namespace poselift {
namespace {

using Eigen::Vector2d;

// How near a joint is, 0 the farthest to 1 the nearest. A flat pose is not
// stretched over the whole range: its noise would look like depth.
class Nearness {
 public:
  explicit Nearness(const Pose3& joints_in_px) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (int j = 0; j < joints_in_px.cols(); ++j) {
      if (!IsDrawable(joints_in_px.col(j))) continue;
      nearest = std::min(nearest, joints_in_px(2, j));
      farthest = std::max(farthest, joints_in_px(2, j));
    }
    middle_px_ = 0.5 * (nearest + farthest);
    range_px_ = std::max({farthest - nearest, 0.4 * FigureExtent(joints_in_px), 1.0});
  }
  double operator()(double depth_px) const {
    return std::clamp(0.5 - (depth_px - middle_px_) / range_px_, 0.0, 1.0);
  }

 private:
  double middle_px_ = 0.0;
  double range_px_ = 1.0;
};

double WidthFactor(double nearness) { return 0.6 + 0.8 * nearness; }

cv::Scalar Faded(const cv::Scalar& color, double nearness) {
  return Mixed(color, palette::kFar, 0.45 * (1.0 - nearness));
}

cv::Scalar FadedInk(double nearness) {
  return Mixed(palette::kInk, palette::kFarInk, 1.0 - nearness);
}

double RimWidth(const FigureStyle& style) { return std::max(1.0, 0.22 * style.bone_width_px); }

// A bone is the joint at its end; the dot of that joint is drawn apart.
struct Item {
  double depth_px;
  int joint;
  bool is_bone;
};

bool HasBone(const Pose3& joints_in_px, int j) {
  const int parent = Joints()[j].parent;
  return parent >= 0 && IsDrawable(joints_in_px.col(j)) && IsDrawable(joints_in_px.col(parent));
}

// Far to near. A dot lies over the bones that meet in it.
std::vector<Item> PaintersOrder(const Pose3& joints_in_px) {
  std::vector<Item> items;
  std::vector<double> dot_depth_px(kNumJoints);
  for (int j = 0; j < kNumJoints; ++j) dot_depth_px[j] = joints_in_px(2, j);
  for (int j = 0; j < kNumJoints; ++j) {
    if (!HasBone(joints_in_px, j)) continue;
    const int parent = Joints()[j].parent;
    const double depth_px = 0.5 * (joints_in_px(2, j) + joints_in_px(2, parent));
    items.push_back({depth_px, j, true});
    for (const int end : {j, parent}) dot_depth_px[end] = std::min(dot_depth_px[end], depth_px);
  }
  for (int j = 0; j < kNumJoints; ++j)
    if (IsDrawable(joints_in_px.col(j))) items.push_back({dot_depth_px[j], j, false});
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.depth_px > b.depth_px; });
  return items;
}

void DrawBone(cv::Mat* canvas, const Pose3& joints_in_px, int j, const Nearness& nearness,
              const FigureStyle& style) {
  const int parent = Joints()[j].parent;
  const Vector2d from_px = joints_in_px.col(parent).head<2>(),
                 to_px = joints_in_px.col(j).head<2>();
  const double near_from = nearness(joints_in_px(2, parent)),
               near_to = nearness(joints_in_px(2, j)), near = 0.5 * (near_from + near_to);
  const double from_width = style.bone_width_px * WidthFactor(near_from),
               to_width = style.bone_width_px * WidthFactor(near_to);
  const double rims_px = 2.0 * RimWidth(style);
  const Side side = SideOf(j);
  DrawStroke(canvas, from_px, to_px, {FadedInk(near), from_width + rims_px, to_width + rims_px});
  const double dash_px = side == Side::kRight ? 1.9 * style.bone_width_px : 0.0;
  DrawStroke(canvas, from_px, to_px, {Faded(ColorOf(side), near), from_width, to_width, dash_px});
}

void DrawJoint(cv::Mat* canvas, const Pose3& joints_in_px, int j, const Nearness& nearness,
               const FigureStyle& style) {
  const double near = nearness(joints_in_px(2, j));
  const double radius_px = 0.72 * style.bone_width_px * WidthFactor(near);
  const Side side = SideOf(j);
  DrawMark(canvas, joints_in_px.col(j).head<2>(), side,
           {Faded(ColorOf(side), near), radius_px, RimWidth(style), FadedInk(near)});
}

// Beyond the end of the limb, as far as it is labelled.
void DrawSideLetters(cv::Mat* canvas, const Pose3& joints_in_px, const FigureStyle& style) {
  using namespace joint;  // NOLINT(google-build-using-namespace)
  for (const int end : {kLeftHand, kRightHand, kLeftFoot, kRightFoot}) {
    const int parent = Joints()[end].parent;
    const int tip = IsDrawable(joints_in_px.col(end)) ? end : parent;
    const int before = Joints()[tip].parent;
    if (!HasBone(joints_in_px, tip)) continue;
    Vector2d along = (joints_in_px.col(tip) - joints_in_px.col(before)).head<2>();
    // A foot that points at the camera: the letter goes below it.
    along = along.norm() > 1.0 ? along.normalized() : Vector2d::UnitY();
    const double gap_px = 1.2 * style.letter_height_px + style.bone_width_px;
    const bool is_left = SideOf(tip) == Side::kLeft;
    DrawText(canvas, joints_in_px.col(tip).head<2>() + gap_px * along, is_left ? "L" : "R",
             {ColorOf(SideOf(tip)), style.letter_height_px, 0.5, true});
  }
}

}  // namespace

void DrawFigure(cv::Mat* canvas, const Pose3& joints_in_px, const FigureStyle& style) {
  const Nearness nearness(joints_in_px);
  for (const Item& item : PaintersOrder(joints_in_px)) {
    const auto draw = item.is_bone ? DrawBone : DrawJoint;
    draw(canvas, joints_in_px, item.joint, nearness, style);
  }
  if (style.letter_height_px > 0.0) DrawSideLetters(canvas, joints_in_px, style);
}

void DrawBones(cv::Mat* canvas, const Pose3& joints_in_px, const cv::Scalar& color,
               double width_px) {
  for (int j = 0; j < kNumJoints; ++j) {
    if (!HasBone(joints_in_px, j)) continue;
    DrawLine(canvas, joints_in_px.col(Joints()[j].parent).head<2>(), joints_in_px.col(j).head<2>(),
             color, width_px);
  }
}

double FigureExtent(const Pose3& joints_in_px) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vector2d low(kInfinity, kInfinity), high(-kInfinity, -kInfinity);
  for (int j = 0; j < joints_in_px.cols(); ++j) {
    if (!IsDrawable(joints_in_px.col(j))) continue;
    low = low.cwiseMin(joints_in_px.col(j).head<2>());
    high = high.cwiseMax(joints_in_px.col(j).head<2>());
  }
  return std::max(0.0, (high - low).maxCoeff());
}

}  // namespace poselift
