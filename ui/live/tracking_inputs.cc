// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/tracking_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "lift/tracking/tag_cost.h"
#include "src/capture/live_frame_source.h"
#include "src/capture/open_frame_source.h"
#include "src/capture/paced_frame_source.h"
#include "src/input_error.h"
#include "src/io/camera_file.h"
#include "src/io/image_folder.h"
#include "src/io/video.h"
#include "src/level_camera.h"

namespace poselift {

TrackingModels ReadModels(const TrackingInputs& inputs) {
  namespace fs = std::filesystem;
  Dictionary dictionary = ReadDictionary(inputs.dictionary.empty() ? DefaultDictionaryPath()
                                                                   : fs::path(inputs.dictionary));
  MotionCodebook codebook = ReadMotionCodebook(
      inputs.motion_model.empty() ? DefaultMotionModelPath() : fs::path(inputs.motion_model));
  return {std::move(dictionary), std::make_shared<const MotionCodebook>(WithMirrored(codebook))};
}

std::unique_ptr<FrameSource> OpenSource(const TrackingInputs& inputs, Pictures pictures,
                                        SystemCalls* system) {
  FrameSourceOptions options{.pictures = pictures, .folder_rate_hz = inputs.folder_rate_hz};
  options.live.camera = inputs.device.Options();
  options.live.keep_encoded = inputs.keep_encoded;
  auto source = OpenFrameSource(inputs.input, options, system);
  if (inputs.realtime && KindOfSource(inputs.input) != SourceKind::kCamera)
    source = std::make_unique<PacedFrameSource>(std::move(source));
  return source;
}

double FrameTime_s(const TrackingInputs& inputs, const FrameSource& source) {
  constexpr double kShortest_s = 1e-3, kLongest_s = 1.0;
  if (const auto* const live = dynamic_cast<const LiveFrameSource*>(&source);
      live && live->camera().given().rate_hz > 0.0)
    return 1.0 / live->camera().given().rate_hz;
  const SourceKind kind = KindOfSource(inputs.input);
  if (kind == SourceKind::kCamera) return 1.0 / inputs.device.rate_hz;
  if (kind == SourceKind::kFolder) return 1.0 / inputs.folder_rate_hz;
  const auto probe = OpenFrameSource(inputs.input, {.pictures = Pictures::kGrey});
  const auto first_s = probe->Skip_s(), second_s = probe->Skip_s();
  if (!first_s || !second_s) return 1.0 / inputs.device.rate_hz;
  return std::clamp(*second_s - *first_s, kShortest_s, kLongest_s);
}

int64_t NumFrames(const TrackingInputs& inputs) {
  switch (KindOfSource(inputs.input)) {
    case SourceKind::kVideo:
      return VideoFile(inputs.input, Pictures::kGrey).stated_frames();
    case SourceKind::kFolder:
      return std::ssize(ImageFolder(inputs.input, 1.0, Pictures::kGrey).files());
    default:
      return 0;
  }
}

Camera CameraOf(const TrackingInputs& inputs, cv::Size size_px) {
  if (inputs.camera.empty())
    return UncalibratedCamera(
        size_px.width, size_px.height,
        inputs.focal_px > 0.0 ? inputs.focal_px : FocalLength_px(inputs.fov_deg, size_px.width));
  return AtSize(ReadCamera(inputs.camera), size_px.width, size_px.height, inputs.camera);
}

double DepthSigma(const TrackingInputs& inputs) {
  constexpr double kWeak_deg = 2.0;
  if (!inputs.camera.empty()) return 0.0;
  return inputs.focal_px <= 0.0 && inputs.fov_deg < kWeak_deg ? kWeakDepthSigma
                                                              : kGuessedDepthSigma;
}

Eigen::Quaterniond CamFromWorld(const TrackingInputs& inputs) {
  constexpr double kRad = std::numbers::pi / 180.0;
  return Eigen::AngleAxisd(-kRad * inputs.roll_deg, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(kRad * inputs.pitch_deg, Eigen::Vector3d::UnitX()) * kLevelFromCam;
}

}  // namespace poselift
