// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "src/input_error.h"
#include "src/io/motion_file.h"
#include "src/io/text_scanner.h"
#include "src/units.h"
#include "ui/cli/command.h"
#include "ui/cli/frame_rate.h"

namespace poselift::cli {
namespace {

struct ConvertOptions {
  std::string in;
  std::string out;
  std::string skeleton;
  std::string units;
  std::string input_units;
  double fps = 0.0;  // 0: as the file says
};

bool HasEnding(const std::string& path, std::string_view ending) {
  return EqualsIgnoringCase(std::filesystem::path(path).extension().string(), ending);
}

std::string UnitOr(const std::string& unit, const std::string& otherwise) {
  return unit.empty() ? otherwise : unit;
}

// A rotation that an angle of the target cannot say is worth a word from here.
constexpr double kNoteworthy_deg = 0.01;

void PrintReport(const RebaseReport& report) {
  if (report.worst_rotation_rad * kDegFromRad > kNoteworthy_deg)
    std::fprintf(stderr,
                 "note: the skeleton's dofs cannot express all of the motion: %.2f degrees are "
                 "lost at worst (bone %s, frame %d)\n",
                 report.worst_rotation_rad * kDegFromRad, report.worst_bone.c_str(),
                 report.worst_frame + 1);
  if (report.bones_at_rest.empty()) return;
  std::string names;
  for (const std::string& name : report.bones_at_rest) names += " " + name;
  std::fprintf(stderr, "note: bones the motion does not have stay at rest:%s\n", names.c_str());
}

int Convert(const ConvertOptions& options) {
  const bool to_bvh = HasEnding(options.out, ".bvh");
  // --units is of the file written; where that has its own unit, of the one read.
  const std::string in_unit =
      UnitOr(options.input_units, to_bvh ? "cm" : UnitOr(options.units, "cm"));
  const std::string out_unit = UnitOr(options.units, "cm");
  const bool reads_amc = HasEnding(options.in, ".amc");

  ReadMotionOptions read{.metres_per_unit = *MetresPerUnit(in_unit)};
  if (reads_amc) read.skeleton = options.skeleton;
  if (options.fps > 0.0) read.frame_time_s = 1.0 / options.fps;
  const Motion motion = ReadMotion(options.in, read);

  WriteMotionOptions write{.metres_per_unit = *MetresPerUnit(out_unit)};
  if (!reads_amc) write.skeleton = options.skeleton;
  PrintReport(WriteMotion(motion, options.out, write));
  if (to_bvh)
    std::fprintf(stderr, "%s: lengths in %s; to have metres, import it with scale %g\n",
                 options.out.c_str(), out_unit.c_str(), write.metres_per_unit);
  return kDone;
}

}  // namespace

CLI::App* AddConvert(CLI::App* app, Run* run) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app->add_subcommand("convert", "Convert a motion between BVH and ASF/AMC");
  command->add_option("IN", options->in, "Motion to read: .bvh, .amc, .asf")->required();
  command->add_option("OUT", options->out, "File to write: .bvh, .amc, .asf")->required();
  command->add_option("--skeleton", options->skeleton,
                      "ASF of IN.amc (else the one beside it), or the ASF to put another motion on "
                      "when OUT is an .amc (else OUT.asf is written)");
  const CLI::IsMember units({"m", "cm", "mm", "in"});
  command
      ->add_option("--units", options->units,
                   "Unit of lengths in OUT.bvh, or in IN.bvh when OUT is no BVH [cm]")
      ->check(units);
  command->add_option("--input-units", options->input_units, "Unit of lengths in IN.bvh [cm]")
      ->check(units);
  command
      ->add_option(
          "--fps", options->fps,
          "Frame rate of IN instead of what it says [AMC: 120]; no frame is added or dropped")
      ->check(IsFrameRate());
  command->footer("Example: poselift convert 02_01.amc walk.bvh --units m");
  *run = [options] { return Convert(*options); };
  return command;
}

}  // namespace poselift::cli
