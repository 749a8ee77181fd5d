// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/pose_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "src/draw/figure.h"
#include "src/draw/scene.h"
#include "src/draw/style.h"
#include "src/joints.h"

namespace poselift {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// What is drawn in a panel, in parts of its side.
constexpr double kText = 0.021, kMargin = 0.07, kTitleRow = 0.07, kBoneWidth = 0.0125;
const cv::Scalar kFacing(112, 108, 104), kPlumb(150, 150, 150), kFrame(150, 150, 150);

struct Box {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;

  void Include(const Pose3& joints_in_px) {
    for (int j = 0; j < joints_in_px.cols(); ++j) {
      if (joints_in_px.col(j).hasNaN()) continue;
      low = low.cwiseMin(joints_in_px.col(j).head<2>());
      high = high.cwiseMax(joints_in_px.col(j).head<2>());
    }
  }
  bool IsEmpty() const { return !(low.x() <= high.x()); }
};

Box ContentBox(const Scene& scene, const Projection& projection) {
  Box box;
  box.Include(projection(scene.joints_in_cam_m));
  box.Include(projection(scene.Shadow()));
  for (const Pose3& other : scene.others_in_cam_m) box.Include(projection(other));
  if (box.IsEmpty()) box.Include(projection(Pose3(scene.center_in_cam_m)));
  return box;
}

// One scale for all panels, so that they can be compared by eye.
std::vector<Projection> FittedProjections(const Scene& scene, int panel_px) {
  std::vector<Projection> projections;
  std::vector<Box> boxes_m;
  Vector2d largest_m = Vector2d::Constant(scene.radius_m * 0.5);
  for (const View& view : StandardViews(scene)) {
    projections.push_back({view, scene.center_in_cam_m});
    boxes_m.push_back(ContentBox(scene, projections.back()));
    largest_m = largest_m.cwiseMax(boxes_m.back().high - boxes_m.back().low);
  }
  const Vector2d room_px =
      panel_px * Vector2d(1.0 - 2.0 * kMargin, 1.0 - 2.0 * kMargin - 2.0 * kTitleRow);
  const double scale = (room_px.array() / largest_m.array()).minCoeff();
  for (size_t i = 0; i < projections.size(); ++i) {
    projections[i].scale_px_per_m = scale;
    projections[i].offset_px =
        Vector2d::Constant(0.5 * panel_px) - 0.5 * scale * (boxes_m[i].low + boxes_m[i].high);
  }
  return projections;
}

void DrawGrid(cv::Mat* panel, const Scene& scene, const Projection& projection) {
  const double step_m = scene.grid_step_m;
  const int lines = static_cast<int>(std::ceil(1.7 * scene.radius_m / step_m));
  const double reach_m = lines * step_m;
  const double width_px = std::max(1.2, 0.003 * panel->rows);
  for (const bool metre : {false, true}) {
    for (int i = -lines; i <= lines; ++i) {
      if ((i % 2 == 0) != metre) continue;
      const cv::Scalar& color = metre ? palette::kMetre : palette::kGrid;
      for (const auto& [across, along] :
           {std::pair(scene.right, scene.away), std::pair(scene.away, scene.right)}) {
        const Vector3d middle = scene.base_in_cam_m + i * step_m * across;
        DrawLine(panel, projection.Flat(middle - reach_m * along),
                 projection.Flat(middle + reach_m * along), color, width_px);
      }
    }
  }
}

// A triangle on the floor before the pelvis: where the body faces.
void DrawFacing(cv::Mat* panel, const Scene& scene, const Projection& projection) {
  using namespace joint;  // NOLINT(google-build-using-namespace)
  const Pose3& joints = scene.joints_in_cam_m;
  const Vector3d left = joints.col(kLeftHip) - joints.col(kRightHip);
  const Vector3d spine = joints.col(kThorax) - joints.col(kPelvis);
  const Vector3d facing = left.cross(spine).normalized();
  const Vector3d level = facing - facing.dot(scene.up) * scene.up;
  if (!(level.norm() > 0.3)) return;
  const Vector3d ahead = level.normalized(), across = ahead.cross(scene.up);
  const double size_m = 0.12 * scene.radius_m;
  const Vector3d tip = scene.base_in_cam_m + 3.5 * size_m * ahead;
  FillTriangle(panel,
               {projection.Flat(tip), projection.Flat(tip - size_m * (ahead + 0.7 * across)),
                projection.Flat(tip - size_m * (ahead - 0.7 * across))},
               kFacing);
}

void DrawPlumbLines(cv::Mat* panel, const Scene& scene, const Projection& projection) {
  using namespace joint;  // NOLINT(google-build-using-namespace)
  const double width_px = std::max(1.2, 0.0028 * panel->rows);
  for (const int j : {kPelvis, kLeftHand, kRightHand, kLeftFoot, kRightFoot}) {
    const Vector3d x = scene.joints_in_cam_m.col(j);
    if (x.hasNaN()) continue;
    const Vector2d foot_px = projection.Flat(scene.OnFloor(x));
    DrawLine(panel, projection.Flat(x), foot_px, kPlumb, width_px, 0.011 * panel->rows);
    DrawMark(panel, foot_px, SideOf(j), {ColorOf(SideOf(j)), 2.0 * width_px, 0.6 * width_px});
  }
}

// At the edge of the panel, where the camera stands; none when it looks along
// the viewer's own sight.
void DrawCameraArrow(cv::Mat* panel, const Scene& scene, const Projection& projection) {
  const Vector2d away = (projection.view.view_from_cam * scene.away).head<2>();
  if (away.norm() < 0.3) return;
  const double side_px = panel->rows, width_px = 0.006 * side_px;
  const Vector2d along = away.normalized(), across(-along.y(), along.x());
  const Vector2d start_px = Vector2d::Constant(0.5 * side_px) - 0.46 * side_px * along;
  const Vector2d tip_px = start_px + 0.09 * side_px * along;
  DrawLine(panel, start_px, tip_px, palette::kInk, width_px);
  for (const double sign : {-1.0, 1.0})
    DrawLine(panel, tip_px, tip_px + 0.022 * side_px * (sign * across - along), palette::kInk,
             width_px);
  const bool upright = std::abs(along.y()) > 0.7;
  DrawText(panel,
           start_px + (upright ? Vector2d(0.03 * side_px, 0.0) : Vector2d(0.0, 0.035 * side_px)),
           "camera", {palette::kInk, kText * side_px});
}

void DrawScaleBar(cv::Mat* panel, const Scene& scene, const Projection& projection) {
  const double side_px = panel->rows;
  const Vector2d end_px(side_px * 0.96, side_px * 0.95);
  const Vector2d start_px = end_px - Vector2d(scene.grid_step_m * projection.scale_px_per_m, 0.0);
  const Vector2d tick(0.0, 0.009 * side_px);
  for (const auto& [from, to] : {std::pair<Vector2d, Vector2d>(start_px, end_px),
                                 std::pair<Vector2d, Vector2d>(start_px - tick, start_px + tick),
                                 std::pair<Vector2d, Vector2d>(end_px - tick, end_px + tick)})
    DrawLine(panel, from, to, palette::kInk, std::max(1.5, 0.004 * side_px));
  DrawText(panel, 0.5 * (start_px + end_px) - Vector2d(0.0, 0.03 * side_px),
           Fixed(scene.grid_step_m, scene.grid_step_m < 1.0 ? 1 : 0) + " m",
           {palette::kInk, kText * side_px, 0.5});
}

void DrawPanel(cv::Mat* panel, const Scene& scene, const Projection& projection) {
  const double side_px = panel->rows;
  DrawGrid(panel, scene, projection);
  if (projection.view.eye_distance_m > 0.0) {  // from above the body covers them
    DrawBones(panel, projection(scene.Shadow()), palette::kShadow, 0.016 * side_px);
    DrawPlumbLines(panel, scene, projection);
  }
  DrawFacing(panel, scene, projection);
  for (const Pose3& other : scene.others_in_cam_m)
    DrawBones(panel, projection(other), palette::kGhost, 0.005 * side_px);
  DrawFigure(panel, projection(scene.joints_in_cam_m), {kBoneWidth * side_px, kText * side_px});
  DrawCameraArrow(panel, scene, projection);
  DrawScaleBar(panel, scene, projection);
  DrawText(panel, {0.03 * side_px, 0.04 * side_px}, projection.view.title,
           {palette::kInk, 1.15 * kText * side_px});
}

std::string Alternatives(const Scene& scene) {
  const size_t count = scene.others_in_cam_m.size();
  if (count == 0) return {};
  return "grey: " + std::to_string(count) + (count == 1 ? " alternative" : " alternatives");
}

// Writes from right to left: each sample stands left of its text.
class Legend {
 public:
  Legend(cv::Mat* header, double text_px)
      : header_(header), text_px_(text_px), right_px_(header->cols - 1.5 * text_px) {}

