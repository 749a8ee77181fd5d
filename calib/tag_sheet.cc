// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Cairo draws in millimetres: its points are scaled once.
#include "calib/tag_sheet.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

#include "calib/tag_sheet_measures.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kRuler_mm = 100.0;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t Append(void* text, const unsigned char* bytes, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

void Grey(cairo_t* c, double level) { cairo_set_source_rgb(c, level, level, level); }

// The largest text up to a height that is no wider than it may be.
void Text(cairo_t* c, double x_mm, double y_mm, double height_mm, double width_mm,
          const std::string& text) {
  cairo_text_extents_t extents;
  cairo_set_font_size(c, height_mm);
  cairo_text_extents(c, text.c_str(), &extents);
  if (extents.x_advance > width_mm)
    cairo_set_font_size(c, height_mm * width_mm / extents.x_advance);
  cairo_move_to(c, x_mm, y_mm);
  cairo_show_text(c, text.c_str());
}

// One path, so that no viewer shows seams between cells.
void DrawCells(cairo_t* c, const TagFamily& family, int id, double x_mm, double y_mm,
               double edge_mm) {
  const cv::Mat cells = family.Image(id);
  const double cell_mm = edge_mm / cells.cols;
  for (int row = 0; row < cells.rows; ++row)
    for (int first = 0; first < cells.cols; ++first) {
      if (cells.at<uchar>(row, first) != 0) continue;
      int end = first;
      while (end < cells.cols && cells.at<uchar>(row, end) == 0) ++end;
      cairo_rectangle(c, x_mm + first * cell_mm, y_mm + row * cell_mm, (end - first) * cell_mm,
                      cell_mm);
      first = end;
    }
  Grey(c, 0.0);
  cairo_fill(c);
}

void DrawArrow(cairo_t* c, double tip_x_mm, double tip_y_mm) {
  cairo_move_to(c, tip_x_mm, tip_y_mm);
  cairo_rel_line_to(c, 2.0, 3.5);
  cairo_rel_line_to(c, -4.0, 0.0);
  cairo_close_path(c);
  Grey(c, 0.55);
  cairo_fill(c);
  Text(c, tip_x_mm + 3.0, tip_y_mm + 3.3, 3.2, 20.0, "up");
}

void DrawBlock(cairo_t* c, const TagFamily& family, const PlacedSheetTag& placed) {
  const SheetTag& tag = placed.tag;
  const double print_mm = 1e3 * PrintEdge_m(family, tag.size_m);
  const double border_mm = 0.5 * (print_mm - 1e3 * tag.size_m);
  const Eigen::Vector2d print_at_mm = 1e3 * placed.top_left_m.array() - border_mm;
  const Eigen::Vector2d block_mm = 1e3 * BlockSize_m(family, tag.size_m);
  const Eigen::Vector2d corner_mm = print_at_mm - 1e3 * Eigen::Vector2d(kPad_m, kArrowRoom_m);
  Grey(c, 0.6);
  const double dash_mm[] = {2.0, 1.5};
  cairo_set_dash(c, dash_mm, 2, 0.0);
  cairo_set_line_width(c, 0.2);
  cairo_rectangle(c, corner_mm.x(), corner_mm.y(), block_mm.x(), block_mm.y());
  cairo_stroke(c);
  cairo_set_dash(c, nullptr, 0, 0.0);
  DrawArrow(c, corner_mm.x() + 0.5 * block_mm.x(), corner_mm.y() + 2.0);
  Grey(c, 0.0);
  const double text_y_mm = print_at_mm.y() + print_mm;
  const std::string name = tag.name.empty() ? "" : "  " + tag.name;
  Text(c, print_at_mm.x(), text_y_mm + 4.2, 4.2, print_mm,
       fmt::format("{}{}  ({:g} mm)", tag.id, name, 1e3 * tag.size_m));
  Text(c, print_at_mm.x(), text_y_mm + 9.0, 3.4, print_mm, tag.place);
}

void DrawLine(cairo_t* c, double x0_mm, double y0_mm, double x1_mm, double y1_mm) {
  cairo_move_to(c, x0_mm, y0_mm);
  cairo_line_to(c, x1_mm, y1_mm);
  cairo_stroke(c);
}

