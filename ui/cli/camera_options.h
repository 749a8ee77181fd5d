// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "src/capture/camera_stream.h"
#include "src/io/frame_source.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace poselift::cli {

// What a user says of the camera's mode and controls, as typed.
struct CameraChoice {
  std::string size = "1280x720";
  double rate_hz = 30.0;
  std::string format;                 // empty: whichever is best
  std::vector<std::string> controls;  // "exposure=50"

  // Throws InputError for text that is none of it.
  CameraOptions Options() const;
};

// --size, --rate, --format and --set.
void AddCameraOptions(CLI::App* command, CameraChoice* choice);

// On stderr, of a camera: what it was asked for and what it gave.
void TellCamera(const FrameSource& source);

}  // namespace poselift::cli
