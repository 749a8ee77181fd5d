// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <string_view>

#include "src/labels.h"

namespace poselift {

// As people say it, in their language (src/translated.h): "left_knee" -> "left knee".
std::string InWords(std::string_view name);
std::string InWords(const LabelHint& hint);  // "left knee on the floor"

}  // namespace poselift
