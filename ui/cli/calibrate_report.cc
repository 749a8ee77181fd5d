// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/calibrate_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "src/io/atomic_file.h"
#include "src/units.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

// By picture, the view it has; null for those that were skipped.
std::vector<const CalibratedView*> ViewsByPicture(const CalibrationReport& report) {
  std::vector<const CalibratedView*> by_picture;
  size_t view = 0;
  for (const SurveyedPicture& picture : report.surveyed.pictures) {
    const bool has_view = picture.skipped.empty() && view < report.result.views.size();
    by_picture.push_back(has_view ? &report.result.views[view] : nullptr);
    if (picture.skipped.empty()) ++view;
  }
  return by_picture;
}

// A result from views that are too few has none of their errors.
bool IsMeasured(const CalibrationResult& result) {
  return result.status != CalibrationStatus::kNotRun &&
         result.status != CalibrationStatus::kTooFewViews && result.camera.width_px > 0;
}

std::string StateOf(const SurveyedPicture& picture, const CalibratedView* view,
                    const CalibrationResult& result) {
  if (!picture.skipped.empty()) return "skipped: " + picture.skipped;
  if (!view || !IsMeasured(result)) return "board found";
  if (view->is_used) return fmt::format("{:.3f} px rms", view->rms_px);
  return fmt::format("dropped: {:.3f} px rms, all that are used {:.3f}", view->rms_px,
                     result.rms_px);
}

void PrintPictures(const CalibrationReport& report) {
  size_t width = 0;
  for (const SurveyedPicture& picture : report.surveyed.pictures)
    width = std::max(width, picture.name.size());
  const auto views = ViewsByPicture(report);
  for (size_t i = 0; i < views.size(); ++i) {
    const SurveyedPicture& picture = report.surveyed.pictures[i];
    fmt::print("  {:<{}}  {}\n", picture.name, width, StateOf(picture, views[i], report.result));
  }
}

std::string PlusMinus(const CalibrationResult& result, int i, int decimals) {
  return fmt::format("{:.{}f} ± {:.{}f}", ParametersOf(result.camera)[i], decimals, result.sigma[i],
                     decimals);
}

void PrintCamera(const CalibrationResult& result) {
  fmt::print("focal length     {}, {} px\n", PlusMinus(result, 0, 2), PlusMinus(result, 1, 2));
  fmt::print("principal point  {}, {} px\n", PlusMinus(result, 2, 2), PlusMinus(result, 3, 2));
  fmt::print("distortion      ");
  const int num_free = NumFreeParameters(result.lens);
  if (num_free == 4) fmt::print(" none");
  for (int i = 4; i < num_free; ++i)
    fmt::print("{} {} {}", i == 4 ? "" : ",", CameraParameterNames()[static_cast<size_t>(i)],
               PlusMinus(result, i, 4));
  fmt::print("\n");
  if (result.view_sigma[0] > 0.0)
    fmt::print(
        "± is of the corners' noise alone; leaving out views moves the focal length by "
        "± {:.2f}, {:.2f} px,\nthe principal point by ± {:.2f}, {:.2f} px\n",
        result.view_sigma[0], result.view_sigma[1], result.view_sigma[2], result.view_sigma[3]);
  fmt::print("{:.3f} px rms over {} views; noise of a corner {:.3f} px in x and in y\n",
             result.rms_px, result.num_used(), result.corner_sigma_px);
}

void PrintCoverage(const CalibrationCoverage& coverage) {
  fmt::print(
      "corners in {:.0f} % of the picture; board {:.0f} to {:.0f} % of its diagonal; tilted "
      "left {:.0f}, right {:.0f}, up {:.0f}, down {:.0f} degrees\n",
      100.0 * coverage.share, 100.0 * coverage.smallest_size, 100.0 * coverage.largest_size,
      kDegFromRad * coverage.left_rad, kDegFromRad * coverage.right_rad,
      kDegFromRad * coverage.up_rad, kDegFromRad * coverage.down_rad);
  constexpr size_t kMostHints = 3;
  for (size_t i = 0; i < coverage.hints.size() && i < kMostHints; ++i)
    fmt::print("{} {}\n", i == 0 ? "to do better:" : "             ", coverage.hints[i]);
}

