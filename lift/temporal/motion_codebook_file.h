// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>

#include "lift/temporal/motion_codebook.h"

namespace poselift {

// A motion codebook as one file (.plmotion), an array file (lift/array_file.h) of
// segments, rates and deviations; docs/FORMATS.md has it all. What is read is, to
// the last bit, what was written. The same codebook gives the same bytes.

// What no codebook may be, in one line, or "" when all is well:
//  - skeleton: no SkeletonFlaw (lift/skeleton_check.h), no FeatureSkeletonFlaw;
//  - sample time: more than 0, at most 10 s;
//  - at least one segment, as many rates and deviations; no number that is not
//    finite or beyond 1000, no deviation below 0;
//  - training record: no negative number, a finite error.
std::string CodebookFlaw(const MotionCodebook& codebook);

// Written as WriteFileAtomically does. Throws InputError when the file cannot be
// written, std::invalid_argument for a codebook with a CodebookFlaw.
void WriteMotionCodebook(const MotionCodebook& codebook, const std::filesystem::path& path);

// Throws InputError that says what is wrong: no motion codebook, one of a newer
// version, cut short, altered, or with content that CodebookFlaw refuses.
MotionCodebook ReadMotionCodebook(const std::filesystem::path& path);

}  // namespace poselift
