// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "src/skeleton.h"

namespace poselift {

// The names of a skeleton's bones as every reader of motion files takes them:
// letters, digits and _ - . : only, not beginning with a digit, no keyword, and
// no two alike (case ignored). Names that are so already stay as they are.
// root_name: the name of bone 0 where the format fixes it; empty: its own.
std::vector<std::string> PlainNames(const Skeleton& skeleton, const std::string& root_name = "");

}  // namespace poselift
