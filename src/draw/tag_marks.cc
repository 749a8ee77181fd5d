// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/tag_marks.h"

#include <algorithm>
#include <string>

#include "src/draw/style.h"

namespace poselift {

void DrawTag(const TagSighting& tag, double size_m, const std::optional<Camera>& camera,
             cv::Mat* picture) {
  const auto& corners_px = tag.detection.corners_px;
  const double edge_px = (corners_px.col(1) - corners_px.col(0)).norm();
  const double width_px = std::clamp(0.03 * edge_px, 1.5, 6.0);
  for (int k = 0; k < 4; ++k)
    DrawLine(picture, corners_px.col(k), corners_px.col((k + 1) % 4), palette::kRight, width_px,
             tag.is_ambiguous ? 4.0 * width_px : 0.0);
  DrawMark(picture, corners_px.col(0), Side::kCentre,
           {.color = palette::kRight, .radius_px = 1.5 * width_px});
  if (camera && !tag.poses.empty()) {
    const Eigen::Isometry3d& cam_from_tag = tag.poses.front().cam_from_tag;
    const Eigen::Vector2d origin_px = camera->Project(cam_from_tag.translation());
    for (int axis = 2; axis >= 0; --axis) {
      const Eigen::Vector3d end_m = 0.5 * size_m * Eigen::Vector3d::Unit(axis);
      const cv::Scalar color(axis == 2 ? 255 : 0, axis == 1 ? 200 : 0, axis == 0 ? 255 : 0);
      DrawLine(picture, origin_px, camera->Project(cam_from_tag * end_m), color, 1.5 * width_px);
    }
  }
  DrawText(picture, corners_px.col(3) + Eigen::Vector2d(0.0, 6.0 * width_px),
           std::to_string(tag.detection.id),
           {.color = palette::kCentre, .height_px = 5.0 * width_px, .outlined = true});
}

}  // namespace poselift
