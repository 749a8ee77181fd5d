// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "calib/tag_search.h"
#include "lift/tracking/fit_check.h"
#include "lift/tracking/tag_fit.h"
#include "src/capture/open_frame_source.h"
#include "src/io/atomic_file.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_yaml.h"
#include "ui/cli/camera_options.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/progress.h"
#include "ui/cli/refuse_options.h"
#include "ui/cli/tags.h"
#include "ui/cli/tracking_options.h"
#include "ui/live/tag_session.h"
#include "ui/live/tracking_inputs.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Options {
  TrackingInputs inputs;
  std::string tags, out, camera_out, json;
  double seconds = 0.0;  // 0: those of LongestMovement_s
  bool is_forced = false;
  TagFitOptions fit;
};

// A file is as long as it is.
double LongestMovement_s(const Options& options) {
  constexpr double kCamera_s = 30.0, kFile_s = 600.0;
  if (options.seconds > 0.0) return options.seconds;
  return KindOfSource(options.inputs.input) == SourceKind::kCamera ? kCamera_s : kFile_s;
}

std::vector<SightedFrame> Sight(const BodyTags& tags, const Options& options, FrameSource* source,
                                const Camera& camera) {
  TagSearchOptions searching{.threads = 2};
  for (const BodyTag& tag : tags.tags) searching.detector.known_ids.push_back(tag.id);
  TagSearch search(TagFamily(tags.family), searching);
  Progress progress("look for tags", 0, "frames");
  std::vector<SightedFrame> frames;
  const double longest_s = LongestMovement_s(options);
  const Interrupt interrupt;  // what was seen is fitted
  while (!interrupt.asked()) {
    const auto frame = source->Next();
    if (!frame || frame->time_s >= longest_s) break;
    frames.push_back({frame->time_s, SightTags(search.Detect(frame->grey), tags, camera)});
    progress.Advance(frame->time_s / longest_s);
  }
  return frames;
}

void Print(const TagFit& fit, const BodyTags& tags) {
  fmt::print("{:>4} {:24} {:>7} {:>7} {:>9} {:>10} {:>10} {:>11}\n", "tag", "name", "frames",
             "px RMS", "moved mm", "turned deg", "sigma mm", "sigma deg");
  for (const TagFitRow& row : fit.rows) {
    const BodyTag& found = *fit.tags.Find(row.id);
    if (row.num_frames == 0) {
      fmt::print("{:>4} {:24} {:>7} it stays as it was\n", row.id, tags.Find(row.id)->name,
                 "unseen");
      continue;
    }
    fmt::print("{:>4} {:24} {:>7} {:>7.2f} {:>9.0f} {:>10.1f} {:>10.1f} {:>11.1f}\n", row.id,
               found.name, row.num_frames, row.rms_px, row.moved_mm, row.turned_deg,
               1e3 * found.on_bone->sigma_m, 57.29578 * found.on_bone->sigma_rad);
  }
  fmt::print("bones against the standard skeleton:");
  for (int g = 0; g < kNumBoneGroups; ++g)
    fmt::print("{} {} {:+.1f} ± {:.1f}", g > 0 ? "," : "", BoneGroupNames()[g],
               100.0 * std::expm1(fit.proportions.log_ratios[g]),
               100.0 * std::sqrt(fit.proportions.covariance(g, g)));
  fmt::print(" %\n");
}

// Of a camera that was found: how wide it sees.
void PrintCamera(const TagFit& fit) {
  const double half_rad = std::atan(0.5 * fit.camera.width_px / fit.camera.fx_px);
  fmt::print("camera: focal length {:.0f} ± {:.0f} px ({:.1f} degrees wide), k1 {:+.3f}\n",
             fit.camera.fx_px, fit.camera.fx_px * fit.focal_sigma,
             360.0 / std::numbers::pi * half_rad, fit.camera.distortion.k1);
}

void WriteJson(const TagFit& fit, const std::string& flaw, const Options& options) {
  Json json = {{"command", "tags fit"},    {"input", options.inputs.input},
               {"frames", fit.num_frames}, {"focal_px", fit.camera.fx_px},
               {"implausible", flaw},      {"rows", Json::array()}};
  for (const TagFitRow& row : fit.rows)
    json["rows"].push_back({{"id", row.id},
                            {"frames", row.num_frames},
                            {"rms_px", row.rms_px},
                            {"moved_mm", row.moved_mm},
                            {"turned_deg", row.turned_deg}});
  WriteFileAtomically(options.json, json.dump(1) + "\n");
}

