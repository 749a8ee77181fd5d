// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/io/camera_file.h"
#include "src/units.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

// The angle between what is seen at two places. Left out where the lens model
// shows nothing.
void AddView(const Camera& camera, const char* name, const Eigen::Vector2d& a_px,
             const Eigen::Vector2d& b_px, Json* facts) {
  const Eigen::Vector3d a_in_cam = camera.Undistort(a_px);
  const Eigen::Vector3d b_in_cam = camera.Undistort(b_px);
  const double angle_rad = std::atan2(a_in_cam.cross(b_in_cam).norm(), a_in_cam.dot(b_in_cam));
  if (std::isfinite(angle_rad)) (*facts)[name] = angle_rad * kDegFromRad;
}

}  // namespace

bool IsCamera(const std::filesystem::path& path, std::string_view head) {
  return HasEnding(path, ".yaml") || HasEnding(path, ".yml") ||
         head.find("camera_matrix") != std::string_view::npos ||
         (HasEnding(path, ".toml") && head.find("matrix") != std::string_view::npos);
}

Json DescribeCamera(const std::filesystem::path& path) {
  const std::string first = CameraNames(path).front();
  const Camera camera = ReadCamera(path, first);
  Json facts = {{"format", CameraFileFormatName(FormatOfCameraFile(path))}};
  if (const auto names = CameraNames(path); !names.front().empty()) {
    facts["cameras"] = names;
    facts["camera"] = names.front();
  }
  facts["width_px"] = camera.width_px;
  facts["height_px"] = camera.height_px;
  facts["focal_length_px"] = {camera.fx_px, camera.fy_px};
  facts["principal_point_px"] = {camera.cx_px, camera.cy_px};
  // The edges of the picture; integers are pixel centres.
  AddView(camera, "view_width_deg", {-0.5, camera.cy_px}, {camera.width_px - 0.5, camera.cy_px},
          &facts);
  AddView(camera, "view_height_deg", {camera.cx_px, -0.5}, {camera.cx_px, camera.height_px - 0.5},
          &facts);
  const Distortion& d = camera.distortion;
  facts["distortion"] = {{"k1", d.k1}, {"k2", d.k2}, {"p1", d.p1}, {"p2", d.p2},
                         {"k3", d.k3}, {"k4", d.k4}, {"k5", d.k5}, {"k6", d.k6}};
  return facts;
}

}  // namespace poselift::cli
