// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "lift/baselines/nearest_exemplar.h"
#include "lift/eval/evaluate_lift.h"
#include "lift/lift_photo.h"
#include "lift/normalize.h"
#include "lift/train/train_dictionary.h"
#include "lift/train/training_poses.h"
#include "src/io/atomic_file.h"
#include "ui/cli/evaluate.h"
#include "ui/cli/methods.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

struct Options {
  std::string mocap;
  std::string json;
  std::vector<std::string> train_subjects = {"01", "02", "03", "05", "14", "17", "29"};
  std::vector<std::string> test_subjects = {"07", "09", "16", "49"};
  TrainOptions train;
  EvaluateLiftOptions evaluation;
  int exemplars = 10000;
  std::vector<int> hints;
};

LiftMethod CodeOnly(std::string name, const Dictionary& dictionary, const LifterOptions& options) {
  auto lifter = std::make_shared<Lifter>(dictionary, options);
  const Eigen::VectorXd lengths_m = BoneLengths(dictionary.skeleton);
  return {std::move(name), [lifter, lengths_m](const Observation& observation) {
            const auto solutions = lifter->Solve(observation);
            std::optional<Pose3> joints;
            if (!solutions.empty())
              joints = NormalizePose(
                  CamFromBody(solutions[0].tau_rad) * Unstacked(solutions[0].pose_in_body_m),
                  lengths_m);
            return joints;
          }};
}

LiftMethod Whole(std::string name, const Dictionary& dictionary) {
  auto lifter = std::make_shared<PhotoLifter>(dictionary);
  return {std::move(name), [lifter](const Observation& observation) {
            const LiftResult result = lifter->LiftPhoto(observation);
            std::optional<Pose3> joints;
            if (result.IsUsable()) joints = result.poses.front().joints_in_cam_m;
            return joints;
          }};
}

// The training frames (and their mirror images), thinned to about `count`.
LiftMethod Exemplars(const Eigen::MatrixXd& poses_m, int count) {
  const Eigen::Index stride = std::max<Eigen::Index>(1, 2 * poses_m.cols() / count);
  Eigen::MatrixXd thinned(poses_m.rows(), poses_m.cols() / stride);
  for (Eigen::Index i = 0; i < thinned.cols(); ++i) thinned.col(i) = poses_m.col(i * stride);
  auto exemplars = std::make_shared<NearestExemplar>(WithMirrored(thinned));
  return {"nearest exemplar",
          [exemplars](const Observation& observation) { return exemplars->Lift(observation); }};
}

void Print(const std::vector<LiftEvaluation>& rows) {
  fmt::print("{:<6} {:>5}  {:<28} {:>14} {:>9} {:>14} {:>9} {:>8} {:>6} {:>6} {:>6}\n", "views",
             "noise", "method", "PA mm", "median", "CAM mm", "median", "ms/lift", "failed", "hints",
             "hinted");
  for (const LiftEvaluation& row : rows)
    fmt::print(
        "{:<6} {:>5.0f}  {:<28} {:>8.1f} ±{:>4.1f} {:>9.1f} {:>8.1f} ±{:>4.1f} {:>9.1f} "
        "{:>8.1f} {:>6} {:>6.2f} {:>6}\n",
        row.views, row.noise_mm, row.method, row.pa_mm, row.pa_standard_error_mm, row.pa_median_mm,
        row.cam_mm, row.cam_standard_error_mm, row.cam_median_mm, row.ms_per_lift, row.num_failed,
        row.num_hints, row.num_hinted);
}

