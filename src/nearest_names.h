// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace poselift {

// The `count` names of the list (or all, if it has less) that are the fewest
// letters away from a name that is not on it, the nearest first: what a message
// may propose.
std::vector<std::string> NearestNames(std::string_view name, std::vector<std::string> names,
                                      size_t count);

}  // namespace poselift
