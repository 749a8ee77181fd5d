// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

namespace CLI {
class Validator;
}

namespace poselift::cli {

// For options that are a number from lowest to highest, both included.
// CLI::Range and CLI::PositiveNumber let NaN through.
CLI::Validator IsNumber(double lowest, double highest);

// For options that are a frame rate in Hz: from 0.001 to 1e6.
CLI::Validator IsFrameRate();

}  // namespace poselift::cli