Json ParametersJson(const CalibrationResult& result) {
  const CameraParameters values = ParametersOf(result.camera);
  Json json = Json::object();
  for (int i = 0; i < NumFreeParameters(result.lens); ++i)
    json[CameraParameterNames()[static_cast<size_t>(i)]] = {
        {"value", values[i]},
        {"sigma", result.sigma[i]},
        {"view_sigma", result.view_sigma[i] > 0.0 ? Json(result.view_sigma[i]) : Json()}};
  return json;
}

Json PicturesJson(const CalibrationReport& report) {
  Json json = Json::array();
  const auto views = ViewsByPicture(report);
  for (size_t i = 0; i < views.size(); ++i) {
    const SurveyedPicture& picture = report.surveyed.pictures[i];
    Json& row = json.emplace_back(Json{{"picture", picture.name}});
    row["used"] = views[i] && views[i]->is_used;
    if (!picture.skipped.empty()) row["skipped"] = picture.skipped;
    if (views[i] && std::isfinite(views[i]->rms_px) && IsMeasured(report.result))
      row["rms_px"] = views[i]->rms_px;
  }
  return json;
}

Json CoverageJson(const CalibrationCoverage& coverage) {
  Json cells = Json::array();
  for (Eigen::Index row = 0; row < coverage.corners.rows(); ++row) {
    Json& line = cells.emplace_back(Json::array());
    for (Eigen::Index column = 0; column < coverage.corners.cols(); ++column)
      line.push_back(coverage.corners(row, column));
  }
  return {{"share", coverage.share},
          {"corners", cells},
          {"size", {coverage.smallest_size, coverage.largest_size}},
          {"tilt_deg",
           {{"left", kDegFromRad * coverage.left_rad},
            {"right", kDegFromRad * coverage.right_rad},
            {"up", kDegFromRad * coverage.up_rad},
            {"down", kDegFromRad * coverage.down_rad}}},
          {"hints", coverage.hints}};
}

}  // namespace

CalibrationCoverage UsedCoverage(const CalibrationBoard& board, const SurveyedViews& surveyed,
                                 const CalibrationResult& result) {
  std::vector<const BoardView*> views;
  std::vector<Eigen::Isometry3d> poses;
  for (size_t v = 0; v < surveyed.views.size(); ++v) {
    if (result.IsUsable() && !result.views[v].is_used) continue;
    views.push_back(&surveyed.views[v]);
    if (result.IsUsable()) poses.push_back(result.views[v].cam_from_board);
  }
  return result.IsUsable()
             ? CoverageOf(board, views, poses, result.camera)
             : CoverageOf(board, views, surveyed.size_px.width, surveyed.size_px.height);
}

void PrintReport(const CalibrationReport& report) {
  const SurveyedViews& surveyed = report.surveyed;
  fmt::print("{}; pictures of {} x {} px\n", report.finder.board().name, surveyed.size_px.width,
             surveyed.size_px.height);
  PrintPictures(report);
  if (report.result.IsUsable()) PrintCamera(report.result);
  if (!surveyed.views.empty()) PrintCoverage(report.coverage);
  if (report.result.IsUsable())
    fmt::print("wrote {}{}\n", report.out, report.picture.empty() ? "" : ", " + report.picture);
}

void WriteReportJson(const CalibrationReport& report, const std::string& flaw,
                     const std::string& path) {
  const CalibrationResult& result = report.result;
  Json json = {{"command", "calibrate"},
               {"board", report.finder.board().name},
               {"width_px", report.surveyed.size_px.width},
               {"height_px", report.surveyed.size_px.height},
               {"done", result.IsUsable()}};
  if (!result.IsUsable()) json["flaw"] = flaw.empty() ? result.BriefReport() : flaw;
  if (result.IsUsable()) {
    json["out"] = report.out;
    json["lens"] = LensModelName(result.lens);
    json["parameters"] = ParametersJson(result);
    json["rms_px"] = result.rms_px;
    json["corner_sigma_px"] = result.corner_sigma_px;
    json["views_used"] = result.num_used();
  }
  json["pictures"] = PicturesJson(report);
  json["coverage"] = CoverageJson(report.coverage);
  WriteFileAtomically(path, json.dump(2) + "\n");
}

}  // namespace poselift::cli
