// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>

#include "src/poses.h"

namespace poselift {

// angles.csv (RFC 4180: a header, commas, CR LF): the joint angles of the first
// person, the one whom the first frame with anybody in it names first, a row
// for each frame:
//   frame,time_s,pelvis.tilt,...,right_wrist.pronation
//   0,0,1.25,...
// frame counts from 0; angles in degrees, in the order in which the frames
// first name them. What is not known (no such person in the frame, no time, no
// angle) is an empty field.
//
// Throws InputError when the file cannot be written.
void WriteAnglesCsv(const Poses& poses, const std::filesystem::path& path);

// angles_sigma.csv: a table of the same shape with the angles' standard deviations,
// degrees.
void WriteAnglesSigmaCsv(const Poses& poses, const std::filesystem::path& path);

// The texts that these write.
std::string AnglesCsv(const Poses& poses);
std::string AnglesSigmaCsv(const Poses& poses);

}  // namespace poselift
