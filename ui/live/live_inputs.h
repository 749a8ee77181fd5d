// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "lift/lift_photo.h"
#include "src/capture/system_calls.h"
#include "ui/live/live_session.h"
#include "ui/live/tracking_inputs.h"

namespace poselift {

// What somebody says who wants to watch: a camera, a video or a folder; with tags the person who
// wears them is tracked.
struct LiveInputs {
  TrackingInputs view;
  std::string tags;  // tags.toml; empty: pictures alone
};

// Throws InputError for a file that is not there, and a camera file or a tags file that cannot be
// read: sooner than OpenLive.
void CheckFiles(const LiveInputs& inputs);

// Files are played at their own speed. lifter must outlive what comes. Throws InputError.
LiveParts OpenLive(LiveInputs inputs, const PhotoLifter& lifter,
                   SystemCalls* system = RealSystem());

}  // namespace poselift
