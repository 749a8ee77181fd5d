// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>

#include "calib/april_grid.h"

namespace poselift {

// Kalibr's description of a target: target_type aprilgrid, tagRows, tagCols, tagSize in
// metres, tagSpacing; and tagFamily and firstId, which are ours. Without them the tags are those
// that Kalibr prints and looks for: tag36h11b2, from 0. The black squares that it prints between
// them touch their corners, and hide some of them from libapriltag: a board then counts in part.
//
// Throws InputError with file:line for what is no YAML, another target, a key that is missing
// or no number, and a grid that is not valid.
AprilGrid ReadAprilGridYaml(const std::filesystem::path& path);

// Throws InputError when it cannot, std::invalid_argument for a grid that is not valid.
void WriteAprilGridYaml(const AprilGrid& grid, const std::filesystem::path& path);

// The text that it writes.
std::string AprilGridYaml(const AprilGrid& grid);

}  // namespace poselift