void DrawRuler(cairo_t* c, double x_mm, double y_mm) {
  Grey(c, 0.0);
  cairo_set_line_width(c, 0.2);
  DrawLine(c, x_mm, y_mm, x_mm + kRuler_mm, y_mm);
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); ++mm)
    DrawLine(c, x_mm + mm, y_mm, x_mm + mm, y_mm - (mm % 10 == 0 ? 4.0 : mm % 5 == 0 ? 2.5 : 1.5));
  Text(c, x_mm, y_mm + 4.5, 3.6, kRuler_mm, "Check with a ruler: this scale is 100 mm long.");
}

// The axes of a tag (tag_detection.h) from its centre: x red, y green, z away from who looks.
void DrawAxes(cairo_t* c, double x_mm, double y_mm, double length_mm) {
  constexpr double kTip_mm = 0.8;
  cairo_set_line_width(c, 0.3);
  cairo_set_source_rgb(c, 0.8, 0.1, 0.1);
  DrawLine(c, x_mm, y_mm, x_mm + length_mm, y_mm);
  DrawLine(c, x_mm + length_mm - kTip_mm, y_mm - kTip_mm, x_mm + length_mm, y_mm);
  DrawLine(c, x_mm + length_mm - kTip_mm, y_mm + kTip_mm, x_mm + length_mm, y_mm);
  Text(c, x_mm + length_mm - 1.0, y_mm - 1.0, 2.6, 3.0, "x");
  cairo_set_source_rgb(c, 0.0, 0.5, 0.1);
  DrawLine(c, x_mm, y_mm, x_mm, y_mm + length_mm);
  DrawLine(c, x_mm - kTip_mm, y_mm + length_mm - kTip_mm, x_mm, y_mm + length_mm);
  DrawLine(c, x_mm + kTip_mm, y_mm + length_mm - kTip_mm, x_mm, y_mm + length_mm);
  Text(c, x_mm + 0.8, y_mm + length_mm, 2.6, 3.0, "y");
}

// A small tag with the dimension that is meant and its axes; without its bits, or cameras would
// see it.
void DrawSizePicture(cairo_t* c, const TagFamily& family, double x_mm, double y_mm,
                     double width_mm) {
  constexpr double kPrint_mm = 16.0;
  const double border_mm =
      0.5 * kPrint_mm * (1.0 - static_cast<double>(family.cells_of_size()) / family.cells());
  Grey(c, 0.8);
  cairo_set_line_width(c, 0.15);
  cairo_rectangle(c, x_mm, y_mm, kPrint_mm, kPrint_mm);
  cairo_stroke(c);
  const double cell_mm = kPrint_mm / family.cells();
  Grey(c, 0.0);
  cairo_set_line_width(c, cell_mm);
  cairo_rectangle(c, x_mm + border_mm + 0.5 * cell_mm, y_mm + border_mm + 0.5 * cell_mm,
                  kPrint_mm - 2.0 * border_mm - cell_mm, kPrint_mm - 2.0 * border_mm - cell_mm);
  cairo_stroke(c);
  cairo_set_line_width(c, 0.15);
  const double left_mm = x_mm + border_mm, right_mm = x_mm + kPrint_mm - border_mm;
  const double line_mm = y_mm + kPrint_mm + 3.0;
  cairo_set_source_rgb(c, 0.8, 0.1, 0.1);
  DrawLine(c, left_mm, y_mm + kPrint_mm - border_mm, left_mm, line_mm + 1.0);
  DrawLine(c, right_mm, y_mm + kPrint_mm - border_mm, right_mm, line_mm + 1.0);
  DrawLine(c, left_mm, line_mm, right_mm, line_mm);
  const double text_x_mm = x_mm + kPrint_mm + 2.0;
  const double text_width_mm = width_mm - kPrint_mm - 2.0;
  DrawAxes(c, x_mm + 0.5 * kPrint_mm, y_mm + 0.5 * kPrint_mm, 0.5 * kPrint_mm + 1.0);
  Grey(c, 0.0);
  Text(c, text_x_mm, y_mm + 3.0, 3.6, text_width_mm, "size: the edge of the");
  Text(c, text_x_mm, y_mm + 7.0, 3.6, text_width_mm, "square between the black");
  Text(c, text_x_mm, y_mm + 11.0, 3.6, text_width_mm, "and the white border.");
  Text(c, text_x_mm, y_mm + 15.0, 3.6, text_width_mm, "z: into the paper");
  Text(c, text_x_mm, y_mm + 19.0, 3.0, text_width_mm, "(apriltag_ros: y up, z out)");
}

