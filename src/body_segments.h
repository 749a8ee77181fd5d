// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace poselift {

// What people call the bones of the CMU skeleton that the 23 joints end.
struct BodySegment {
  std::string_view name;      // "left_thigh"
  std::string_view cmu_bone;  // "lfemur"
};

std::span<const BodySegment> BodySegments();

// The CMU bone of a segment's name, or of its own name in upper or lower case.
std::optional<std::string> FindBodyBone(std::string_view name);

// The segment's name where a bone has one, else the bone's own.
std::string SegmentName(std::string_view cmu_bone);

}  // namespace poselift
