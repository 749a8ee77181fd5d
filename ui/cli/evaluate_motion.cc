// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "lift/baselines/frame_ik.h"
#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/eval/evaluate_motion.h"
#include "lift/temporal/motion_reconstruction.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/atomic_file.h"
#include "ui/cli/evaluate.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

// The actions of the motion paper's figure 3, and the trials that stand for them.
struct Action {
  std::string name;
  std::vector<std::string> trials;
};

const std::vector<Action> kActions = {{"walking", {"07_05", "16_15", "02_01"}},
                                      {"running", {"09_05", "16_36"}},
                                      {"jumping", {"16_03", "49_02", "01_01"}},
                                      {"punching", {"02_05", "14_02", "17_10"}},
                                      {"golf", {"golf"}}};

// Of these the methods take the neighbours.
const SegmentSearchOptions kCandidates{.num_nearest = 200, .exclusion_frames = 15, .width = 200};

struct Options {
  std::string mocap;
  std::string asf;
  std::string json;
  double fps = 60.0;
  EvaluateMotionOptions evaluation;
};

// What every method shares.
struct Experiment {
  MotionDatabase database;
  std::vector<MotionTrial> trials;
};

Experiment Load(const Options& options) {
  const auto sources = FindMotions(options.mocap, {.fallback_asf = options.asf});
  const Skeleton standard = ReadDictionary(DefaultDictionaryPath()).skeleton;
  const double frame_time_s = 1.0 / options.fps;
  Experiment experiment;
  std::vector<std::string> held_out;
  for (const Action& action : kActions)
    for (const std::string& trial : action.trials) {
      held_out.push_back(trial);
      const MotionSource source = ChooseTrials(sources, {trial}, {}).front();
      const Motion motion = ReadAmc(source.amc, ReadAsfSkeleton(source.asf));
      experiment.trials.push_back(
          {action.name, trial, OnStandardSkeleton(motion, standard, frame_time_s)});
    }
  const auto rest = ChooseTrials(sources, {}, held_out);
  Progress progress("read", static_cast<int64_t>(rest.size()), "files");
  experiment.database =
      LoadMotionDatabase(rest, standard, {.frame_time_s = frame_time_s}, progress.Callback());
  return experiment;
}

// Means over trials within an action, then over actions: each counts the same.
struct Cell {
  double position_mm = 0.0, angle_deg = 0.0, acceleration_mm = 0.0, ms_per_frame = 0.0;
};

Cell Mean(const std::vector<Cell>& cells) {
  Cell mean;
  for (const Cell& cell : cells) {
    mean.position_mm += cell.position_mm / static_cast<double>(cells.size());
    mean.angle_deg += cell.angle_deg / static_cast<double>(cells.size());
    mean.acceleration_mm += cell.acceleration_mm / static_cast<double>(cells.size());
    mean.ms_per_frame += cell.ms_per_frame / static_cast<double>(cells.size());
  }
  return mean;
}

Cell MeanOf(const std::vector<MotionEvaluation>& rows, const std::string& method,
            const std::string& points, const std::string& action) {
  std::vector<Cell> cells;
  for (const MotionEvaluation& row : rows)
    if (row.method == method && row.control_points == points && row.action == action)
      cells.push_back({row.position_mm, row.angle_deg, row.acceleration_mm, row.ms_per_frame});
  return Mean(cells);
}

void Print(const std::vector<MotionEvaluation>& rows, const std::vector<std::string>& methods,
           const EvaluateMotionOptions& options) {
  fmt::print("{:<28} {:>6}", "method", "points");
  for (const Action& action : kActions) fmt::print(" {:>16}", action.name);
  fmt::print(" {:>16} {:>9} {:>8}\n", "mean", "jitter mm", "ms/frame");
  for (const std::string& method : methods)
    for (const ControlPoints& points : options.control_points) {
      fmt::print("{:<28} {:>6}", method, points.name);
      std::vector<Cell> cells;
      for (const Action& action : kActions) {
        cells.push_back(MeanOf(rows, method, points.name, action.name));
        fmt::print(" {:>6.1f} mm {:>4.1f} deg", cells.back().position_mm, cells.back().angle_deg);
      }
      const Cell mean = Mean(cells);
      fmt::print(" {:>6.1f} mm {:>4.1f} deg {:>9.2f} {:>8.2f}\n", mean.position_mm, mean.angle_deg,
                 mean.acceleration_mm, mean.ms_per_frame);
    }
}

