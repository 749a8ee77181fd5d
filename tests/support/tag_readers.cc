// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/reader_tables.h"

#include <cmath>

#include "calib/april_grid_yaml.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_file.h"
#include "src/io/camera_yaml.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKalibrText = R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]
  distortion_model: radtan
  intrinsics: [458.6, 457.3, 367.2, 248.4]
  resolution: [752, 480]
cam1:
  T_cn_cnm1:
  - [0.99, 0.0, 0.0, -0.11]
  camera_model: pinhole
  distortion_model: none
  distortion_coeffs: []
  intrinsics: [457.5, 456.1, 379.9, 255.2]
  resolution: [752, 480]
)";

constexpr const char* kAniposeText = R"([cam_1]
name = "B"
size = [ 1280, 720,]
matrix = [ [ 900.5, 0.0, 639.5,], [ 0.0, 901.0, 359.5,], [ 0.0, 0.0, 1.0,],]
distortions = [ -0.1, 0.02, 0.001, -0.002, 0.003,]
rotation = [ 0.1, 0.2, 0.3,]

[metadata]
adjusted = false
)";

constexpr const char* kTagsToml = R"(family = "tag25h9"
size_mm = 80

[[tag]]
id = 3
name = "left \"knee\""
joint = "left_knee"
joint_in_tag_mm = [0, -12.5, 60]
joint_sigma_mm = 15

[[tag]]
id = 0
size_mm = 55.5
bone = "left_shin"
position_mm = [10.0, 20, -30]
rotation = [0.0, 1.0, 0.0, 0.0]
rotation_sigma_deg = 4.5

[bone_lengths_mm]
left_knee = 431.25
)";

constexpr const char* kTagsRos = R"(standalone_tags:
  [
    {id: 4, size: 0.08, name: left_wrist},
  ]
tag_bundles:
  - name: left_shin
    layout:
      - {id: 7, size: 0.05, x: 0.1, y: 0.2, z: 0.3, qw: 1, qx: 0, qy: 0, qz: 0}
      - {id: 8, size: 0.05, x: 0, y: 0, z: 0, qw: 0.70710678, qx: 0, qy: 0, qz: 0.70710678}
)";

Camera SomeCamera() { return {640, 480, 650.0, 651.0, 320.25, 240.0, {.k1 = -0.25, .k2 = 0.1}}; }

std::string ReadsCamera(const fs::path& path) {
  for (const std::string& name : CameraNames(path))
    if (std::string flaw = ReadCamera(path, name).Validate(); !flaw.empty()) return flaw;
  return "";
}

std::string ReadsTags(const fs::path& path) {
  for (const BodyTag& tag : ReadBodyTags(path).tags) {
    if (!(tag.size_m > 0.0) || !std::isfinite(tag.size_m)) return "a size";
    if (!tag.on_joint && !tag.on_bone) return "a tag that is nowhere";
    if (tag.on_joint && !tag.on_joint->joint_in_tag_m.allFinite()) return "an offset";
    if (tag.on_bone && !tag.on_bone->bone_from_tag.matrix().allFinite()) return "a place";
  }
  return "";
}

std::string ReadsAprilGrid(const fs::path& path) { return ReadAprilGridYaml(path).Validate(); }

}  // namespace

std::vector<Reader> CameraAndTagReaders() {
  return {
      {"camera_opencv", "opencv.yaml",
       Written("whole.yaml", [](const fs::path& path) { WriteCameraYaml(SomeCamera(), path); }),
       ReadsCamera},
      {"camera_ros", "ros.yaml",
       Written("whole.yaml",
               [](const fs::path& path) { WriteCameraInfoYaml(SomeCamera(), "cam", path); }),
       ReadsCamera},
      {"camera_kalibr", "kalibr.yaml", Text(kKalibrText), ReadsCamera},
      {"camera_anipose", "anipose.toml", Text(kAniposeText), ReadsCamera},
      {"tags", "tags.toml", Text(kTagsToml), ReadsTags},
      {"tags_ros", "tags.yaml", Text(kTagsRos), ReadsTags},
      {"april_grid", "grid.yaml",
       Written("whole.yaml",
               [](const fs::path& path) {
                 WriteAprilGridYaml({4, 5, 0.04, 0.3, 7, "tag36h11"}, path);
               }),
       ReadsAprilGrid},
  };
}

}  // namespace poselift::testing
