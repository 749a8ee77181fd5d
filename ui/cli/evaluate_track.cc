// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lift/temporal/resample.h"
#include "lift/tracking/tag_cost.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/atomic_file.h"
#include "src/level_camera.h"
#include "ui/cli/evaluate.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/held_out_models.h"
#include "ui/cli/progress.h"
#include "ui/cli/track_experiment.h"
#include "ui/live/tracking_inputs.h"

namespace poselift::cli {
namespace {

constexpr double kFrameTime_s = 1.0 / 30.0;
constexpr double kWeakFov_deg = 1.0;  // from 250 m away

// A trial that is tracked, and the movements its tags are fitted on.
struct Test {
  std::string action, trial;
  std::vector<std::string> fitted_on;
};

// Nobody among the test subjects waves: subject 29 does, and is left out of the models.
const std::vector<Test>& Tests() {
  static const std::vector<Test> kTests = {
      {"walking", "07_05", {"07_05"}},          {"walking", "16_15", {"16_21", "16_01"}},
      {"walking", "16_22", {"16_21", "16_01"}}, {"waving", "29_15", {"29_09", "29_04"}},
      {"waving", "29_09", {"29_15", "29_04"}},
  };
  return kTests;
}

const std::map<std::string, TagsWorn>& WornNames() {
  static const std::map<std::string, TagsWorn> kNames = {
      {"front", TagsWorn::kFront}, {"around", TagsWorn::kAround}, {"printed", TagsWorn::kPrinted}};
  return kNames;
}

std::string NameOf(TagsWorn worn) {
  for (const auto& [name, value] : WornNames())
    if (value == worn) return name;
  return "";
}

struct Options {
  std::string mocap, json;
  HeldOutModels models{.train_subjects = {"01", "02", "03", "05", "14", "17"}};
  size_t max_frames = 150;
  TrackExperimentOptions experiment;
};

struct Row {
  std::string method, action, trial;
  double whole_share = 0.0;  // of tags, detected in whole frames
  TrackErrors errors;
};

Motion LoadTrial(const std::vector<MotionSource>& sources, const std::string& name,
                 size_t max_frames) {
  const auto chosen = ChooseTrials(sources, {name}, {});
  if (chosen.empty()) throw InputError("--mocap: found no trial " + name);
  Motion motion =
      Resample(ReadAmc(chosen.front().amc, ReadAsfSkeleton(chosen.front().asf)), kFrameTime_s);
  motion.frames.resize(std::min(motion.frames.size(), max_frames));
  return motion;
}

// Each trial is rendered once.
class Videos {
 public:
  Videos(const std::vector<MotionSource>& sources, const Options& options)
      : sources_(sources), options_(options) {}

  struct Video {
    Motion motion;
    Dress dress;
    TaggedVideo tagged;
  };
  const Video& Of(const std::string& trial) {
    const auto found = videos_.find(trial);
    if (found != videos_.end()) return found->second;
    Video video{.motion = LoadTrial(sources_, trial, options_.max_frames)};
    video.dress = DressFor(video.motion.skeleton, options_.experiment);
    Progress progress("render " + trial, static_cast<int64_t>(video.motion.frames.size()),
                      "frames");
    video.tagged =
        RenderTagged(video.motion, video.dress.worn, options_.experiment, progress.Callback());
    return videos_.emplace(trial, std::move(video)).first->second;
  }

