// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "lift/temporal/online_smoother.h"
#include "src/skeleton.h"

namespace poselift::cli {

struct StreamOptions {
  std::optional<int> person_id;        // else the first that is seen
  std::optional<double> frame_time_s;  // instead of the frames' times
  OnlineSmootherOptions online;
};

struct StreamReport {
  long num_frames = 0;
  long num_filled = 0;
  long num_unknown = 0;
};

// One person of lifted poses, smoothed as they arrive: JSON lines in, a frame of
// poses.json each, and out, options.online.latency_s later. Memory does not grow.
// Throws InputError with the line for one that is no frame, has no time or goes
// back in time, and when `out` cannot be written.
StreamReport SmoothStream(std::istream& in, const std::string& name, const Skeleton& skeleton,
                          std::shared_ptr<const MotionCodebook> codebook,
                          const StreamOptions& options, std::ostream& out);

// kStandardStream stands for standard input and output. A file grows line by line
// as out.part and has its own name when all is done.
inline constexpr std::string_view kStandardStream = "-";
StreamReport SmoothStreamFiles(const std::string& in, const std::string& out,
                               const Skeleton& skeleton,
                               std::shared_ptr<const MotionCodebook> codebook,
                               const StreamOptions& options);

}  // namespace poselift::cli
