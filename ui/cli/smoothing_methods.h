// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lift/baselines/one_euro.h"
#include "lift/baselines/savitzky_golay.h"
#include "lift/smooth_motion.h"
#include "lift/temporal/online_smoother.h"
#include "src/motion.h"

namespace poselift::cli {

// Options of all methods; each takes its own.
struct SmoothingOptions {
  std::optional<double> cutoff_hz;  // else 6 Hz, less for slow cameras
  SavitzkyGolayOptions savitzky_golay;
  OneEuroOptions one_euro;
  MotionFilterOptions online;
  std::string motion_model;  // file; empty: the one that ships
};

// That of the options, with its mirror images.
std::shared_ptr<const MotionCodebook> ReadCodebook(const SmoothingOptions& options);

struct Smoothing {
  MotionSmoother smoother;
  std::string summary;  // what it does, with its numbers, for the report
};

// A row for each method; the first is the default.
struct SmoothingMethod {
  std::string_view name;
  std::string_view about;  // for --help
  Smoothing (*make)(const Motion& motion, const SmoothingOptions& options);
};

std::span<const SmoothingMethod> SmoothingMethods();
inline constexpr std::string_view kOnlineMethod = "online";

}  // namespace poselift::cli
