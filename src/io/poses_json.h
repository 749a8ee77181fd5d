// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/io/growing_file.h"
#include "src/poses.h"

namespace poselift {

// poses.json, "poselift-poses" version 1: docs/FORMATS.md. A line for each
// person; metres and coefficients with 6 digits behind the point, pixels and
// degrees with 3, quaternions with 9. What is not known (NaN) is left out, a
// joint as well as a whole key; there is no null.
//
// Throws InputError when the file cannot be written.
void WritePosesJson(const Poses& poses, const std::filesystem::path& path);

// The text that WritePosesJson writes.
std::string PosesJson(const Poses& poses);

// The same file, frame after frame, whole at every moment (growing_file.h).
class GrowingPosesJson {
 public:
  // Throw InputError when the file cannot be written; it is then as before.
  // source: what the frames come from, "camera"; not written when empty.
  explicit GrowingPosesJson(const std::filesystem::path& path,
                            const std::vector<PersonBones>& bodies = {},
                            std::string_view source = {});
  void Add(const FramePoses& frame);
  void Close() { file_.Close(); }

 private:
  GrowingFile file_;
  bool is_empty_ = true;
};

// A frame of it alone, on one line that ends in a line break: JSON lines.
std::string FramePosesLine(const FramePoses& frame);
// line: the number of the line in the file, for messages.
FramePoses ReadFramePosesLine(std::string_view text, const std::string& file, int line);

// The source that a GrowingPosesJson was given; empty where the file names none.
std::string SourceOfPosesJson(const std::filesystem::path& path);

// Reads it back: equal up to the rounding. Unknown keys are passed over.
// Throws InputError: file:line: the JSON path, what was found, what was wanted.
Poses ReadPosesJson(const std::filesystem::path& path);

}  // namespace poselift
