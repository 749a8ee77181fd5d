// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/lift_camera.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <opencv2/core/types.hpp>

#include "src/input_error.h"
#include "src/io/camera_file.h"
#include "src/io/exif.h"
#include "src/io/image.h"
#include "ui/cli/frame_rate.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

// Of all pictures, as the labels say it or the files do; empty where neither does.
cv::Size SizeOf(const Labels& labels, const std::vector<fs::path>& images) {
  cv::Size size_px;
  for (size_t f = 0; f < labels.frames.size(); ++f) {
    const FrameLabels& frame = labels.frames[f];
    cv::Size of_frame(frame.width_px, frame.height_px);
    if (of_frame.empty() && f < images.size() && !images[f].empty())
      of_frame = ReadImage(images[f]).size();
    if (of_frame.empty()) continue;
    if (!size_px.empty() && size_px != of_frame)
      throw InputError(
          fmt::format("found pictures of {} x {} and {} x {}, wanted one size for one "
                      "camera: lift them apart",
                      size_px.width, size_px.height, of_frame.width, of_frame.height));
    size_px = of_frame;
  }
  return size_px;
}

double ExifFocal_px(const std::vector<fs::path>& images, cv::Size size_px) {
  if (images.empty() || images[0].empty())
    throw InputError("found no picture, wanted one with a focal length in its EXIF (--exif)");
  const auto focal_px = ExifFocalLength_px(images[0], size_px.width, size_px.height);
  if (!focal_px)
    throw InputError(
        images[0], "found no focal length in its EXIF, wanted one, or --fov-deg instead of --exif");
  return *focal_px;
}

}  // namespace

void AddLiftCamera(CLI::App* command, LiftCamera* camera) {
  auto* const file = command->add_option(
      "--camera", camera->file,
      "Camera file (OpenCV, ROS, Kalibr, anipose): lifts in true perspective, without\n"
      "lens distortion");
  auto* const fov = command
                        ->add_option("--fov-deg", camera->fov_deg,
                                     "The same without a file: about how wide the camera sees, "
                                     "horizontally, in degrees")
                        ->check(IsNumber(1.0, 170.0))
                        ->excludes(file);
  auto* const focal =
      command->add_option("--focal-px", camera->focal_px, "Likewise, by its focal length in pixels")
          ->check(IsNumber(1.0, 1e6))
          ->excludes(file)
          ->excludes(fov);
  command
      ->add_flag("--exif", camera->by_exif,
                 "Likewise, by what the camera wrote into the first picture")
      ->excludes(file)
      ->excludes(fov)
      ->excludes(focal);
}

std::optional<Camera> CameraOf(const LiftCamera& said, const Labels& labels,
                               const std::vector<fs::path>& images) {
  const bool has_file = !said.file.empty();
  if (!has_file && !said.fov_deg && !said.focal_px && !said.by_exif) return std::nullopt;
  const cv::Size size_px = SizeOf(labels, images);
  if (has_file) {
    const Camera camera = ReadCamera(said.file);
    return size_px.empty() ? camera : AtSize(camera, size_px.width, size_px.height, said.file);
  }
  if (size_px.empty())
    throw InputError("found no size of the pictures, wanted it in the labels, or the pictures");
  double focal_px = said.focal_px.value_or(0.0);
  if (said.fov_deg) focal_px = FocalLength_px(*said.fov_deg, size_px.width);
  if (said.by_exif) focal_px = ExifFocal_px(images, size_px);
  const Camera camera = UncalibratedCamera(size_px.width, size_px.height, focal_px);
  if (const std::string flaw = camera.Validate(); !flaw.empty()) throw InputError(flaw);
  return camera;
}

}  // namespace poselift::cli
