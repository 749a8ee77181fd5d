// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/io/growing_file.h"
#include "src/poses.h"

namespace poselift {

using NamedAngles = std::vector<std::pair<std::string, double>>;

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

// Either of them, frame after frame, whole at every moment (growing_file.h). Its columns are
// named beforehand: other angles are left out.
class GrowingAnglesCsv {
 public:
  // values: &PersonPose::angles_deg or &PersonPose::angles_sigma_deg.
  // Throw InputError when the file cannot be written; it is then as before.
  GrowingAnglesCsv(const std::filesystem::path& path, NamedAngles PersonPose::*values,
                   const std::vector<std::string>& columns);
  void Add(const FramePoses& frame);
  void Close() { file_.Close(); }

 private:
  NamedAngles PersonPose::*values_;
  std::vector<std::string> columns_;
  GrowingFile file_;
  int64_t num_frames_ = 0;
  std::optional<int> person_id_;
};

// The texts that these write.
std::string AnglesCsv(const Poses& poses);
std::string AnglesSigmaCsv(const Poses& poses);

}  // namespace poselift
