// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "lift/body_proportions.h"
#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/key_frames.h"
#include "lift/lift_labels.h"
#include "lift/lift_sequence.h"
#include "lift/lifted_files.h"
#include "lift/normalize.h"
#include "lift/poses_to_motion.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/io/image.h"
#include "src/io/labels.h"
#include "ui/cli/command.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/lift_camera.h"
#include "ui/cli/lift_inputs.h"
#include "ui/cli/lift_pictures.h"
#include "ui/cli/lift_strip.h"
#include "ui/cli/lift_video.h"
#include "ui/cli/methods.h"
#include "ui/cli/progress.h"
#include "ui/cli/truth.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> inputs;
  std::string labels;
  std::string layout = "auto";
  std::string dictionary;
  LiftCamera camera;
  std::string method = "poselift";
  std::string out = ".";
  std::string truth;
  double fps = 30.0;
  bool has_fps = false;
  std::string motion_model;
  bool frames_alone = false;
  bool standard_bones = false;
  bool propagate = true;
  double max_gap_s = 1.0;
  bool overlay_video = false;
  unsigned long seed = 1;
};

LiftInputs Gather(const Options& options) {
  const auto video = FindVideo(options.inputs, options.labels);
  if (!video) return GatherInputs(options.inputs, options.labels, options.layout);
  Progress progress("labels", 0, "frames");
  return GatherVideo(*video, {options.labels, options.layout, options.propagate, options.max_gap_s},
                     progress.Callback());
}

bool AreOneMotion(const Labels& labels, const Options& options) {
  return !options.frames_alone && options.method == MethodNames().front() &&
         WhyFramesAlone(labels).empty();
}

void SetTimes(double fps, Labels* labels) {
  const bool are_keys = AreKeyFrames(*labels);
  for (size_t f = 0; f < labels->frames.size(); ++f) {
    FrameLabels& frame = labels->frames[f];
    if (frame.time_s) continue;
    frame.time_s = static_cast<double>(f) / fps;
    if (are_keys) frame.frame = static_cast<int>(f);
  }
}

LiftedLabels LiftMotion(const PhotoLifter& lifter, const Labels& labels,
                        const std::optional<Camera>& camera, const Options& options,
                        const ProgressFn& progress) {
  if (AreKeyFrames(labels)) return LiftKeyFrames(lifter, labels, progress);
  const MotionCodebook codebook = WithMirrored(ReadMotionCodebook(
      options.motion_model.empty() ? DefaultMotionModelPath() : fs::path(options.motion_model)));
  LiftSequenceOptions sequence;
  sequence.find_proportions = !options.standard_bones;
  return LiftLabelsOverTime(SequenceLifter(lifter, codebook, sequence),
                            lifter.dictionary().skeleton, labels, camera, progress);
}

void WriteAllPictures(const LiftedLabels& lifted, const LiftInputs& inputs,
                      const std::optional<Camera>& camera, const Options& options) {
  const fs::path out = options.out;
  Progress progress("draw", static_cast<int64_t>(inputs.images.size()), "pictures");
  if (!inputs.video.empty()) {
    WriteVideoPictures(inputs, lifted.results, camera, options.overlay_video, out,
                       progress.Callback());
    return;
  }
  const Layout& layout = *FindLayout(inputs.labels.layout);
  for (size_t f = 0; f < inputs.images.size(); ++f) {
    if (!inputs.images[f].empty())
      WritePictures(inputs.images[f], inputs.labels.frames[f], layout, lifted.results[f], camera,
                    out);
    progress.Advance(static_cast<double>(f + 1) / static_cast<double>(inputs.images.size()));
  }
}

// Nothing is written when a picture turns out to be broken at the end.
void CheckPictures(const LiftInputs& inputs) {
  for (const fs::path& image : inputs.images)
    if (!image.empty()) ReadImage(image);
}

// One line a person; of many frames only the sum. Returns how many were lifted.
int Report(const LiftedLabels& lifted) {
  constexpr size_t kListed = 20;
  int people = 0;
  int usable = 0;
  int filled = 0;
  for (size_t f = 0; f < lifted.results.size(); ++f)
    for (size_t p = 0; p < lifted.results[f].size(); ++p) {
      const LiftResult& result = lifted.results[f][p];
      ++people;
      usable += result.IsUsable() ? 1 : 0;
      filled += lifted.poses.frames[f].people[p].status == kFilledStatus ? 1 : 0;
      if (lifted.results.size() > kListed && result.IsUsable()) continue;
      const std::string& image = lifted.poses.frames[f].image;
      fmt::print("{}, person {}: {}\n", image.empty() ? fmt::format("frame {}", f) : image,
                 lifted.poses.frames[f].people[p].id, result.BriefReport());
    }
  fmt::print("lifted {} of {} people in {} frames\n", usable, people, lifted.results.size());
  if (filled > 0) fmt::print("{} of them from the frames around, for want of labels\n", filled);
  return usable;
}

