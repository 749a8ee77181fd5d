// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/train_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "ui/cli/command.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

MotionCodebook LoadSegments(const std::vector<MotionSource>& sources, const Skeleton& standard) {
  Progress progress("read", static_cast<int64_t>(sources.size()), "files");
  return SegmentsOf(
      LoadMotionDatabase(sources, standard, {.mirrored = false}, progress.Callback()));
}

// What makes the same codebook again, without the paths of this machine.
std::string Command(const MotionTrainOptions& options) {
  std::string command =
      fmt::format("poselift train --motion --mocap {} --segments {} --iterations {} --seed {}",
                  NameOf(options.mocap), options.codebook.num_segments, options.codebook.iterations,
                  options.codebook.seed);
  if (!options.choice.subjects.empty())
    command += fmt::format(" --subjects {}", fmt::join(options.choice.subjects, ","));
  if (!options.choice.fallback_asf.empty())
    command += " --asf " + NameOf(options.choice.fallback_asf);
  if (!options.held_out.empty())
    command += fmt::format(" --held-out {}", fmt::join(options.held_out, ","));
  return command;
}

// How many captured segments a learned one stands for.
Json MembersToJson(std::vector<int> members, long num_segments) {
  std::sort(members.begin(), members.end());
  const auto part = [&](double quantile) {
    return members[static_cast<size_t>(quantile * static_cast<double>(members.size() - 1))];
  };
  return {{"mean", static_cast<double>(num_segments) / static_cast<double>(members.size())},
          {"least", members.front()},
          {"tenth", part(0.1)},
          {"median", part(0.5)},
          {"nine_tenths", part(0.9)},
          {"most", members.back()},
          {"alone", std::count(members.begin(), members.end(), 1)}};
}

// How near what was not learned is to what was, mirror images and all.
Json HeldOutToJson(const MotionCodebook& held_out, const MotionCodebook& segments,
                   const MotionCodebook& codebook) {
  return {{"segments", held_out.NumSegments()},
          {"to_captured_mm", 1e3 * MeanDistanceToNearest_m(held_out, WithMirrored(segments))},
          {"to_codebook_mm", 1e3 * MeanDistanceToNearest_m(held_out, WithMirrored(codebook))}};
}

void Print(const Json& report) {
  const Json& members = report["members"];
  fmt::print("{} segments for {}, {:.2f} mm RMS a joint\n", report["segments"].get<int>(),
             report["captured_segments"].get<int>(), report["rms_error_mm"].get<double>());
  fmt::print(
      "members: mean {:.1f}, median {}, a tenth up to {}, nine tenths up to {}, most {}; {} "
      "alone\n",
      members["mean"].get<double>(), members["median"].get<int>(), members["tenth"].get<int>(),
      members["nine_tenths"].get<int>(), members["most"].get<int>(), members["alone"].get<int>());
  if (!report.contains("held_out")) return;
  const Json& held_out = report["held_out"];
  fmt::print(
      "held out: {} segments, {:.1f} mm to the nearest captured, {:.1f} mm to the nearest "
      "learned\n",
      held_out["segments"].get<int>(), held_out["to_captured_mm"].get<double>(),
      held_out["to_codebook_mm"].get<double>());
}

}  // namespace

std::string NameOf(const std::string& path) {
  const std::filesystem::path whole = path;
  return whole.has_filename() ? whole.filename() : whole.parent_path().filename();
}

int TrainMotion(const MotionTrainOptions& options) {
  const auto all = FindMotions(options.mocap, {.fallback_asf = options.choice.fallback_asf});
  const auto sources = ChooseTrials(all, options.choice.subjects, options.held_out);
  const Skeleton standard = ReadDictionary(DefaultDictionaryPath()).skeleton;
  const MotionCodebook segments = LoadSegments(sources, standard);
  if (segments.NumSegments() == 0)
    throw InputError(options.mocap, "found no motion of half a second, wanted one at least");

  CodebookReport trained;
  Progress training("train", segments.NumSegments(), "segments");
  MotionCodebook codebook =
      TrainCodebook(segments, options.codebook, training.Callback(), &trained);
  for (const MotionSource& source : sources)
    codebook.record.sources.push_back(source.amc.filename());
  codebook.record.command = Command(options);
  codebook.record.commit = POSELIFT_COMMIT;
  WriteMotionCodebook(codebook, options.out);

  Json report = {{"command", "train --motion"},
                 {"segments", codebook.NumSegments()},
                 {"captured_segments", codebook.record.num_segments},
                 {"rms_error_mm", codebook.record.rms_error_mm},
                 {"members", MembersToJson(trained.members, codebook.record.num_segments)}};
  if (!options.held_out.empty())
    report["held_out"] = HeldOutToJson(
        LoadSegments(ChooseTrials(all, options.held_out, {}), standard), segments, codebook);
  Print(report);
  if (!options.json.empty()) WriteFileAtomically(options.json, report.dump(1) + "\n");
  return kDone;
}

}  // namespace poselift::cli
