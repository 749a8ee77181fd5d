// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>

#include "src/io/asf.h"
#include "src/motion.h"

namespace poselift {

// Acclaim motion capture file (.amc): per frame one line for each bone with the
// values of its dofs in the order of the ASF. The file has no frame rate.
inline constexpr double kCmuFrameTime_s = 1.0 / 120.0;

// Bones the file does not have rest (dofs 0). Angles are in the unit of :DEGREES
// or :RADIANS, else that of the ASF; lengths always in that of the ASF.
// Throws InputError with file:line: an unknown bone, too few or too many values,
// a bone twice in a frame, frame numbers out of order, a frame with other bones
// than the first (a file cut short), no frame.
Motion ReadAmc(const std::filesystem::path& path, const AsfSkeleton& asf,
               double frame_time_s = kCmuFrameTime_s);

// The ASF that belongs to an AMC: <name up to the first _>.asf, else <name>.asf,
// else the only .asf of the folder. Throws InputError when there is none.
std::filesystem::path FindAsfOf(const std::filesystem::path& amc_path);

// motion.frames are poses of asf.skeleton (same dofs in the same order). Angles
// of the root are continuous over time. Throws InputError on a NaN.
void WriteAmc(const Motion& motion, const AsfSkeleton& asf, const std::filesystem::path& path);
// With ToAsfSkeleton(motion.skeleton), which WriteAsf(motion.skeleton, ...) writes.
void WriteAmc(const Motion& motion, const std::filesystem::path& path);

}  // namespace poselift
