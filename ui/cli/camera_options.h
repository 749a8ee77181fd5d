// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "src/io/frame_source.h"
#include "ui/live/camera_choice.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace poselift::cli {

// --size, --rate, --format and --set.
void AddCameraOptions(CLI::App* command, CameraChoice* choice);

// On stderr, of a camera: what it was asked for and what it gave.
void TellCamera(const FrameSource& source);

}  // namespace poselift::cli
