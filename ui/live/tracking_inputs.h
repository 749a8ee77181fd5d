// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/types.hpp>
#include <string>

#include "lift/dictionary.h"
#include "lift/temporal/motion_codebook.h"
#include "src/camera.h"
#include "src/capture/system_calls.h"
#include "src/io/frame_source.h"
#include "ui/live/camera_choice.h"

namespace poselift {

// What commands that look at tags take: pictures from somewhere, and the camera they come from.
struct TrackingInputs {
  std::string input;
  std::string camera;
  double fov_deg = 60.0;                   // horizontal, of a camera that nobody calibrated
  double focal_px = 0.0;                   // or, where it is said, this
  double pitch_deg = 0.0, roll_deg = 0.0;  // how the camera leans: down, and clockwise
  CameraChoice device;
  double folder_rate_hz = 30.0;
  bool realtime = false;
  bool keep_encoded = false;
  std::string dictionary, motion_model;
};

// What is learned: the models that ship, unless others are named; with mirror images.
struct TrackingModels {
  Dictionary dictionary;
  std::shared_ptr<const MotionCodebook> codebook;
};
TrackingModels ReadModels(const TrackingInputs& inputs);

// Throws InputError for a source that cannot be opened.
std::unique_ptr<FrameSource> OpenSource(const TrackingInputs& inputs,
                                        Pictures pictures = Pictures::kGrey,
                                        SystemCalls* system = RealSystem());

// About how far apart its frames are: what the camera gave, --fps of a folder, the first two of a
// video.
double FrameTime_s(const TrackingInputs& inputs, const FrameSource& source);

// How many frames come, by what the container states of a video; 0 where nobody knows.
int64_t NumFrames(const TrackingInputs& inputs);

// The camera file, at the size of the pictures; without one a camera of fov_deg without
// distortion. Throws InputError for a camera of another shape than the pictures'.
Camera CameraOf(const TrackingInputs& inputs, cv::Size size_px);

// How far depths behind the body's may be off (TagSigmas): not, where the camera is known.
double DepthSigma(const TrackingInputs& inputs);

// How the camera stands, in a world whose y is up.
Eigen::Quaterniond CamFromWorld(const TrackingInputs& inputs);

}  // namespace poselift
