// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Error.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "lift/dictionary_file.h"
#include "lift/train/train_dictionary.h"
#include "lift/train/training_poses.h"
#include "src/io/atomic_file.h"
#include "ui/cli/command.h"
#include "ui/cli/progress.h"
#include "ui/cli/train_motion.h"

namespace poselift::cli {
namespace {

struct Options {
  std::string mocap;
  std::string out;
  std::string atoms = "auto";
  std::string json;
  MotionChoice choice;
  TrainOptions train;
  LoadOptions load;
  bool no_mirror = false;
  bool motion = false;
  CodebookOptions codebook;
  std::vector<std::string> held_out;
};

nlohmann::ordered_json ToJson(const TrainReport& report, const Dictionary& dictionary) {
  nlohmann::ordered_json json = {{"command", "train"},
                                 {"atoms", dictionary.NumAtoms()},
                                 {"poses", dictionary.record.num_poses},
                                 {"rms_error_mm", dictionary.record.rms_error_mm},
                                 {"subsets", nlohmann::ordered_json::array()}};
  for (const SubsetReport& subset : report.subsets)
    json["subsets"].push_back({{"poses", subset.num_poses},
                               {"atoms", subset.ksvd.atom_use.size()},
                               {"rms_error_m", subset.ksvd.rms_error_m},
                               {"atom_use", subset.ksvd.atom_use}});
  return json;
}

// A line for each subset: how it was coded, and how evenly its atoms are used.
void Print(const TrainReport& report, const Dictionary& dictionary) {
  fmt::print("{:>6} {:>8} {:>6} {:>10} {:>10} {:>12} {:>12}\n", "subset", "poses", "atoms",
             "start mm", "end mm", "least used", "most used");
  for (size_t s = 0; s < report.subsets.size(); ++s) {
    const auto& [num_poses, ksvd] = report.subsets[s];
    const auto [least, most] = std::minmax_element(ksvd.atom_use.begin(), ksvd.atom_use.end());
    fmt::print("{:>6} {:>8} {:>6} {:>10.2f} {:>10.2f} {:>12} {:>12}\n", s, num_poses,
               ksvd.atom_use.size(), 1e3 * ksvd.rms_error_m.front(), 1e3 * ksvd.rms_error_m.back(),
               *least, *most);
  }
  fmt::print("{} atoms for {} poses, {:.2f} mm RMS a joint with {} atoms a pose\n",
             dictionary.NumAtoms(), dictionary.record.num_poses, dictionary.record.rms_error_mm,
             dictionary.record.sparsity);
}

// What makes the same dictionary again, without the paths of this machine.
std::string Command(const Options& options) {
  std::string command = fmt::format(
      "poselift train --mocap {} --atoms {} --target-mm {:g} --sparsity {} --iterations {} "
      "--subsets {} --stride {} --seed {}",
      NameOf(options.mocap), options.atoms, 1e3 * options.train.target_error_m,
      options.train.ksvd.sparsity, options.train.ksvd.max_iterations, options.train.num_subsets,
      options.load.stride, options.train.seed);
  if (!options.choice.subjects.empty())
    command += fmt::format(" --subjects {}", fmt::join(options.choice.subjects, ","));
  if (!options.choice.fallback_asf.empty())
    command += " --asf " + NameOf(options.choice.fallback_asf);
  if (options.no_mirror) command += " --no-mirror";
  return command;
}

int Train(const Options& options) {
  const auto sources = FindMotions(options.mocap, options.choice);
  Progress reading("read", static_cast<int64_t>(sources.size()), "files");
  const TrainingPoses poses = LoadPoses(sources, options.load, reading.Callback());

  TrainReport report;
  Progress training("train", poses.poses_m.cols(), "frames");
  Dictionary dictionary =
      TrainDictionary(poses, !options.no_mirror, options.train, training.Callback(), &report);
  dictionary.record.command = Command(options);
  dictionary.record.commit = POSELIFT_COMMIT;
  WriteDictionary(dictionary, options.out);
  Print(report, dictionary);
  if (!options.json.empty())
    WriteFileAtomically(options.json, ToJson(report, dictionary).dump(1) + "\n");
  return kDone;
}

MotionTrainOptions MotionOptions(const Options& options) {
  MotionTrainOptions motion = {.mocap = options.mocap,
                               .out = options.out,
                               .json = options.json,
                               .choice = options.choice,
                               .held_out = options.held_out,
                               .codebook = options.codebook};
  motion.codebook.iterations = options.train.ksvd.max_iterations;
  motion.codebook.seed = options.train.seed;
  return motion;
}

}  // namespace

CLI::App* AddTrain(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "train", "Learn a pose dictionary or, with --motion, a motion codebook from AMC/ASF files");
  command->footer(
      "Example:\n  poselift train --mocap cmu/ --out mine.pldict --seed 1\n"
      "  poselift train --motion --mocap cmu/ --out mine.plmotion");
  command->add_option("--mocap", options->mocap, "Folder with .amc and .asf files")->required();
  command->add_option("--out", options->out, "Dictionary or codebook file to write")->required();
  CLI::Option* motion =
      command->add_flag("--motion", options->motion, "Learn half seconds of motion, not poses");
  command->add_option("--segments", options->codebook.num_segments, "Segments of the codebook")
      ->needs(motion)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--held-out", options->held_out,
                   "Subjects or trials to test the codebook with, not to learn from")
      ->needs(motion)
      ->delimiter(',');
  command->add_option("--atoms", options->atoms, "Number of atoms, or auto: by --target-mm")
      ->excludes(motion)
      ->capture_default_str();
  command
      ->add_option_function<double>(
          "--target-mm", [options](double mm) { options->train.target_error_m = 1e-3 * mm; },
          "Coding error aimed at, RMS of a joint (auto)")
      ->excludes(motion)
      ->default_str(fmt::format("{:g}", 1e3 * options->train.target_error_m));
  command->add_option("--sparsity", options->train.ksvd.sparsity, "Atoms of a pose in training")
      ->excludes(motion)
      ->capture_default_str();
  command
      ->add_option("--iterations", options->train.ksvd.max_iterations,
                   "K-SVD or, with --motion, k-means iterations")
      ->capture_default_str();
  command->add_option("--subsets", options->train.num_subsets, "k-means subsets")
      ->excludes(motion)
      ->capture_default_str();
  command->add_option("--stride", options->load.stride, "Take every n-th frame")
      ->excludes(motion)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--subjects", options->choice.subjects, "Only these (folder names)")
      ->delimiter(',');
  command->add_option("--asf", options->choice.fallback_asf,
                      "Skeleton of AMC files that have none of their own");
  command->add_flag("--no-mirror", options->no_mirror, "Do not add left-right mirrored poses")
      ->excludes(motion);
  command->add_option("--seed", options->train.seed, "Of the random draws")->capture_default_str();
  command->add_option("--threads", options->train.num_threads, "0: all cores")
      ->excludes(motion)
      ->capture_default_str();
  command->add_option(
      "--json", options->json,
      "Training report: error per iteration, atom use; members, held-out distances");
  command->callback([options, command] {
    if (options->atoms != "auto") {
      const auto [end, error] =
          std::from_chars(options->atoms.data(), options->atoms.data() + options->atoms.size(),
                          options->train.num_atoms);
      if (error != std::errc() || *end != '\0' || options->train.num_atoms < 1)
        throw CLI::ValidationError("--atoms", "wanted a number above 0 or auto");
    }
    if (const std::string error = options->train.Validate(); !error.empty())
      throw CLI::ValidationError(command->get_name(), error);
  });
  *run = [options] {
    return options->motion ? TrainMotion(MotionOptions(*options)) : Train(*options);
  };
  return command;
}

}  // namespace poselift::cli
