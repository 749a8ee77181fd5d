// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>

#include "src/capture/open_frame_source.h"
#include "ui/live/tracking_inputs.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace poselift::cli {

// INPUT and all that follows.
void AddTrackingInputs(CLI::App* command, TrackingInputs* inputs);

// What is said of the camera and its place, for those who have an INPUT of their own.
void AddViewOptions(CLI::App* command, TrackingInputs* inputs);
// Of them those that say nothing of such an input are wrong usage. What the input is; nothing
// where it is not there.
std::optional<SourceKind> RefuseViewOptions(const CLI::App& command, const TrackingInputs& inputs);

}  // namespace poselift::cli
