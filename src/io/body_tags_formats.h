// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/body_tags.h"
#include "src/io/body_tags_toml.h"

namespace poselift {

// What the readers of tags share.

BodyTags ReadBodyTagsToml(const std::filesystem::path& path);
BodyTags ReadBodyTagsRos(const std::filesystem::path& path, TagPlaces places);

// No code of any family is larger.
inline constexpr int kLargestTagId = 65535;
inline constexpr double kSmallestTag_m = 0.002, kLargestTag_m = 10.0;
// Offsets from a tag, bones.
inline constexpr double kFarthestFromTag_m = 5.0;

// What a joint and what a bone of the body may be called.
std::vector<std::string> JointNames();
std::vector<std::string> BoneNames();

// 'wanted perhaps "left_knee"'.
std::string WantedPerhaps(std::string_view name, const std::vector<std::string>& names);

}  // namespace poselift
