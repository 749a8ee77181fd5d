// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "calib/april_grid.h"
#include "calib/tag_family.h"

namespace poselift {

// Sheets of tags to print, true to the millimetre: PDF or SVG.

struct Paper {
  std::string name;
  double width_m = 0.0, height_m = 0.0;
};
const std::vector<Paper>& Papers();
// Throws InputError, with the names there are, for one that is unknown. Case is ignored.
const Paper& FindPaper(const std::string& name);

// A tag to cut out: what is written under it.
struct SheetTag {
  int id = 0;
  double size_m = 0.0;  // between black and white border, tag_detection.h
  std::string name;     // "left_shin"
  std::string place;    // "front of the shin, arrow to the knee"
};

struct PlacedSheetTag {
  SheetTag tag;
  Eigen::Vector2d top_left_m;  // of the square whose edge is the size, from the page's corner
};
struct SheetPage {
  std::vector<PlacedSheetTag> tags;
  bool has_cut_lines = true;
  std::string note;  // beside the ruler
};

// In their order, row by row, as many pages as it takes. Throws InputError for a tag that is
// larger than what the page has beside its margins and its ruler, and for unknown ids.
std::vector<SheetPage> LayOutTags(const TagFamily& family, const std::vector<SheetTag>& tags,
                                  const Paper& paper);
std::vector<SheetPage> LayOutGrid(const AprilGrid& grid, const Paper& paper);

// Draws the pages with a ruler of 100 mm and a picture of what size means. The name's ending
// says PDF or SVG; of several pages SVG makes several files, name-1.svg, name-2.svg, ...
// Returns the files. Throws InputError for another ending and when it cannot write.
std::vector<std::filesystem::path> WriteTagSheet(const TagFamily& family,
                                                 const std::vector<SheetPage>& pages,
                                                 const Paper& paper,
                                                 const std::filesystem::path& path);

}  // namespace poselift
