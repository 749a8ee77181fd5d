// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/frame_rate.h"

#include <CLI/Error.hpp>
#include <CLI/StringTools.hpp>
#include <CLI/TypeTools.hpp>
#include <CLI/Validators.hpp>
#include <string>

namespace poselift::cli {

CLI::Validator IsFrameRate() {
  constexpr double kLowest_hz = 1e-3, kHighest_hz = 1e6;
  const auto flaw = [](const std::string& text) -> std::string {
    double rate_hz = 0.0;
    const bool is_rate =
        CLI::detail::lexical_cast(text, rate_hz) && rate_hz >= kLowest_hz && rate_hz <= kHighest_hz;
    return is_rate ? "" : "found " + text + ", wanted a rate from 0.001 to 1e6";
  };
  return {flaw, "HZ"};
}

}  // namespace poselift::cli
