// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <numbers>

namespace poselift {

inline constexpr double kRadFromDeg = std::numbers::pi / 180.0;
inline constexpr double kDegFromRad = 180.0 / std::numbers::pi;
inline constexpr double kMetresPerInch = 0.0254;
// The length unit of the CMU files: inches scaled by the ASF `length` 0.45.
inline constexpr double kCmuLength = 0.45;

}  // namespace poselift
