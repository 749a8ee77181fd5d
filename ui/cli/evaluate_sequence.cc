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
#include <utility>
#include <vector>

#include "lift/eval/evaluate_sequence.h"
#include "lift/eval/sequence_error.h"
#include "lift/lift_sequence.h"
#include "lift/temporal/motion_database.h"
#include "lift/temporal/resample.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/atomic_file.h"
#include "ui/cli/evaluate.h"
#include "ui/cli/held_out_models.h"
#include "ui/cli/progress.h"
#include "ui/cli/sequence_methods.h"
#include "ui/cli/sequence_report.h"

namespace poselift::cli {
namespace {

constexpr double kFrameTime_s = 1.0 / 30.0;
// What the plots show besides the best filter, where it was run.
const std::string kFrameAlone = "each frame alone", kPoselift = "poselift",
                  kStandardBones = "poselift, standard bones";
constexpr const char* kPlottedAngle = "left_knee.flexion";

struct Options {
  std::string mocap, dictionary, motion_model, json, plots;
  std::vector<std::string> train_subjects = {"01", "02", "03", "05", "14", "17", "29"};
  std::vector<std::string> trials = {"07_05", "09_05", "09_12", "16_03", "16_15",
                                     "16_22", "16_36", "49_02", "49_06"};
  std::vector<std::string> methods;  // with their filters; empty: all
  size_t max_frames = 150;
  EvaluateSequenceOptions evaluation;
  LiftSequenceOptions together;
};

// The subjects' motions; a trial's name begins with its subject's.
std::vector<MotionSource> FindSources(const Options& options) {
  std::vector<std::string> subjects;
  if (options.dictionary.empty() || options.motion_model.empty()) subjects = options.train_subjects;
  for (const std::string& trial : options.trials)
    subjects.push_back(trial.substr(0, trial.find('_')));
  return FindMotions(options.mocap, {.subjects = subjects});
}

std::vector<SequenceTrial> LoadTrials(const std::vector<MotionSource>& sources,
                                      const Skeleton& standard, const Options& options) {
  std::vector<SequenceTrial> trials;
  for (const std::string& name : options.trials)
    for (const MotionSource& source : ChooseTrials(sources, {name}, {})) {
      const Motion motion = ReadAmc(source.amc, ReadAsfSkeleton(source.asf));
      SequenceTrial trial{source.amc.stem(), Resample(motion, kFrameTime_s),
                          OnStandardSkeleton(motion, standard, kFrameTime_s)};
      for (Motion* part : {&trial.own, &trial.standard})
        part->frames.resize(std::min(part->frames.size(), options.max_frames));
      if (trial.own.frames.size() < kFewestLagFrames)
        throw InputError(source.amc, fmt::format("found {} frames at 30 Hz, wanted at least {}",
                                                 trial.own.frames.size(), kFewestLagFrames));
      trials.push_back(std::move(trial));
    }
  return trials;
}

std::vector<NamedSequenceMethod> WantedMethods(const Dictionary& dictionary,
                                               const MotionCodebook& codebook,
                                               const Options& options) {
  std::vector<NamedSequenceMethod> methods =
      SequenceMethods(dictionary, codebook, options.together);
  if (options.methods.empty()) return methods;
  for (const std::string& name : options.methods)
    if (std::none_of(methods.begin(), methods.end(),
                     [&](const auto& method) { return method.name == name; }))
      throw InputError("--methods: found '" + name + "', wanted names of methods that lift");
  std::erase_if(methods, [&](const auto& method) {
    return std::find(options.methods.begin(), options.methods.end(), method.name) ==
           options.methods.end();
  });
  return methods;
}

void WriteJson(const SequenceReport& report, const Options& options, const Dictionary& dictionary) {
  using Json = nlohmann::ordered_json;
  const SequenceViewOptions& view = options.evaluation.view;
  Json train = options.train_subjects;
  if (!options.dictionary.empty()) train = dictionary.record.sources;
  Json json = {{"command", "evaluate sequence"},
               {"data", std::filesystem::path(options.mocap).filename().string()},
               {"split", {{"train", train}, {"test_trials", report.trials()}}},
               {"seed", options.evaluation.seed},
               {"layout", options.evaluation.layout},
               {"atoms", dictionary.NumAtoms()},
               {"fps", 1.0 / kFrameTime_s},
               {"body_height_px", view.body_height_px},
               {"missing_share", view.missing_share},
               {"rows", Json::array()},
               {"trials", Json::array()}};
  for (const double noise_px : report.noises_px())
    for (const std::string& method : report.methods()) {
      const SequenceMean cell = report.MeanOf(method, noise_px);
      Json row = {{"method", method}, {"noise_px", noise_px}};
      for (int i = 0; i < measure::kNumMeasures; ++i) {
        row[MeasureNames()[static_cast<size_t>(i)]] = cell.mean[i];
        row[MeasureNames()[static_cast<size_t>(i)] + "_standard_error"] = cell.standard_error[i];
      }
      json["rows"].push_back(std::move(row));
    }
  for (const SequenceEvaluation& evaluation : report.rows()) {
    Json row = {{"method", evaluation.method},
                {"noise_px", evaluation.noise_px},
                {"trial", evaluation.trial},
                {"frames", evaluation.poses.size()}};
    for (int i = 0; i < measure::kNumMeasures; ++i)
      row[MeasureNames()[static_cast<size_t>(i)]] = evaluation.errors[i];
    for (int g = 0; g < kNumBoneGroups; ++g)
      row["too_long_percent"][std::string(BoneGroupNames()[g])] = evaluation.bones_percent[g];
    json["trials"].push_back(std::move(row));
  }
  WriteFileAtomically(options.json, json.dump(1) + "\n");
}

void WritePlots(const SequenceReport& report, const std::vector<SequenceTrial>& trials,
                const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto was_run = [&](const std::string& method) {
    return std::find(report.methods().begin(), report.methods().end(), method) !=
           report.methods().end();
  };
  for (const double noise_px : report.noises_px()) {
    std::vector<std::string> shown = {
        kFrameAlone, report.Best(noise_px, {kFrameAlone, kPoselift, kStandardBones}), kPoselift};
    std::erase_if(shown, [&](const std::string& method) { return !was_run(method); });
    WriteFileAtomically(folder / fmt::format("sequence_{:g}px_mm.svg", noise_px),
                        report.Chart(shown, noise_px));
    for (const SequenceTrial& trial : trials)
      WriteFileAtomically(folder / fmt::format("sequence_{:g}px_{}.svg", noise_px, trial.name),
                          report.Plot(shown, noise_px, trial, kPlottedAngle));
  }
}

int Evaluate(const Options& options) {
  const auto sources = FindSources(options);
  const HeldOutModels models{options.dictionary, options.motion_model, options.train_subjects,
                             options.trials};
  const Dictionary dictionary = LearnDictionary(sources, models);
  const MotionCodebook codebook = LearnMotion(sources, dictionary.skeleton, models);
  const auto trials = LoadTrials(sources, dictionary.skeleton, options);
  const auto methods = WantedMethods(dictionary, codebook, options);
  std::vector<SequenceEvaluation> rows;
  {
    Progress progress("lift");
    rows = EvaluateSequences(methods, trials, options.evaluation, progress.Callback());
  }
  const SequenceReport report(std::move(rows));
  size_t num_frames = 0;
  for (const SequenceTrial& trial : trials) num_frames += trial.own.frames.size();
  fmt::print(
      "{} atoms, {} segments; {} trials, {} frames at 30 Hz; body {:g} px high, {:g} % of the "
      "labels "
      "missing, seed {}, {}; mean over the trials ± standard error\n",
      dictionary.NumAtoms(), codebook.NumSegments(), trials.size(), num_frames,
      options.evaluation.view.body_height_px, 100.0 * options.evaluation.view.missing_share,
      options.evaluation.seed, options.evaluation.layout);
  report.Print();
  if (!options.json.empty()) WriteJson(report, options, dictionary);
  if (!options.plots.empty()) WritePlots(report, trials, options.plots);
  return kDone;
}

}  // namespace

CLI::App* AddEvaluateSequence(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "sequence", "Noisy labels of known motions before a fixed camera, lifted by every method");
  command->footer(
      "Example:\n  poselift evaluate sequence --mocap mocap/ --json sequence.json --plots "
      "figures/");
  EvaluateSequenceOptions& evaluation = options->evaluation;
  command->add_option("--mocap", options->mocap, "Folder with .amc and .asf files")->required();
  command->add_option("--motion-model", options->motion_model,
                      "Use this motion codebook and learn none");
  command->add_option("--json", options->json, "Write the numbers there too");
  command->add_option("--plots", options->plots, "Write pictures (SVG) into this folder");
  command->add_option("--trials", options->trials, "Trials, or subjects, to lift")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--train", options->train_subjects, "Subjects to learn from")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--dictionary", options->dictionary,
                      "Use this one instead of learning (not one that has seen the trials)");
  command->add_option("--methods", options->methods,
                      "Only these that lift, by their names in the table, with their filters");
  command->add_option("--frames", options->max_frames, "At most so many of a trial, at 30 Hz")
      ->check(CLI::Range(static_cast<size_t>(kFewestLagFrames), size_t{1000000}))
      ->capture_default_str();
  command->add_option("--noise-px", evaluation.noises_px, "Of each label coordinate")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command->add_option("--missing", evaluation.view.missing_share, "Share of the labels left out")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  LiftSequenceOptions& together = options->together;
  for (const auto& [name, factor] :
       {std::pair{"--trunk-sigma-factor", &together.trunk_sigma_factor},
        {"--limb-sigma-factor", &together.limb_sigma_factor}})
    command->add_option(name, *factor, "Of the standard deviations that poselift gives its angles")
        ->check(CLI::Range(1e-3, 1e3))
        ->capture_default_str();
  command->add_option("--seed", evaluation.seed, "Of cameras, noise and missing labels")
      ->capture_default_str();
  *run = [options] { return Evaluate(*options); };
  return command;
}

}  // namespace poselift::cli
