// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lift/person_stream.h"

namespace poselift::cli {

struct StreamReport {
  long num_frames = 0;
  long num_filled = 0;
  long num_unknown = 0;
};

// kStandardStream stands for standard input and output. A file grows line by line
// as out.part and has its own name when all is done.
inline constexpr std::string_view kStandardStream = "-";

// JSON lines in, a frame of poses.json each, and out, as late as the stream is.
// frame_time_s: instead of the frames' times. Throws InputError with the line for one
// that is no frame, has no time or goes back in time, and when `out` cannot be written.
StreamReport SmoothLines(const std::string& in, const std::string& out,
                         const std::optional<double>& frame_time_s, PersonStream* stream);

}  // namespace poselift::cli