 private:
  const std::vector<MotionSource>& sources_;
  const Options& options_;
  std::map<std::string, Video> videos_;
};

std::vector<Row> RunTest(const Test& test, const PhotoLifter& lifter,
                         const std::shared_ptr<const MotionCodebook>& codebook,
                         const Options& options, Videos* videos) {
  const Videos::Video& video = videos->Of(test.trial);
  const BodyTags& said = video.dress.said;
  const Camera& known = video.tagged.camera;
  const auto that_sees = [&](double fov_deg) {
    TrackingInputs guessed;
    guessed.fov_deg = fov_deg;
    return CameraOf(guessed, {known.width_px, known.height_px});
  };
  const Camera guess = that_sees(options.experiment.fov_deg), weak = that_sees(kWeakFov_deg);
  std::vector<const TaggedVideo*> fit_videos;
  for (const std::string& trial : test.fitted_on) fit_videos.push_back(&videos->Of(trial).tagged);

  std::vector<Row> rows;
  const double whole_share = WholeFramesShare(video.tagged);
  const auto track = [&](const std::string& method, const BodyTags& tags, const Camera& camera,
                         double depth_sigma) {
    rows.push_back({method, test.action, test.trial, whole_share,
                    TrackVideo(video.tagged, video.motion.skeleton, video.dress.worn, tags, camera,
                               lifter, codebook, depth_sigma)});
  };
  const auto fit = [&](const std::string& method, const Camera& start, bool finds_lens,
                       double depth_sigma) {
    Progress progress("fit " + test.trial);
    const TagFit found =
        FitTags(SightFrames(fit_videos, said, start), said, start, kLevelFromCam, lifter, codebook,
                {.depth_sigma = depth_sigma, .finds_lens = finds_lens}, progress.Callback());
    if (!found.is_usable) throw std::runtime_error(test.trial + ": " + found.message);
    track(method, found.tags, found.camera, depth_sigma);
  };
  track("camera known, tags as said", said, known, 0.0);
  fit("camera known, tags fitted", known, false, 0.0);
  fit("camera found, tags fitted", guess, true, 0.0);
  fit("camera guessed, tags fitted", guess, false, kGuessedDepthSigma);
  fit("weak perspective, tags fitted", weak, false, kWeakDepthSigma);
  return rows;
}

std::string Degrees(double rms_deg) {
  return std::isnan(rms_deg) ? "-" : fmt::format("{:.1f}", rms_deg);
}

void Print(const std::vector<Row>& rows) {
  fmt::print("{:30} {:8} {:6} {:>10} {:>7} {:>7} {:>10} {:>10} {:>6} {:>8} {:>9} {:>9}\n", "method",
             "action", "trial", "visible mm", "all mm", "sure", "elbows deg", "knees deg", "flips",
             "unknown", "detected", "in whole");
  for (const auto& [method, action, trial, whole_share, errors] : rows)
    fmt::print(
        "{:30} {:8} {:6} {:10.1f} {:7.1f} {:5.0f} % {:>10} {:>10} {:6} {:8} {:7.1f} % {:7.1f} %\n",
        method, action, trial, errors.visible_mm, errors.all_mm, 100.0 * errors.sure_share,
        Degrees(errors.elbows_deg), Degrees(errors.knees_deg), errors.num_flips, errors.num_unknown,
        100.0 * errors.detected_share, 100.0 * whole_share);
}

void WriteJson(const std::vector<Row>& rows, const Options& options) {
  using Json = nlohmann::ordered_json;
  Json json = {{"command", "evaluate track"},
               {"data", std::filesystem::path(options.mocap).filename().string()},
               {"split", {{"train", options.models.train_subjects}}},
               {"seed", options.experiment.seed},
               {"worn", NameOf(options.experiment.worn)},
               {"rows", Json::array()}};
  for (const Row& row : rows)
    json["rows"].push_back({{"method", row.method},
                            {"action", row.action},
                            {"trial", row.trial},
                            {"frames", row.errors.num_frames},
                            {"visible_mm", row.errors.visible_mm},
                            {"all_mm", row.errors.all_mm},
                            {"elbows_deg", row.errors.elbows_deg},
                            {"knees_deg", row.errors.knees_deg},
                            {"flips", row.errors.num_flips},
                            {"not_known", row.errors.num_unknown},
                            {"within_2_sigma", row.errors.sure_share},
                            {"detected_share", row.errors.detected_share},
                            {"detected_in_whole_frames", row.whole_share}});
  WriteFileAtomically(options.json, json.dump(1) + "\n");
}

int Evaluate(const Options& options) {
  std::vector<std::string> subjects = options.models.train_subjects;
  for (const Test& test : Tests()) subjects.push_back(test.trial.substr(0, 2));
  const auto sources = FindMotions(options.mocap, {.subjects = subjects});
  const Dictionary dictionary = LearnDictionary(sources, options.models);
  const auto codebook = std::make_shared<const MotionCodebook>(
      LearnMotion(sources, dictionary.skeleton, options.models));
  const PhotoLifter lifter(dictionary);
  Videos videos(sources, options);
  std::vector<Row> rows;
  for (const Test& test : Tests())
    for (Row& row : RunTest(test, lifter, codebook, options, &videos))
      rows.push_back(std::move(row));
  const TrackExperimentOptions& experiment = options.experiment;
  fmt::print(
      "rendered at {:g} m, 1280 x 720, focal length {:g} px, tags {}, exposure {:.1f} ms, noise "
      "{:g} grey "
      "levels; tags {:g} mm and {:.1f} degrees off what is said; seed {}\n",
      experiment.distance_m, experiment.focal_px, NameOf(experiment.worn),
      1e3 * experiment.exposure_s, experiment.noise_grey_levels, 1e3 * experiment.misplaced_m,
      experiment.misplaced_rad * 180.0 / 3.14159265, experiment.seed);
  Print(rows);
  if (!options.json.empty()) WriteJson(rows, options);
  return kDone;
}

}  // namespace

CLI::App* AddEvaluateTrack(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("track", "Rendered people who wear tags, tracked: far from the truth?");
  command->footer("Example:\n  poselift evaluate track --mocap mocap/ --json track.json");
  command->add_option("--mocap", options->mocap, "Folder with .amc and .asf files")->required();
  command->add_option("--dictionary", options->models.dictionary, "Use this one and learn none");
  command->add_option("--motion-model", options->models.motion_model,
                      "Use this motion codebook and learn none");
  command->add_option("--json", options->json, "Write the numbers there too");
  command->add_option("--max-frames", options->max_frames, "Of each trial, at 30 Hz")
      ->capture_default_str();
  TrackExperimentOptions& experiment = options->experiment;
  command->add_option("--distance-m", experiment.distance_m, "Of the camera")
      ->check(IsNumber(1.0, 30.0))
      ->capture_default_str();
  command
      ->add_option("--focal-px", experiment.focal_px,
                   "Of the camera: 300 a metre of distance show the body as large as 3 m do")
      ->check(IsNumber(300.0, 10000.0))
      ->capture_default_str();
  command->add_option("--tag-size-m", experiment.tag_size_m, "Of all tags but the printed")
      ->check(IsNumber(0.01, 0.3))
      ->capture_default_str();
  command
      ->add_option("--worn", experiment.worn,
                   "13 tags in front, 36 on all sides, or the 16 that `tags print` prints")
      ->transform(CLI::CheckedTransformer(WornNames()))
      ->option_text("front|around|printed [front]");
  command->add_option("--exposure-s", experiment.exposure_s, "Of each frame: motion blur")
      ->check(IsNumber(0.0, 0.033))
      ->capture_default_str();
  command->add_option("--noise", experiment.noise_grey_levels, "Of the sensor, in grey levels")
      ->check(IsNumber(0.0, 50.0))
      ->capture_default_str();
  command->add_option("--seed", experiment.seed, "Of noise and of misplaced tags")
      ->capture_default_str();
  *run = [options] { return Evaluate(*options); };
  return command;
}

}  // namespace poselift::cli
