// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calib/april_grid_finder.h"
#include "calib/april_grid_yaml.h"
#include "calib/calibration_picture.h"
#include "calib/camera_calibration.h"
#include "calib/chessboard.h"
#include "src/io/atomic_file.h"
#include "src/io/camera_yaml.h"
#include "src/io/image.h"
#include "ui/cli/calibrate_report.h"
#include "ui/cli/calibrate_views.h"
#include "ui/cli/command.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/progress.h"
#include "ui/cli/refuse_options.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> inputs;
  std::string board = "chessboard";
  BoardCounts corners, tags;
  double square_mm = 0.0;
  AprilGrid grid;
  double tag_mm = 0.0;
  std::string target;  // Kalibr's file of the grid
  std::string lens = "auto";
  std::string out = "camera.yaml";
  std::string name;
  std::string json;
  bool ros = false;
  bool has_picture = true;
  ViewsOptions views;
};

// "4x7" -> rows, columns.
CLI::Option* AddCounts(CLI::App* command, const char* name, BoardCounts* counts,
                       const char* description) {
  const auto parse = [counts](const std::string& text) {
    char end = 0;
    return std::sscanf(text.c_str(), "%4dx%4d%c", &counts->rows, &counts->columns, &end) == 2 &&
           counts->rows > 0 && counts->columns > 0;
  };
  return command
      ->add_option_function<std::string>(
          name,
          [name, parse](const std::string& text) {
            if (!parse(text))
              throw CLI::ValidationError(
                  name, fmt::format("found {}, wanted ROWSxCOLUMNS, as 4x7", text));
          },
          description)
      ->type_name("RxC");
}

std::vector<std::string> LensNames() {
  std::vector<std::string> names = {"auto"};
  for (const LensModel lens : kLensModels) names.emplace_back(LensModelName(lens));
  return names;
}

std::optional<LensModel> LensOf(const std::string& name) {
  for (const LensModel lens : kLensModels)
    if (name == LensModelName(lens)) return lens;
  return std::nullopt;
}

bool IsRosName(const std::string& path) {
  return fs::path(path).filename().string().find("camera_info") != std::string::npos;
}

std::unique_ptr<BoardFinder> MakeFinder(const Options& options) {
  if (options.board == "chessboard")
    return std::make_unique<ChessboardFinder>(
        Chessboard{options.corners.rows, options.corners.columns, 1e-3 * options.square_mm});
  if (!options.target.empty())
    return std::make_unique<AprilGridFinder>(ReadAprilGridYaml(options.target));
  AprilGrid grid = options.grid;
  grid.rows = options.tags.rows;
  grid.columns = options.tags.columns;
  grid.tag_size_m = 1e-3 * options.tag_mm;
  return std::make_unique<AprilGridFinder>(grid);
}

void WriteCamera(const Camera& camera, const Options& options) {
  const std::string name =
      options.name.empty() ? fs::path(options.out).stem().string() : options.name;
  if (options.ros || IsRosName(options.out))
    WriteCameraInfoYaml(camera, name, options.out);
  else
    WriteCameraYaml(camera, options.out);
}

fs::path PicturePath(const std::string& out) {
  return fs::path(out).replace_extension(".coverage.png");
}

int Fail(const std::string& flaw) {
  fmt::print(stderr, "poselift: {}\n", flaw);
  return kFailed;
}

int Calibrate(const Options& options) {
  PrepareFolderOf(options.out);
  const std::unique_ptr<BoardFinder> finder = MakeFinder(options);
  const SurveyedViews surveyed = SurveyViews(options.inputs, options.views, finder.get());
  CalibrationReport report{*finder, surveyed, {}, {}, options.out, {}};
  const std::string flaw = FlawOfBoard(*finder, surveyed.survey);
  if (flaw.empty()) {
    Progress progress("calibrate");
    report.result = CalibrateCamera(finder->board(), surveyed.views, surveyed.size_px,
                                    {.lens = LensOf(options.lens)}, progress.Callback());
  }
  report.coverage = UsedCoverage(finder->board(), surveyed, report.result);
  if (report.result.IsUsable()) {
    WriteCamera(report.result.camera, options);
    if (options.has_picture) {
      report.picture = PicturePath(options.out).string();
      WritePng(report.picture, DrawCalibration(surveyed.views, report.result, report.coverage,
                                               fs::path(options.out).filename().string() + ": " +
                                                   finder->board().name));
    }
  }
  PrintReport(report);
  if (!options.json.empty()) WriteReportJson(report, flaw, options.json);
  if (!flaw.empty()) return Fail(flaw);
  return report.result.IsUsable() ? kDone : Fail(report.result.BriefReport());
}

