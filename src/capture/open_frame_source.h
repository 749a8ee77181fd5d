// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <string>

#include "src/capture/live_frame_source.h"
#include "src/io/frame_source.h"

namespace poselift {

struct FrameSourceOptions {
  Pictures pictures = Pictures::kBgr;
  double folder_rate_hz = 1.0;  // of the pictures of a folder
  LiveOptions live;             // of a camera; its pictures are those above
};

enum class SourceKind { kCamera, kVideo, kFolder, kImage };

// What a user means by a name: a camera for a device (/dev/video0, /dev/v4l/by-id/..., or 0
// for short, where no file has that name), else by what the file is. Throws InputError for
// what is none of these.
SourceKind KindOfSource(const std::string& name);
// The device: "0" is /dev/video0.
std::string DevicePath(const std::string& name);

// A camera is a LiveFrameSource, a single picture a source of one frame.
std::unique_ptr<FrameSource> OpenFrameSource(const std::string& name,
                                             const FrameSourceOptions& options = {},
                                             SystemCalls* system = RealSystem());

}  // namespace poselift
