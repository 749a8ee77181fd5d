// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include "src/io/camera_formats.h"
#include "src/io/yaml_value.h"

namespace poselift {
namespace {

std::vector<double> NumbersOf(const YamlValue& camera, const char* key, size_t count) {
  const YamlValue list = camera.At(key);
  const std::vector<double> numbers = list.Numbers();
  if (numbers.size() != count)
    throw list.Error(fmt::format("found {} numbers, wanted {}", numbers.size(), count));
  return numbers;
}

// k1 k2 p1 p2, as OpenCV has them.
Distortion DistortionOf(const YamlValue& camera) {
  const auto model = camera.Find("distortion_model");
  if (!model || model->String() == "none") return {};
  if (model->String() != "radtan")
    throw model->Unwanted("radtan: the lens models equidistant, fov and others are not known here");
  const std::vector<double> k = NumbersOf(camera, "distortion_coeffs", 4);
  return {.k1 = k[0], .k2 = k[1], .p1 = k[2], .p2 = k[3]};
}

Camera CameraOf(const YamlValue& value) {
  const YamlValue model = value.At("camera_model");
  if (model.String() != "pinhole")
    throw model.Unwanted("pinhole: the camera models omni, eucm, ds and others are not known here");
  const std::vector<double> f = NumbersOf(value, "intrinsics", 4);
  const std::vector<YamlValue> resolution = value.At("resolution").Items();
  if (resolution.size() != 2)
    throw value.At("resolution")
        .Error(fmt::format("found {} numbers, wanted 2", resolution.size()));
  Camera camera;
  camera.width_px = resolution[0].Integer(1, 1000000);
  camera.height_px = resolution[1].Integer(1, 1000000);
  camera.fx_px = f[0];
  camera.fy_px = f[1];
  camera.cx_px = f[2];
  camera.cy_px = f[3];
  camera.distortion = DistortionOf(value);
  if (const std::string flaw = camera.Validate(); !flaw.empty()) throw value.Error(flaw);
  return camera;
}

}  // namespace

CameraList ReadKalibrCameras(const std::filesystem::path& path, const std::string& wanted) {
  const YamlDocument document(path);
  const YamlValue root = document.root();
  CameraList list;
  for (const std::string& key : root.Keys())
    if (key.starts_with("cam")) list.names.push_back(key);
  if (list.names.empty()) throw root.Error("found no cam0, wanted a camchain of Kalibr");
  const std::string& name = list.names[FindCameraName(path, list.names, wanted)];
  list.chosen = {name, CameraOf(root.At(name))};
  return list;
}

}  // namespace poselift