  void AddText(const std::string& text) {
    DrawText(header_, {right_px_, Middle()}, text, {palette::kInk, text_px_, 1.0});
    right_px_ -= TextWidth(text, text_px_) + 0.8 * text_px_;
  }
  void AddBone(Side side, double length_px, double width_px) {
    const Vector2d end(right_px_, Middle()), start(right_px_ - length_px, Middle());
    DrawLine(header_, start, end, palette::kInk, width_px + 3.0);
    DrawLine(header_, start, end, ColorOf(side), width_px,
             side == Side::kRight ? 1.5 * width_px : 0.0);
    Skip(length_px);
  }
  void AddTriangle() {
    const Vector2d tip(right_px_ - 0.5 * text_px_, Middle() - 0.5 * text_px_);
    FillTriangle(header_,
                 {tip, tip + text_px_ * Vector2d(0.5, 1.0), tip + text_px_ * Vector2d(-0.5, 1.0)},
                 kFacing);
    Skip(text_px_);
  }
  double LeftEnd() const { return right_px_; }

 private:
  double Middle() const { return 0.5 * header_->rows; }
  void Skip(double width_px) { right_px_ -= width_px + 1.8 * text_px_; }

  cv::Mat* header_;
  double text_px_;
  double right_px_;
};

// The title at the left; what the marks mean at the right.
void DrawHeader(cv::Mat* header, const Scene& scene, const std::string& title, int panel_px) {
  const double text_px = kText * panel_px, width_px = kBoneWidth * panel_px;
  Legend legend(header, text_px);
  legend.AddText(Alternatives(scene));
  legend.AddText("body faces");
  legend.AddTriangle();
  for (const Side side : {Side::kRight, Side::kLeft}) {
    legend.AddText(side == Side::kLeft ? "left" : "right");
    legend.AddBone(side, 0.08 * panel_px, width_px);
  }
  cv::Mat left = header->colRange(0, std::max(1, static_cast<int>(legend.LeftEnd())));
  DrawText(&left, {0.03 * panel_px, 0.5 * header->rows}, title, {palette::kInk, 1.15 * text_px});
}

void Check(const PoseViewInput& input, const PoseViewOptions& options) {
  bool well_formed = input.joints_in_cam_m.cols() == kNumJoints;
  for (const Pose3& other : input.alternatives_in_cam_m) well_formed &= other.cols() == kNumJoints;
  if (!well_formed) throw std::invalid_argument("DrawPoseView: wanted 23 joints");
  if (!IsDrawable(input.up_in_cam) || !(input.up_in_cam.norm() > 0.0))
    throw std::invalid_argument("DrawPoseView: `up` has no direction");
  if (const std::string wrong = options.Validate(); !wrong.empty())
    throw std::invalid_argument("DrawPoseView: " + wrong);
}

}  // namespace

