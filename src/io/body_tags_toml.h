// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>

#include "src/body_tags.h"

namespace poselift {

// Whether each tag must say where on the body it sits; where any will do, names of tags.yaml are
// what they like, or missing.
enum class TagPlaces { kWanted, kAny };

// The tags that a person wears: tags.toml (docs/FORMATS.md), or the tags.yaml of apriltag_ros
// when the name ends in .yaml or .yml.
//
// Throws InputError with file:line for what is missing, unknown (with the nearest name there
// is), no number, too large, not unit (rotations) or there twice.
BodyTags ReadBodyTags(const std::filesystem::path& path, TagPlaces places = TagPlaces::kWanted);

// As tags.toml, atomically; what ReadBodyTags reads again to the last or last but one bit.
// Throws InputError when the file cannot be written.
void WriteBodyTags(const BodyTags& tags, const std::filesystem::path& path);

// The text that it writes.
std::string BodyTagsToml(const BodyTags& tags);

}  // namespace poselift