void WriteJson(const std::vector<MotionEvaluation>& rows, const Options& options,
               const Experiment& experiment) {
  std::vector<std::string> held_out;
  for (const MotionTrial& trial : experiment.trials) held_out.push_back(trial.name);
  nlohmann::ordered_json json = {
      {"command", "evaluate motion"},
      {"data", std::filesystem::path(options.mocap).filename().string()},
      {"split", {{"test_trials", held_out}, {"database", "all other trials"}}},
      {"seed", 0},
      {"database_frames", experiment.database.NumFrames()},
      {"fps", options.fps},
      {"rows", nlohmann::ordered_json::array()}};
  for (const MotionEvaluation& row : rows)
    json["rows"].push_back({{"method", row.method},
                            {"action", row.action},
                            {"trial", row.trial},
                            {"control_points", row.control_points},
                            {"frames", row.num_frames},
                            {"position_mm", row.position_mm},
                            {"angle_deg", row.angle_deg},
                            {"acceleration_mm", row.acceleration_mm},
                            {"ms_per_frame", row.ms_per_frame}});
  WriteFileAtomically(options.json, json.dump(1) + "\n");
}

// How fast each feature changes from one frame to the next, for inverse
// kinematics that knows no more of motion.
FeatureVector ChangesOf(const MotionDatabase& database) {
  FeatureVector squares = FeatureVector::Constant(1e-12);
  long count = 0;
  for (const Trial& trial : database.trials)
    for (int t = 1; t < trial.num_frames; ++t, ++count)
      squares += (database.features.col(trial.first_frame + t) -
                  database.features.col(trial.first_frame + t - 1))
                     .cast<double>()
                     .cwiseAbs2();
  FeatureVector sigmas = (squares / std::max(1L, count)).cwiseSqrt();
  // The place, not the speed, is what stays.
  for (int row : {feature::kVelocity, feature::kVelocity + 1, feature::kYawRate})
    sigmas[row] = std::sqrt(database.features.row(row).cast<double>().squaredNorm() /
                            std::max(1, database.NumFrames()));
  return sigmas;
}

// Regression as the papers have it: the neighbours of the last poses alone.
MotionReconstructionOptions AsInPapers(LocalRegressionMethod method) {
  MotionReconstructionOptions options;
  options.observed_scale_per_m = 0.0;
  options.regression = {.method = method};
  return options;
}

std::vector<NamedMotionMethod> Methods(const Experiment& experiment, const SegmentSearch& search) {
  const auto regression = [&](std::string name, const MotionReconstructionOptions& options) {
    return NamedMotionMethod{std::move(name), [&, options] {
                               return std::make_unique<MotionReconstruction>(experiment.database,
                                                                             search, options);
                             }};
  };
  const FeatureVector sigmas = ChangesOf(experiment.database);
  return {
      {"inverse kinematics",
       [&experiment, sigmas] {
         return std::make_unique<FrameIk>(experiment.database.skeleton,
                                          experiment.database.frame_time_s, sigmas);
       }},
      regression("local PCR", AsInPapers(LocalRegressionMethod::kPrincipalComponents)),
      regression("local regression, as printed", AsInPapers(LocalRegressionMethod::kAsPrinted)),
      regression("local regression, PLS", AsInPapers(LocalRegressionMethod::kPartialLeastSquares)),
      regression("local regression, ridge", AsInPapers(LocalRegressionMethod::kRidge)),
      regression("poselift", {})};
}

int EvaluateMotions(const Options& options) {
  const Experiment experiment = Load(options);
  const MotionDatabase& database = experiment.database;
  const SegmentSearch search(database, RowWeights(database), kCandidates);
  const std::vector<NamedMotionMethod> methods = Methods(experiment, search);
  Progress progress("reconstruct");
  const auto rows =
      EvaluateMotion(methods, experiment.trials, options.evaluation, progress.Callback());
  fmt::print("{} database frames at {} Hz, mirror images too; {} test trials\n",
             database.NumFrames(), options.fps, experiment.trials.size());
  std::vector<std::string> names;
  for (const NamedMotionMethod& method : methods) names.push_back(method.name);
  Print(rows, names, options.evaluation);
  if (!options.json.empty()) WriteJson(rows, options, experiment);
  return kDone;
}

}  // namespace

CLI::App* AddEvaluateMotion(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "motion", "Motions known at a few control points, reconstructed by every method");
  command->footer(
      "Example:\n  poselift evaluate motion --mocap mocap/ --asf mocap/cmu/02/02.asf --json "
      "motion.json");
  command->add_option("--mocap", options->mocap, "Folder with .amc and .asf files")->required();
  command->add_option("--asf", options->asf, "Skeleton of AMC files that have none of their own");
  command->add_option("--json", options->json, "Write the numbers there too");
  command->add_option("--fps", options->fps, "Frames a second")->capture_default_str();
  command->add_option("--frames", options->evaluation.max_frames, "At most so many of a trial")
      ->capture_default_str();
  *run = [options] { return EvaluateMotions(*options); };
  return command;
}

}  // namespace poselift::cli
