// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "calib/april_grid_yaml.h"
#include "calib/tag_family.h"
#include "src/body_segments.h"
#include "src/input_error.h"
#include "src/io/body_tags_toml.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {

using Json = nlohmann::ordered_json;

bool IsBodyTags(const std::filesystem::path& path, std::string_view head) {
  const auto has = [&](const char* word) { return head.find(word) != std::string_view::npos; };
  if (HasEnding(path, ".yaml") || HasEnding(path, ".yml"))
    return has("standalone_tags:") || has("tag_bundles:");
  return HasEnding(path, ".toml") && !has("matrix");  // not a camera
}

Json DescribeBodyTags(const std::filesystem::path& path) {
  const BodyTags tags = ReadBodyTags(path);
  const TagFamily family(tags.family);
  Json facts = {{"family", tags.family}, {"tags", tags.tags.size()}};
  for (const BodyTag& tag : tags.tags) {
    if (tag.id >= family.num_ids())
      throw InputError(path.string(),
                       fmt::format("found the tag {}, wanted 0 to {}: {} has no more", tag.id,
                                   family.num_ids() - 1, tags.family));
    std::string where = fmt::format("{:g} mm", 1e3 * tag.size_m);
    if (tag.on_joint) where += fmt::format(", joint {}", tag.on_joint->joint);
    if (tag.on_bone) where += fmt::format(", bone {}", SegmentName(tag.on_bone->bone));
    facts[fmt::format("tag {}", tag.id)] = where;
  }
  if (!tags.bone_lengths_m.empty()) facts["bone_lengths"] = tags.bone_lengths_m.size();
  return facts;
}

bool IsAprilGrid(const std::filesystem::path& path, std::string_view head) {
  return (HasEnding(path, ".yaml") || HasEnding(path, ".yml")) &&
         head.find("target_type") != std::string_view::npos;
}

Json DescribeAprilGrid(const std::filesystem::path& path) {
  const AprilGrid grid = ReadAprilGridYaml(path);
  return {{"family", grid.family},
          {"tags", {{"rows", grid.rows}, {"columns", grid.columns}}},
          {"ids", {grid.first_id, grid.first_id + grid.num_tags() - 1}},
          {"tag_size_m", grid.tag_size_m},
          {"spacing", grid.spacing},
          {"size_m", {grid.Width_m(), grid.Height_m()}}};
}

}  // namespace poselift::cli
