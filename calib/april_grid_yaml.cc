// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/april_grid_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "calib/tag_family.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/yaml_value.h"

namespace poselift {

AprilGrid ReadAprilGridYaml(const std::filesystem::path& path) {
  const YamlDocument document(path);
  const YamlValue root = document.root();
  if (!root.IsMap() || !root.Find("target_type"))
    throw InputError(path,
                     "found no target_type, wanted a target file of Kalibr, as `poselift tags "
                     "print --set board` writes one");
  const YamlValue type = root.At("target_type");
  if (type.String() != "aprilgrid")
    throw type.Unwanted(
        "aprilgrid; of a checkerboard give --board chessboard --corners --square-mm");
  AprilGrid grid{.family = "tag36h11b2"};
  grid.rows = root.At("tagRows").Integer(1, 1000);
  grid.columns = root.At("tagCols").Integer(1, 1000);
  grid.tag_size_m = root.At("tagSize").Number();
  grid.spacing = root.At("tagSpacing").Number();
  if (const auto first_id = root.Find("firstId")) grid.first_id = first_id->Integer(0, 1000000);
  if (const auto family = root.Find("tagFamily")) {
    grid.family = family->String();
    const auto& names = TagFamily::Names();
    if (std::find(names.begin(), names.end(), grid.family) == names.end())
      throw family->Unwanted(fmt::format("one of {}", fmt::join(names, ", ")));
  }
  if (const std::string flaw = grid.Validate(); !flaw.empty()) throw type.Error(flaw);
  return grid;
}

void WriteAprilGridYaml(const AprilGrid& grid, const std::filesystem::path& path) {
  if (const std::string flaw = grid.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  WriteFileAtomically(path, AprilGridYaml(grid));
}

std::string AprilGridYaml(const AprilGrid& grid) {
  return fmt::format(
      "target_type: 'aprilgrid'\ntagCols: {}\ntagRows: {}\n"
      "tagSize: {}      # metres, between the black and the white border\n"
      "tagSpacing: {}   # gap / tagSize\ntagFamily: '{}'\nfirstId: {}\n",
      grid.columns, grid.rows, grid.tag_size_m, grid.spacing, grid.family, grid.first_id);
}

}  // namespace poselift