void AddBoardOptions(CLI::App* command, Options* options) {
  command->add_option("--board", options->board, "What is shown to the camera")
      ->check(CLI::IsMember({"chessboard", "aprilgrid"}))
      ->capture_default_str();
  AddCounts(command, "--corners", &options->corners,
            "Chessboard: inner corners, where four squares meet, rows x columns");
  command->add_option("--square-mm", options->square_mm, "Chessboard: edge of a square")
      ->check(IsNumber(0.1, 9999.0));
  AddCounts(command, "--tags", &options->tags, "AprilTag grid: tags, rows x columns");
  command
      ->add_option("--tag-mm", options->tag_mm,
                   "AprilTag grid: edge of a tag, between its black and its white border")
      ->check(IsNumber(0.1, 9999.0));
  command->add_option("--spacing", options->grid.spacing, "AprilTag grid: gap / edge of a tag")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--first-id", options->grid.first_id, "AprilTag grid: id at the bottom left")
      ->capture_default_str();
  command->add_option("--family", options->grid.family, "AprilTag grid: family of the tags")
      ->check(CLI::IsMember(TagFamily::Names()))
      ->capture_default_str();
  command->add_option("--target", options->target,
                      "AprilTag grid: Kalibr's target file, instead of the options above");
}

void AddOutputOptions(CLI::App* command, Options* options) {
  command
      ->add_option("--out", options->out,
                   "Camera file to write: YAML of OpenCV, or of ROS with --ros or a name with "
                   "camera_info")
      ->capture_default_str();
  command->add_flag("--ros", options->ros, "Write ROS's camera_info");
  command->add_option("--name", options->name, "Of the camera, in ROS's file [the file's name]");
  command->add_option("--json", options->json, "Write the report as JSON");
  command->add_flag("!--no-picture", options->has_picture, "Do not write OUT.coverage.png");
}

}  // namespace

CLI::App* AddCalibrate(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "calibrate", "Find a camera's focal length and lens distortion from views of a board");
  command->footer(
      "Show the board 10 to 20 times: in all corners of the picture, near and far, tilted by 30 "
      "to\n"
      "45 degrees each way. Views that do not fit the others are dropped. A camera is watched "
      "until\n"
      "its views are enough; each line on stderr says what to show next.\n"
      "Examples:\n"
      "  poselift calibrate photos/ --board chessboard --corners 4x7 --square-mm 60 --out "
      "cam.yaml\n"
      "  poselift calibrate /dev/video0 --board aprilgrid --tags 6x6 --tag-mm 24 --out cam.yaml");
  command
      ->add_option("INPUT", options->inputs,
                   "Pictures, folders of pictures, a video or a camera (/dev/video0)")
      ->required();
  AddBoardOptions(command, options.get());
  command->add_option("--lens", options->lens, "Distortion coefficients to find")
      ->check(CLI::IsMember(LensNames()))
      ->capture_default_str();
  AddOutputOptions(command, options.get());
  command->add_option("--every-s", options->views.every_s, "Video: look at a frame this often")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--seconds", options->views.seconds, "Camera: watch it for at most so long")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  AddCameraOptions(command, &options->views.device);
  command
      ->add_option("--max-views", options->views.chooser.most_views,
                   "Video and camera: use at most")
      ->check(CLI::Range(3, 1000))
      ->capture_default_str();
  command->callback([options, command] {
    const bool is_chessboard = options->board == "chessboard";
    static constexpr std::initializer_list<const char*> kOfGrid = {
        "--tags", "--tag-mm", "--spacing", "--first-id", "--family"};
    if (is_chessboard) {
      RefuseOptions(*command, kOfGrid, "it is of --board aprilgrid");
      RefuseOptions(*command, {"--target"}, "it is of --board aprilgrid");
    } else {
      RefuseOptions(*command, {"--corners", "--square-mm"}, "it is of --board chessboard");
    }
    if (!options->target.empty()) RefuseOptions(*command, kOfGrid, "the file of --target says it");
    if (is_chessboard && (options->corners.rows == 0 || options->square_mm == 0.0))
      throw CLI::RequiredError("--corners and --square-mm for a chessboard");
    if (!is_chessboard && options->target.empty() &&
        (options->tags.rows == 0 || options->tag_mm == 0.0))
      throw CLI::RequiredError("--tags and --tag-mm, or --target, for an AprilTag grid");
  });
  *run = [options] { return Calibrate(*options); };
  return command;
}

}  // namespace poselift::cli
