// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "src/motion.h"
#include "src/retarget.h"

namespace poselift {

// Motions in any format we know, told apart by the ending of the name:
// .bvh, .amc (with its .asf) and .asf (a skeleton: one frame at rest).

struct ReadMotionOptions {
  // The ASF of an AMC; empty: the one that FindAsfOf finds.
  std::filesystem::path skeleton;
  double metres_per_unit = 0.01;       // of a BVH
  std::optional<double> frame_time_s;  // instead of the file's (AMC: 1/120 s)
};

Motion ReadMotion(const std::filesystem::path& path, const ReadMotionOptions& options = {});

struct WriteMotionOptions {
  // For an AMC: the ASF to put the motion on, by the names of its bones; empty:
  // the motion's own skeleton, written as .asf beside the .amc.
  std::filesystem::path skeleton;
  double metres_per_unit = 0.01;  // of a BVH
};

// Returns what the named skeleton could not express. Throws InputError for an
// unknown ending and when the named skeleton has no bone of the motion.
RebaseReport WriteMotion(const Motion& motion, const std::filesystem::path& path,
                         const WriteMotionOptions& options = {});

// "m", "cm", "mm" or "in"; nothing for other names.
std::optional<double> MetresPerUnit(std::string_view unit);

}  // namespace poselift