// What a person measured is no guess to be written over.
void RefuseToReplaceInput(const Options& options) {
  std::error_code ignored;
  for (const std::string& input : {options.tags, options.inputs.camera})
    for (const std::string& output : {options.out, options.camera_out})
      if (!input.empty() && fs::equivalent(input, output, ignored))
        throw InputError(output, "found that it is read here, wanted another name to write to");
}

int Fit(Options options) {
  RefuseToReplaceInput(options);
  PrepareFolderOf(options.out);
  if (!options.camera_out.empty()) PrepareFolderOf(options.camera_out);
  options.fit.finds_lens = options.inputs.camera.empty();
  const BodyTags tags = ReadBodyTags(options.tags);
  const TrackingModels models = ReadModels(options.inputs);
  const PhotoLifter lifter(models.dictionary);
  const auto source = OpenSource(options.inputs);
  TellCamera(*source);
  const Camera camera = CameraOf(options.inputs, source->size_px());
  const std::vector<SightedFrame> frames = Sight(tags, options, source.get(), camera);
  Progress progress("fit");
  const TagFit fit = FitTags(frames, tags, camera, CamFromWorld(options.inputs), lifter,
                             models.codebook, options.fit, progress.Callback());
  if (!fit.is_usable) {
    fmt::print(stderr, "poselift: {}: {}\n", options.inputs.input, fit.message);
    return kFailed;
  }
  Print(fit, tags);
  const std::string flaw = ImplausibleFit(models.dictionary.skeleton, fit);
  if (!options.json.empty()) WriteJson(fit, flaw, options);
  if (!flaw.empty()) {
    fmt::print(stderr, "poselift: {}: {}{}\n", options.tags, flaw,
               options.is_forced ? "" : " Nothing is written; --force writes it all the same");
    if (!options.is_forced) return kFailed;
  }
  WriteBodyTags(fit.tags, options.out);
  fmt::print("{} frames adjusted together; tags in {}\n", fit.num_frames, options.out);
  if (!options.fit.finds_lens) return kDone;
  const std::string camera_out =
      options.camera_out.empty() ? fs::path(options.out).replace_extension(".camera.yaml").string()
                                 : options.camera_out;
  WriteCameraYaml(fit.camera, camera_out);
  PrintCamera(fit);
  fmt::print("track with --camera {}\n", camera_out);
  return kDone;
}

}  // namespace

CLI::App* AddTagsFit(CLI::App* tags, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = tags->add_subcommand(
      "fit", "Where the tags sit, and how long the bones are, from a short movement");
  command->footer(
      "Stand before the camera with all tags on, then, slowly: bend and turn arms and legs, twist\n"
      "and bow the trunk, turn to both sides; half a minute. Without --camera the focal length "
      "and\n"
      "the distortion k1 are found as well: step nearer and back, too.\n"
      "Example:\n  poselift tags fit move.mkv --camera cam.yaml --tags tags.toml --out mine.toml");
  AddTrackingInputs(command, &options->inputs);
  command->add_option("--tags", options->tags, "Where they sit about (tags.toml)")->required();
  command->add_option("--out", options->out, "The tags file to write")->required();
  command->add_option("--camera-out", options->camera_out,
                      "Without --camera: the camera file to write (default: beside --out)");
  command
      ->add_option("--seconds", options->seconds,
                   "Of the movement (default: 30 of a camera, all of a file); "
                   "Ctrl-C ends it and fits")
      ->check(IsNumber(1.0, 600.0));
  command->add_option("--frames", options->fit.num_frames, "That are adjusted together")
      ->check(CLI::Range(10, 1000))
      ->capture_default_str();
  command->add_flag("--force", options->is_forced, "Write a fit that no human can have, too");
  command->add_option("--json", options->json, "Write the report to this file");
  command->callback([options, command] {
    if (!options->inputs.camera.empty())
      RefuseOptions(*command, {"--camera-out"}, "the camera of --camera is known");
  });
  *run = [options] { return Fit(*options); };
  return command;
}

}  // namespace poselift::cli