std::string PoseViewOptions::Validate() const {
  if (panel_px < 160 || panel_px > 4000)
    return "panel_px = " + std::to_string(panel_px) + ", wanted 160 to 4000";
  return {};
}

cv::Mat DrawPoseView(const PoseViewInput& input, const PoseViewOptions& options) {
  Check(input, options);
  const Scene scene =
      MakeScene(input.joints_in_cam_m, input.alternatives_in_cam_m, input.up_in_cam);
  const int panel_px = options.panel_px, header_px = cvRound(kTitleRow * panel_px);
  cv::Mat sheet(2 * panel_px + header_px, 2 * panel_px, CV_8UC3, palette::kPaper);
  const std::vector<Projection> projections = FittedProjections(scene, panel_px);
  for (int i = 0; i < 4; ++i) {
    cv::Mat panel =
        sheet(cv::Rect(i % 2 * panel_px, header_px + i / 2 * panel_px, panel_px, panel_px));
    DrawPanel(&panel, scene, projections[i]);
  }
  const double right_px = 2.0 * panel_px, bottom_px = sheet.rows;
  for (const double y_px : {0.0 + header_px, 0.0 + header_px + panel_px})
    DrawLine(&sheet, {0.0, y_px}, {right_px, y_px}, kFrame, 1.5);
  DrawLine(&sheet, {0.5 * right_px, 0.0 + header_px}, {0.5 * right_px, bottom_px}, kFrame, 1.5);
  cv::Mat header = sheet.rowRange(0, header_px);
  DrawHeader(&header, scene, input.title, panel_px);
  return sheet;
}

Scene PoseStage(const PoseViewInput& input) {
  return MakeScene(input.joints_in_cam_m, input.alternatives_in_cam_m, input.up_in_cam);
}

Projection PoseProjection(const Scene& stage, const PoseOrbit& orbit, int side_px) {
  return {OrbitView(stage, orbit.yaw_rad, orbit.pitch_rad), stage.center_in_cam_m,
          orbit.zoom * side_px / (2.5 * stage.radius_m), Vector2d::Constant(0.5 * side_px)};
}

cv::Mat DrawPoseFrom(const PoseViewInput& input, const PoseOrbit& orbit, int side_px,
                     const Scene* stage) {
  Check(input, {.panel_px = side_px});
  Scene scene = PoseStage(input);
  if (stage) {
    Scene held = *stage;
    held.joints_in_cam_m = scene.joints_in_cam_m;
    held.others_in_cam_m = scene.others_in_cam_m;
    scene = std::move(held);
  }
  cv::Mat panel(side_px, side_px, CV_8UC3, palette::kPaper);
  Projection projection = PoseProjection(scene, orbit, side_px);
  projection.view.title = input.title;
  DrawPanel(&panel, scene, projection);
  return panel;
}

}  // namespace poselift