// One line a person: percent longer or shorter than the standard bones, and how tall they
// are where a hint has said it.
void PrintBodies(const std::vector<PersonBones>& bodies, const Skeleton& standard) {
  const Eigen::VectorXd standard_m = BoneLengths(standard);
  for (const PersonBones& body : bodies) {
    const GroupVector log_ratios = LogRatios(body.lengths_m, standard_m);
    const double log_stature = LogStature(log_ratios, standard_m), size = std::exp(log_stature);
    const bool is_standard = std::abs(log_stature) < 1e-6;
    fmt::print("person {}, {}bones at the standard stature:", body.id,
               is_standard ? "" : fmt::format("{:.2f} m tall, ", size * Stature_m(standard)));
    for (int j = 1; j < kNumJoints; ++j) {
      const int group = GroupOfJoint(j);
      if (group == GroupOfJoint(j - 1) || Joints()[j].mirror < j) continue;
      fmt::print("{} {} {:+.1f} ± {:.1f}", group > 0 ? "," : "", BoneGroupNames()[group],
                 100.0 * std::expm1(log_ratios[group] - log_stature),
                 100.0 * body.sigmas_m[j] / (size * standard_m[j]));
    }
    fmt::print(" %\n");
  }
}

int Lift(const Options& options) {
  LiftInputs inputs = Gather(options);
  if (options.has_fps) SetTimes(options.fps, &inputs.labels);
  const bool is_motion = AreOneMotion(inputs.labels, options);
  if (is_motion) inputs.labels = WithPeopleBetween(inputs.labels);
  const std::optional<Camera> camera = CameraOf(options.camera, inputs.labels, inputs.images);
  const Dictionary dictionary = ReadDictionary(
      options.dictionary.empty() ? DefaultDictionaryPath() : fs::path(options.dictionary));
  std::optional<Truth> truth;
  if (!options.truth.empty()) truth = ReadTruth(options.truth);
  CheckPictures(inputs);
  const PhotoLifter lifter(dictionary, FindMethod(options.method));
  fs::create_directories(options.out);

  Progress progress("lift", static_cast<int64_t>(inputs.labels.frames.size()), "frames");
  const LiftedLabels lifted =
      is_motion ? LiftMotion(lifter, inputs.labels, camera, options, progress.Callback())
                : LiftLabels(lifter, inputs.labels, camera, progress.Callback());
  WriteLifted(lifted, inputs.labels, dictionary.skeleton, is_motion, options.fps, options.out);
  if (!inputs.video.empty()) WriteLabels(inputs.labels, fs::path(options.out) / "labels.json");
  WriteAllPictures(lifted, inputs, camera, options);
  const int usable = Report(lifted);
  PrintBodies(lifted.poses.bodies, dictionary.skeleton);
  if (truth) PrintErrorAgainstTruth(lifted.poses, *truth);
  fmt::print("results in {}\n", options.out);
  return usable > 0 ? kDone : kFailed;
}

}  // namespace

CLI::App* AddLift(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("lift", "From labelled pictures to 3D poses with joint angles");
  command->footer(
      "Writes poses.json, poses.bvh, poses.amc with poses.asf, angles.csv, for frames with times\n"
      "angles_sigma.csv (how sure the angles are), and, for each picture, NAME.overlay.png and\n"
      "NAME.view.png, for a video NAME.strip.png and the labels of all frames, labels.json.\n"
      "Examples:\n  poselift lift skier.jpg --labels skier.coco.json --out out/\n"
      "  poselift lift walk.mp4 --labels walk.labels.json --out out/");
  command->add_option("INPUT", options->inputs,
                      "Pictures, folders of pictures or a video; none: what the labels file names");
  command->add_option("--labels", options->labels,
                      "Labels of any format (default: NAME.labels.json beside each input)");
  command->add_option("--layout", options->layout, "Landmarks of the labels, or auto")
      ->capture_default_str();
  command->add_option("--dictionary", options->dictionary, "Default: the one that ships");
  AddLiftCamera(command, &options->camera);
  command->add_option("--method", options->method, "How to lift")
      ->check(CLI::IsMember(MethodNames()))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the results; made when missing")
      ->capture_default_str();
  command
      ->add_option("--fps", options->fps,
                   "Of frames without times; when given, they are lifted as one motion")
      ->check(IsFrameRate())
      ->capture_default_str();
  command->add_option("--motion-model", options->motion_model,
                      "For frames with times (default: the one that ships)");
  command->add_flag("--frames-alone", options->frames_alone,
                    "Lift each frame by itself, also of a motion");
  command->add_flag("--standard-bones", options->standard_bones,
                    "Of a motion: keep the standard proportions of the body, do not find them out");
  command->add_flag("--propagate,!--no-propagate", options->propagate,
                    "Video: label the frames between the labelled ones (default: yes)");
  command->add_option("--max-gap-s", options->max_gap_s, "Video: labels lead no farther, in s")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  command->add_flag("--overlay-video", options->overlay_video, "Video: write NAME.overlay.avi too");
  command->add_option("--truth", options->truth, "True joints of the frames: prints the error");
  command->add_option("--seed", options->seed, "Accepted by every command; lifting draws nothing");
  command->callback([options, command] {
    options->has_fps = command->count("--fps") > 0;
    if (options->inputs.empty() && options->labels.empty())
      throw CLI::RequiredError("INPUT or --labels");
  });
  *run = [options] { return Lift(*options); };
  return command;
}

}  // namespace poselift::cli
