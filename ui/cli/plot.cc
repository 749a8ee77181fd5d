// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lift/frame_span.h"
#include "lift/temporal/foot_contact.h"
#include "src/draw/angle_plot.h"
#include "src/io/atomic_file.h"
#include "src/io/poses_json.h"
#include "src/io/text_scanner.h"
#include "src/joint_angles.h"
#include "src/nearest_names.h"
#include "ui/cli/command.h"
#include "ui/cli/motion_input.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

// As many as there are colours, and dashes.
constexpr size_t kMostAngles = 8, kMostMotions = 4;

struct Options {
  std::vector<std::string> motions;
  std::vector<std::string> angles;
  std::string out;
  std::string title;
  bool contacts = false;
  MotionInputOptions input;
};

CLI::Validator IsAngle() {
  const auto flaw = [](const std::string& name) -> std::string {
    std::vector<std::string> names;
    for (const JointAngle& angle : JointAngles()) names.push_back(angle.name);
    if (std::find(names.begin(), names.end(), name) != names.end()) return "";
    return fmt::format("found no angle {}, wanted perhaps {}", Quoted(name),
                       fmt::join(NearestNames(name, names, 3), ", "));
  };
  return {flaw, "NAME"};
}

Eigen::Index IndexOf(const std::string& name) {
  const auto& angles = JointAngles();
  return std::find_if(angles.begin(), angles.end(),
                      [&](const JointAngle& angle) { return angle.name == name; }) -
         angles.begin();
}

double TimeOf(const PosesMotion& motion, int frame) {
  const auto f = static_cast<size_t>(frame);
  return f < motion.times_s.size() ? motion.times_s[f] : frame * motion.motion.frame_time_s;
}

// Angles x frames; NaN where the frame is not known. Angles continue across gaps.
Eigen::MatrixXd AnglesOf(const Motion& motion) {
  const JointAngleReader reader(motion.skeleton);
  Eigen::MatrixXd angles_deg =
      Eigen::MatrixXd::Constant(std::ssize(JointAngles()), std::ssize(motion.frames), kUnknown);
  Eigen::VectorXd before_deg;
  for (Eigen::Index t = 0; t < angles_deg.cols(); ++t) {
    const SkeletonPose& pose = motion.frames[static_cast<size_t>(t)];
    if (!IsKnown(pose)) continue;
    before_deg = before_deg.size() == 0 ? reader.ReadDeg(pose) : reader.ReadDeg(pose, before_deg);
    angles_deg.col(t) = before_deg;
  }
  return angles_deg;
}

std::vector<TimeSpan> TimesOf(const std::vector<FrameSpan>& spans, const PosesMotion& motion) {
  std::vector<TimeSpan> times;
  const double half_s = 0.5 * motion.motion.frame_time_s;
  for (const FrameSpan& span : spans)
    times.push_back({TimeOf(motion, span.first) - half_s, TimeOf(motion, span.last) + half_s});
  return times;
}

// The curves of one motion; every angle has a colour and every motion its
// dashes, or a colour where there is but one angle.
void AddCurves(const PosesMotion& motion, size_t place, const Options& options, AnglePlot* plot) {
  const bool has_bands = motion.angles_sigma_deg.size() > 0;
  const Eigen::MatrixXd angles_deg = has_bands ? motion.angles_deg : AnglesOf(motion.motion);
  Eigen::VectorXd times_s(angles_deg.cols());
  for (Eigen::Index t = 0; t < times_s.size(); ++t)
    times_s[t] = TimeOf(motion, static_cast<int>(t));
  const bool by_color = options.angles.size() == 1;
  const std::string file = fs::path(options.motions[place]).filename().string();
  for (size_t a = 0; a < options.angles.size(); ++a) {
    const Eigen::Index row = IndexOf(options.angles[a]);
    AngleCurve& curve = plot->curves.emplace_back();
    curve.name = options.motions.size() == 1 ? options.angles[a]
                                             : fmt::format("{}, {}", options.angles[a], file);
    curve.times_s = times_s;
    curve.values_deg = angles_deg.row(row);
    if (has_bands) curve.sigmas_deg = motion.angles_sigma_deg.row(row);
    curve.color_index = static_cast<int>(by_color ? place : a);
    curve.dash_index = static_cast<int>(by_color ? 0 : place);
  }
}

int Plot(const Options& options) {
  AnglePlot plot;
  plot.title = options.title;
  plot.shaded_name = "filled";
  for (size_t m = 0; m < options.motions.size(); ++m) {
    const PosesMotion motion = ReadMotionInput(options.motions[m], options.input);
    AddCurves(motion, m, options, &plot);
    for (const TimeSpan& span : TimesOf(SpansOf(motion.is_filled), motion))
      plot.shaded.push_back(span);
    if (!options.contacts || m + 1 < options.motions.size()) continue;
    const FootContacts contacts = FindFootContacts(motion.motion);
    plot.strips = {{"left foot", TimesOf(SpansOf(contacts.Left()), motion)},
                   {"right foot", TimesOf(SpansOf(contacts.Right()), motion)}};
  }
  WriteFileAtomically(options.out, AnglePlotSvg(plot));
  return kDone;
}

}  // namespace

CLI::App* AddPlot(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("plot", "Draw joint angles of motions over time, as SVG");
  command->footer(
      "The angles are those of docs/ANGLES.md. Where poses.json says how sure they are, a band of\n"
      "one standard deviation is about them.\n"
      "Example: poselift plot walk.bvh smooth.bvh --angles left_knee.flexion,right_knee.flexion "
      "--out knees.svg");
  command
      ->add_option("MOTION", options->motions,
                   "Motions to compare: poses.json or its folder, .bvh, .amc")
      ->required();
  command->add_option("--angles", options->angles, "Joint angles, with commas between")
      ->required()
      ->delimiter(',')
      ->check(IsAngle());
  command->add_option("--out", options->out, "SVG file to write")->required();
  command->add_option("--title", options->title, "Above the plot [the motions' names]");
  command->add_flag("--contacts", options->contacts,
                    "Show when the feet of the last motion stand on the floor");
  AddMotionInputOptions(command, &options->input);
  command->callback([options] {
    const size_t most_motions = options->angles.size() == 1 ? kMostAngles : kMostMotions;
    if (options->angles.size() > kMostAngles || options->motions.size() > most_motions)
      throw CLI::ValidationError(fmt::format(
          "found {} angles of {} motions, wanted at most {} angles of {} motions, or one angle of "
          "{}",
          options->angles.size(), options->motions.size(), kMostAngles, kMostMotions, kMostAngles));
    for (std::string& motion : options->motions)
      if (fs::is_directory(motion)) motion = (fs::path(motion) / "poses.json").string();
    if (!options->title.empty()) return;
    for (const std::string& motion : options->motions)
      options->title += (options->title.empty() ? "" : ", ") + fs::path(motion).filename().string();
  });
  options->input.with_filled = true;
  *run = [options] { return Plot(*options); };
  return command;
}

}  // namespace poselift::cli
