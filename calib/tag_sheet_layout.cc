// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <algorithm>

#include "calib/tag_sheet.h"
#include "calib/tag_sheet_measures.h"
#include "src/input_error.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

Eigen::Vector2d RoomOn(const Paper& paper) {
  return {paper.width_m - 2.0 * kMargin_m, paper.height_m - 2.0 * kMargin_m - kFooter_m};
}

[[noreturn]] void FailTooLarge(const std::string& what, const Eigen::Vector2d& needed_m,
                               const Paper& paper) {
  const Eigen::Vector2d room_m = RoomOn(paper);
  throw InputError(fmt::format(
      "found {} that needs {:.1f} x {:.1f} mm, wanted at most {:.1f} x {:.1f} mm, the room on {}",
      what, 1e3 * needed_m.x(), 1e3 * needed_m.y(), 1e3 * room_m.x(), 1e3 * room_m.y(),
      paper.name));
}

}  // namespace

const std::vector<Paper>& Papers() {
  static const std::vector<Paper> kPapers = {
      {"A4", 0.210, 0.297}, {"Letter", 0.2159, 0.2794}, {"A3", 0.297, 0.420}};
  return kPapers;
}

const Paper& FindPaper(const std::string& name) {
  std::vector<std::string> names;
  for (const Paper& paper : Papers()) {
    if (EqualsIgnoringCase(paper.name, name)) return paper;
    names.push_back(paper.name);
  }
  throw InputError(
      fmt::format("found the paper {}, wanted one of: {}", Quoted(name), fmt::join(names, ", ")));
}

std::vector<SheetPage> LayOutTags(const TagFamily& family, const std::vector<SheetTag>& tags,
                                  const Paper& paper) {
  const Eigen::Vector2d room_m = RoomOn(paper);
  std::vector<SheetPage> pages(1);
  Eigen::Vector2d corner_m(0.0, 0.0);  // of the next block
  double row_height_m = 0.0;
  for (const SheetTag& tag : tags) {
    if (tag.id < 0 || tag.id >= family.num_ids())
      throw InputError(fmt::format("found the tag id {}, wanted 0 to {}: {} has no more", tag.id,
                                   family.num_ids() - 1, family.name()));
    const Eigen::Vector2d block_m = BlockSize_m(family, tag.size_m);
    if ((block_m.array() > room_m.array() + 1e-9).any())
      FailTooLarge(fmt::format("the tag {} of {:g} mm", tag.id, 1e3 * tag.size_m), block_m, paper);
    if (corner_m.x() + block_m.x() > room_m.x() + 1e-9) {
      corner_m = {0.0, corner_m.y() + row_height_m};
      row_height_m = 0.0;
    }
    if (corner_m.y() + block_m.y() > room_m.y() + 1e-9) {
      pages.emplace_back();
      corner_m.setZero();
      row_height_m = 0.0;
    }
    const double border_m = 0.5 * (PrintEdge_m(family, tag.size_m) - tag.size_m);
    pages.back().tags.push_back(
        {tag, corner_m + Eigen::Vector2d(kMargin_m + kPad_m + border_m,
                                         kMargin_m + kArrowRoom_m + border_m)});
    corner_m.x() += block_m.x();
    row_height_m = std::max(row_height_m, block_m.y());
  }
  for (SheetPage& page : pages)
    page.note = fmt::format("{}. Print at 100 %, not \"fit to page\".", family.name());
  return pages;
}

std::vector<SheetPage> LayOutGrid(const AprilGrid& grid, const Paper& paper) {
  if (const std::string flaw = grid.Validate(); !flaw.empty()) throw InputError(flaw);
  const TagFamily family(grid.family);
  const double border_m = PrintEdge_m(family, grid.tag_size_m) - grid.tag_size_m;
  const Eigen::Vector2d needed_m(grid.Width_m() + border_m, grid.Height_m() + border_m);
  const Eigen::Vector2d room_m = RoomOn(paper);
  if ((needed_m.array() > room_m.array() + 1e-9).any())
    FailTooLarge(fmt::format("a board of {} x {} tags", grid.rows, grid.columns), needed_m, paper);
  SheetPage page{.has_cut_lines = false};
  const Eigen::Vector2d corner_m = Eigen::Vector2d::Constant(kMargin_m + 0.5 * border_m) +
                                   Eigen::Vector2d(0.5 * (room_m.x() - needed_m.x()), 0.0);
  for (int id = grid.first_id; grid.Has(id); ++id)
    page.tags.push_back({{.id = id, .size_m = grid.tag_size_m}, corner_m + grid.TopLeft_m(id)});
  page.note = fmt::format(
      "{}, {} rows, {} columns, size {:g} mm, spacing {:g}. Print at 100 %, not \"fit to page\"; "
      "glue it on something flat.",
      grid.family, grid.rows, grid.columns, 1e3 * grid.tag_size_m, grid.spacing);
  return {page};
}

}  // namespace poselift