void WriteJson(const std::vector<LiftEvaluation>& rows, const Options& options, int num_atoms) {
  nlohmann::ordered_json json = {
      {"command", "evaluate lift"},
      {"data", std::filesystem::path(options.mocap).filename().string()},
      {"split", {{"train", options.train_subjects}, {"test", options.test_subjects}}},
      {"seed", options.evaluation.seed},
      {"layout", options.evaluation.layout},
      {"atoms", num_atoms},
      {"rows", nlohmann::ordered_json::array()}};
  for (const LiftEvaluation& row : rows)
    json["rows"].push_back({{"method", row.method},
                            {"views", row.views},
                            {"noise_mm", row.noise_mm},
                            {"poses", row.num_poses},
                            {"failed", row.num_failed},
                            {"pa_mm", row.pa_mm},
                            {"pa_standard_error_mm", row.pa_standard_error_mm},
                            {"pa_median_mm", row.pa_median_mm},
                            {"cam_mm", row.cam_mm},
                            {"cam_standard_error_mm", row.cam_standard_error_mm},
                            {"cam_median_mm", row.cam_median_mm},
                            {"ms_per_lift", row.ms_per_lift},
                            {"hints", row.num_hints},
                            {"hinted_poses", row.num_hinted}});
  WriteFileAtomically(options.json, json.dump(1) + "\n");
}

int EvaluateLifts(const Options& options) {
  const auto load = [&](const std::vector<std::string>& subjects, bool own_proportions) {
    const auto sources = FindMotions(options.mocap, {.subjects = subjects});
    Progress progress("read", static_cast<int64_t>(sources.size()), "files");
    return LoadPoses(sources, {.own_proportions = own_proportions}, progress.Callback());
  };
  const TrainingPoses train = load(options.train_subjects, false);
  const TrainingPoses test = load(options.test_subjects, true);
  Progress training("train", train.poses_m.cols(), "frames");
  TrainReport report;
  const Dictionary dictionary =
      TrainDictionary(train, /*mirrored=*/true, options.train, training.Callback(), &report);
  std::vector<LiftMethod> methods = {
      CodeOnly("paper, one start", dictionary, FindMethod("paper-one-start").lifter),
      CodeOnly("paper, several starts", dictionary, FindMethod("paper").lifter),
      Exemplars(train.poses_m, options.exemplars), CodeOnly("poselift, code alone", dictionary, {}),
      Whole("poselift", dictionary)};
  for (const int hints : options.hints) {
    methods.push_back(Whole(
        fmt::format("poselift, {} hint{}", hints, hints == 1 ? "" : "s at most"), dictionary));
    methods.back().max_hints = hints;
  }
  Progress progress("lift");
  const auto rows = EvaluateLift(methods, test.poses_m, options.evaluation, progress.Callback());
  fmt::print("{} atoms; {} poses of {} test frames, seed {}, {}; mean ± standard error\n",
             dictionary.NumAtoms(), options.evaluation.num_poses, test.poses_m.cols(),
             options.evaluation.seed, options.evaluation.layout);
  Print(rows);
  if (!options.json.empty()) WriteJson(rows, options, dictionary.NumAtoms());
  return kDone;
}

}  // namespace

CLI::App* AddEvaluateLift(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "lift",
      "2D labels of known poses, lifted by every method: trains on some subjects, tests "
      "on others");
  command->footer("Example:\n  poselift evaluate lift --mocap cmu/ --json lift.json");
  command->add_option("--mocap", options->mocap, "Folder with .amc and .asf files")->required();
  command->add_option("--json", options->json, "Write the numbers there too");
  command->add_option("--train", options->train_subjects, "Subjects to learn from")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--test", options->test_subjects, "Subjects to lift")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--poses", options->evaluation.num_poses, "Poses lifted")
      ->capture_default_str();
  command->add_option("--layout", options->evaluation.layout, "Labels given")
      ->capture_default_str();
  command->add_option("--atoms", options->train.num_atoms, "0: by the size rule")
      ->capture_default_str();
  command->add_option("--exemplars", options->exemplars, "Poses of the lookup")
      ->capture_default_str();
  command->add_option("--seed", options->evaluation.seed, "Of poses, cameras, noise")
      ->capture_default_str();
  command
      ->add_option("--hints", options->hints,
                   "Rows more, of poses lifted again with so many true hints at most, each of the "
                   "deepest limb that goes the wrong way (e.g. 1,4)")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  *run = [options] { return EvaluateLifts(*options); };
  return command;
}

}  // namespace poselift::cli
