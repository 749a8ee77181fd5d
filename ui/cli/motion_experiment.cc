// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/motion_experiment.h"

#include <fmt/format.h>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

// The poses of the two databases of the paper's table 2.
constexpr double kSmallPart = 69888.0 / 1.1e6;

void AppendRange(const char* subject, int first, int last, std::vector<std::string>* names) {
  for (int trial = first; trial <= last; ++trial)
    names->push_back(fmt::format("{}_{:02}", subject, trial));
}

std::vector<Action> MakeActions() {
  std::vector<Action> actions = {
      {"walking", {"07_05", "16_15", "02_01"}, {"16_22", "02_02"}, {"02_02", "16_47", "16_58"}},
      {"running", {"09_05", "16_36"}, {"09_08", "16_45"}, {"02_03"}},
      {"jumping",
       {"16_03", "49_02", "01_01"},
       {"16_05", "49_03", "01_05"},
       {"01_05", "02_04", "49_03"}},
      {"punching", {"02_05", "14_02", "17_10"}, {}, {}},
      {"golf", {"golf"}, {}, {}},
      {"other", {}, {"14_04", "02_06"}, {}}};
  AppendRange("16", 11, 34, &actions[0].similar);
  AppendRange("09", 1, 11, &actions[1].similar);
  AppendRange("16", 35, 46, &actions[1].similar);
  AppendRange("16", 48, 57, &actions[1].similar);
  AppendRange("16", 1, 10, &actions[2].similar);
  return actions;
}

}  // namespace

const std::vector<Action>& PaperActions() {
  static const std::vector<Action> kActions = MakeActions();
  return kActions;
}

MotionExperiment LoadMotionExperiment(const MotionExperimentOptions& options) {
  const auto sources = FindMotions(options.mocap, {.fallback_asf = options.asf});
  const Skeleton standard = ReadDictionary(DefaultDictionaryPath()).skeleton;
  const double frame_time_s = 1.0 / options.fps;
  MotionExperiment experiment;
  std::vector<std::string> excluded;
  for (const Action& action : PaperActions()) {
    excluded.insert(excluded.end(), action.trials.begin(), action.trials.end());
    if (options.held_out)
      excluded.insert(excluded.end(), action.held_out.begin(), action.held_out.end());
    const auto& trials = options.held_out ? action.held_out : action.trials;
    if (!trials.empty()) experiment.actions.push_back(action.name);
    for (const std::string& trial : trials) {
      const MotionSource source = ChooseTrials(sources, {trial}, {}).front();
      const Motion motion = ReadAmc(source.amc, ReadAsfSkeleton(source.asf));
      experiment.trials.push_back(
          {action.name, trial, OnStandardSkeleton(motion, standard, frame_time_s)});
    }
  }
  const auto rest = ChooseTrials(sources, {}, excluded);
  Progress progress("read", static_cast<int64_t>(rest.size()), "files");
  experiment.database =
      LoadMotionDatabase(rest, standard, {.frame_time_s = frame_time_s}, progress.Callback());
  const auto small = static_cast<int>(kSmallPart * experiment.database.NumFrames());
  experiment.small = DrawTrials(experiment.database, small, options.seed);
  return experiment;
}

}  // namespace poselift::cli
