// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/frame_rate.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/StringTools.hpp>
#include <CLI/TypeTools.hpp>
#include <CLI/Validators.hpp>
#include <string>

namespace poselift::cli {
namespace {

CLI::Validator InRange(double lowest, double highest, const std::string& kind,
                       const std::string& name) {
  const auto flaw = [=](const std::string& text) -> std::string {
    double value = 0.0;
    const bool is_in_range =
        CLI::detail::lexical_cast(text, value) && value >= lowest && value <= highest;
    return is_in_range
               ? ""
               : fmt::format("found {}, wanted {} from {} to {}", text, kind, lowest, highest);
  };
  return {flaw, name};
}

}  // namespace

CLI::Validator IsNumber(double lowest, double highest) {
  return InRange(lowest, highest, "a number", "NUMBER");
}

CLI::Validator IsFrameRate() { return InRange(1e-3, 1e6, "a rate", "HZ"); }

}  // namespace poselift::cli