void DrawPage(cairo_t* c, const TagFamily& family, const SheetPage& page, const Paper& paper) {
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  for (const PlacedSheetTag& placed : page.tags) {
    const double print_mm = 1e3 * PrintEdge_m(family, placed.tag.size_m);
    const double border_mm = 0.5 * (print_mm - 1e3 * placed.tag.size_m);
    if (page.has_cut_lines) DrawBlock(c, family, placed);
    DrawCells(c, family, placed.tag.id, 1e3 * placed.top_left_m.x() - border_mm,
              1e3 * placed.top_left_m.y() - border_mm, print_mm);
  }
  const double left_mm = 1e3 * kMargin_m, bottom_mm = 1e3 * (paper.height_m - kMargin_m);
  const double width_mm = 1e3 * paper.width_m - 2.0 * left_mm;
  DrawRuler(c, left_mm, bottom_mm - 14.0);
  Text(c, left_mm, bottom_mm - 3.0, 3.4, 120.0, page.note);
  DrawSizePicture(c, family, left_mm + 128.0, bottom_mm - 24.0, width_mm - 128.0);
}

void Check(cairo_t* c, cairo_surface_t* surface, const std::filesystem::path& path) {
  for (const cairo_status_t status : {cairo_status(c), cairo_surface_status(surface)})
    if (status != CAIRO_STATUS_SUCCESS)
      throw InputError(path.string(), cairo_status_to_string(status));
}

// All of the pages as one document.
std::string Document(const TagFamily& family, std::span<const SheetPage> pages, const Paper& paper,
                     bool is_pdf, const std::filesystem::path& path) {
  std::string bytes;
  const double width_mm = 1e3 * paper.width_m, height_mm = 1e3 * paper.height_m;
  const double width = width_mm * kPointsPerMm, height = height_mm * kPointsPerMm;
  const Surface surface(
      is_pdf ? cairo_pdf_surface_create_for_stream(Append, &bytes, width, height)
             : cairo_svg_surface_create_for_stream(Append, &bytes, width_mm, height_mm),
      cairo_surface_destroy);
  if (!is_pdf) cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_MM);
  const Context c(cairo_create(surface.get()), cairo_destroy);
  if (is_pdf) cairo_scale(c.get(), kPointsPerMm, kPointsPerMm);
  for (const SheetPage& page : pages) {
    DrawPage(c.get(), family, page, paper);
    cairo_show_page(c.get());
  }
  Check(c.get(), surface.get(), path);
  cairo_surface_finish(surface.get());
  return bytes;
}

}  // namespace

std::vector<std::filesystem::path> WriteTagSheet(const TagFamily& family,
                                                 const std::vector<SheetPage>& pages,
                                                 const Paper& paper,
                                                 const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  const bool is_pdf = EqualsIgnoringCase(ending, ".pdf");
  if (!is_pdf && !EqualsIgnoringCase(ending, ".svg"))
    throw InputError(path.string(), "wanted a name that ends in .pdf or .svg");
  if (is_pdf || pages.size() == 1) {
    WriteFileAtomically(path, Document(family, pages, paper, is_pdf, path));
    return {path};
  }
  std::vector<std::filesystem::path> files;
  for (size_t i = 0; i < pages.size(); ++i) {
    std::filesystem::path file = path;
    file.replace_filename(fmt::format("{}-{}{}", path.stem().string(), i + 1, ending));
    WriteFileAtomically(file, Document(family, std::span(pages).subspan(i, 1), paper, false, file));
    files.push_back(file);
  }
  return files;
}

}  // namespace poselift
