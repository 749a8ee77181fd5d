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
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lift/eval/evaluate_motion.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "ui/cli/evaluate.h"
#include "ui/cli/motion_experiment.h"
#include "ui/cli/motion_methods.h"
#include "ui/cli/motion_report.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

struct Options {
  MotionExperimentOptions experiment;
  int max_frames = EvaluateMotionOptions().max_frames;
  // By name; empty: all.
  std::vector<std::string> methods;
  std::vector<std::string> points;
  std::string json;
  std::string plots;
};

bool IsWanted(const std::string& method, const Options& options) {
  const auto& names = options.methods;
  return names.empty() || std::find(names.begin(), names.end(), method) != names.end();
}

void RequireMethods(const std::vector<NamedMotionMethod>& methods, const Options& options) {
  for (const std::string& name : options.methods)
    if (name != MotionMethods::kGplvmOfTheAction &&
        std::none_of(methods.begin(), methods.end(),
                     [&](const auto& method) { return method.name == name; }))
      throw InputError("--methods: found '" + name + "', wanted names of the table");
}

std::vector<ControlPoints> WantedPoints(const Options& options) {
  std::vector<ControlPoints> wanted;
  for (const ControlPoints& points : PaperControlPoints())
    if (options.points.empty() || std::find(options.points.begin(), options.points.end(),
                                            points.name) != options.points.end())
      wanted.push_back(points);
  return wanted;
}

// Every method that is wanted; the GPLVM of an action on the trials of that action.
MotionReport Evaluate(const MotionDatabase& database, const MotionExperiment& experiment,
                      const std::vector<ControlPoints>& control_points, const Options& options) {
  MotionMethods all(database, options.experiment.seed);
  std::vector<NamedMotionMethod> methods = all.All();
  RequireMethods(methods, options);
  std::erase_if(methods, [&](const auto& method) { return !IsWanted(method.name, options); });
  EvaluateMotionOptions evaluation;
  evaluation.control_points = control_points;
  evaluation.max_frames = options.max_frames;
  Progress progress("reconstruct");
  auto rows = EvaluateMotion(methods, experiment.trials, evaluation, progress.Callback());
  for (const std::string& action : experiment.actions) {
    if (!IsWanted(MotionMethods::kGplvmOfTheAction, options)) break;
    std::vector<MotionTrial> trials;
    for (const MotionTrial& trial : experiment.trials)
      if (trial.action == action) trials.push_back(trial);
    const auto more = EvaluateMotion({all.GplvmOf(action)}, trials, evaluation, {});
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return MotionReport(std::move(rows));
}

void AddRows(const MotionReport& report, const char* database, nlohmann::ordered_json* rows) {
  for (const MotionEvaluation& row : report.rows())
    rows->push_back({{"method", row.method},
                     {"database", database},
                     {"action", row.action},
                     {"trial", row.trial},
                     {"control_points", row.control_points},
                     {"frames", row.num_frames},
                     {"position_mm", row.position_mm},
                     {"angle_deg", row.angle_deg},
                     {"acceleration_mm", row.acceleration_mm},
                     {"ms_per_frame", row.ms_per_frame}});
}

void WriteJson(const MotionReport& all, const MotionReport& small, const Options& options,
               const MotionExperiment& experiment) {
  std::vector<std::string> trials;
  for (const MotionTrial& trial : experiment.trials) trials.push_back(trial.name);
  const MotionExperimentOptions& asked = options.experiment;
  nlohmann::ordered_json json = {
      {"command", "evaluate motion"},
      {"data", std::filesystem::path(asked.mocap).filename().string()},
      {"split",
       {{"test_trials", trials},
        {"database", asked.held_out ? "neither test nor held-out trials" : "all other trials"}}},
      {"seed", asked.seed},
      {"database_frames", experiment.database.NumFrames()},
      {"small_database_frames", experiment.small.NumFrames()},
      {"fps", asked.fps},
      {"rows", nlohmann::ordered_json::array()}};
  AddRows(all, "all", &json["rows"]);
  AddRows(small, "small", &json["rows"]);
  WriteFileAtomically(options.json, json.dump(1) + "\n");
}

void WritePlots(const MotionReport& report, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const std::string points : {"6", "4"}) {
    if (!report.HasPoints(points)) continue;
    for (const bool degrees : {false, true})
      WriteFileAtomically(
          folder / fmt::format("motion_{}_points_{}.svg", points, degrees ? "deg" : "mm"),
          report.Chart(MethodsOfThePaper(), points, degrees));
  }
}

int EvaluateMotions(const Options& options) {
  const MotionExperiment experiment = LoadMotionExperiment(options.experiment);
  const MotionReport all =
      Evaluate(experiment.database, experiment, WantedPoints(options), options);
  fmt::print("{} database frames at {} Hz, mirror images too; {} test trials\n",
             experiment.database.NumFrames(), options.experiment.fps, experiment.trials.size());
  all.Print();
  const MotionReport small =
      Evaluate(experiment.small, experiment, {PaperControlPoints().back()}, options);
  fmt::print("\n{} database frames, trials drawn with seed {}\n", experiment.small.NumFrames(),
             options.experiment.seed);
  small.Print();
  if (!options.json.empty()) WriteJson(all, small, options, experiment);
  if (!options.plots.empty()) WritePlots(all, options.plots);
  return kDone;
}

}  // namespace

CLI::App* AddEvaluateMotion(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "motion", "Motions known at a few control points, reconstructed by every method");
  command->footer(
      "Example:\n  poselift evaluate motion --mocap mocap/ --asf mocap/cmu/02/02.asf --json "
      "motion.json --plots figures/");
  MotionExperimentOptions& experiment = options->experiment;
  command->add_option("--mocap", experiment.mocap, "Folder with .amc and .asf files")->required();
  command->add_option("--asf", experiment.asf, "Skeleton of AMC files that have none of their own");
  command->add_option("--json", options->json, "Write the numbers there too");
  command->add_option("--plots", options->plots, "Write bar charts (SVG) into this folder");
  command->add_option("--methods", options->methods, "Only these, by their names in the table");
  command->add_option("--points", options->points, "Only these numbers of control points, 2 to 6")
      ->delimiter(',')
      ->check(CLI::IsMember({"2", "3", "4", "5", "6"}));
  command->add_option("--fps", experiment.fps, "Frames a second")->capture_default_str();
  command->add_option("--frames", options->max_frames, "At most so many of a trial")
      ->capture_default_str();
  command
      ->add_option("--seed", experiment.seed,
                   "Of the small database and of the frames that the GPLVM learns")
      ->capture_default_str();
  command->add_flag("--held-out", experiment.held_out,
                    "The trials on which settings were chosen, instead of the test trials");
  *run = [options] { return EvaluateMotions(*options); };
  return command;
}

}  // namespace poselift::cli
