// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "lift/poses_to_motion.h"
#include "lift/tracking/fit_check.h"
#include "src/capture/live_frame_source.h"
#include "src/capture/open_frame_source.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/body_tags_toml.h"
#include "src/io/poses_json.h"
#include "src/io/udp_lines.h"
#include "ui/cli/camera_options.h"
#include "ui/cli/command.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/progress.h"
#include "ui/cli/tracking_options.h"
#include "ui/live/latency_meter.h"
#include "ui/live/tag_session.h"
#include "ui/live/track_recording.h"
#include "ui/live/track_video.h"
#include "ui/live/tracking_inputs.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Options {
  TrackingInputs inputs;
  std::string tags;
  std::string out;
  std::string json;
  TagSessionOptions session;
  double seconds = 0.0;
  bool stream = false;
  int udp_port = 0;
  bool record = false;
  bool may_overwrite = false;
  std::optional<double> before_s;  // the video begins so long before somebody is seen
};

// Of the tags, that do not fit: where it is said where they sit, some in a hundred.
constexpr double kManyDoubted = 0.12;

double Monotonic_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Counts {
  long frames = 0, lost = 0, ok = 0, filled = 0, unknown = 0;
  long tags = 0, tags_judged = 0, tags_doubted = 0;
  double seconds = 0.0;  // of the clock
};

bool IsCamera(const Options& options) {
  return KindOfSource(options.inputs.input) == SourceKind::kCamera;
}

// Where frames of poses go as they come.
class Outputs {
 public:
  Outputs(const Options& options, const Skeleton& skeleton, double frame_time_s)
      : stream_(options.stream) {
    if (stream_) {
      std::signal(SIGPIPE, SIG_IGN);
      ::fcntl(STDOUT_FILENO, F_SETPIPE_SZ, 1 << 20);  // fails where it is no pipe
    }
    if (!options.out.empty())
      recording_.emplace(options.out, skeleton, frame_time_s,
                         IsCamera(options) ? TrackRecording::kCamera : TrackRecording::kFiles);
    if (options.udp_port > 0) udp_.emplace(options.udp_port);
  }

  void Write(const TagSession::Tracked& tracked) {
    if (stream_ || udp_) {
      const std::string line = FramePosesLine(tracked.poses);
      if (stream_) WriteToStandardOutput(line);
      if (udp_) udp_->Send(line);
    }
    // The latency is up to here: a file may be late.
    if (std::isfinite(tracked.monotonic_s)) latency_.Add(Monotonic_s() - tracked.monotonic_s);
    if (recording_) recording_->Add(tracked.poses, tracked.pose, *tracked.poses.time_s);
  }

  void Close() {
    if (recording_) recording_->Close();
  }
  // Lines of the stream, and datagrams, that nobody took in time.
  long num_missed() const { return num_missed_ + (udp_ ? udp_->num_lost() : 0); }
  const LatencyMeter& latency() const { return latency_; }

 private:
  // A recording goes on without its listeners.
  void WriteToStandardOutput(const std::string& line) {
    if (!HasRoomFor(line.size())) {
      ++num_missed_;
      return;
    }
    if (std::fwrite(line.data(), 1, line.size(), stdout) == line.size() && std::fflush(stdout) == 0)
      return;
    const char* const what = "standard output cannot be written: has its reader ended?";
    if (!recording_) throw InputError(what);
    fmt::print(stderr, "poselift: {} The recording goes on\n", what);
    stream_ = false;
  }

  // Of a pipe: nobody waits for a reader that is too slow. Its memory is in pages.
  static bool HasRoomFor(size_t bytes) {
    constexpr int kPages = 2 * 4096;
    const int room = ::fcntl(STDOUT_FILENO, F_GETPIPE_SZ);
    int waiting = 0;
    if (room < 0 || ::ioctl(STDOUT_FILENO, FIONREAD, &waiting) != 0) return true;
    return waiting == 0 || waiting + static_cast<long>(bytes) + kPages <= room;
  }

  bool stream_;
  long num_missed_ = 0;
  std::optional<TrackRecording> recording_;
  std::optional<UdpLines> udp_;
  LatencyMeter latency_;
};

void Count(const TagSession::Tracked& tracked, Counts* counts) {
  const std::string& status = tracked.poses.people.front().status;
  counts->ok += status == "ok";
  counts->filled += status == kFilledStatus;
  counts->unknown += status == kUnknownStatus;
  counts->tags += std::ssize(tracked.tag_ids);
  for (const auto& tag : tracked.poses.people.front().tags) {
    ++counts->tags_judged;
    counts->tags_doubted += !tag.believed;
  }
}

Json Facts(const Options& options, const Counts& counts, const Outputs& outputs) {
  const LatencyMeter& latency = outputs.latency();
  Json facts = {{"command", "track"},
                {"input", options.inputs.input},
                {"frames", counts.frames},
                {"lost", counts.lost},
                {"ok", counts.ok},
                {"filled", counts.filled},
                {"not_known", counts.unknown},
                {"tags_per_frame", counts.frames > 0 ? static_cast<double>(counts.tags) /
                                                           static_cast<double>(counts.frames)
                                                     : 0.0},
                {"tags_not_believed", counts.tags_doubted},
                {"lines_missed", outputs.num_missed()},
                {"seconds", counts.seconds}};
  if (latency.count() > 0)
    facts["latency_ms"] = {{"median", latency.Quantile_ms(0.5)},
                           {"p99", latency.Quantile_ms(0.99)},
                           {"frames_over_2_s", latency.num_over()}};
  return facts;
}

void Report(const Options& options, const Counts& counts, const Outputs& outputs) {
  const LatencyMeter& latency = outputs.latency();
  std::string text = fmt::format(
      "{} frames in {:.1f} s, {} lost: {} ok, {} filled, {} not known; {:.1f} tags a frame",
      counts.frames, counts.seconds, counts.lost, counts.ok, counts.filled, counts.unknown,
      counts.frames > 0 ? static_cast<double>(counts.tags) / static_cast<double>(counts.frames)
                        : 0.0);
  if (latency.count() > 0)
    text += fmt::format("; from camera to line {} at the median, {} at 99 %",
                        latency.QuantileText(0.5), latency.QuantileText(0.99));
  if (outputs.num_missed() > 0)
    text += fmt::format("; {} lines missed by who listens", outputs.num_missed());
  // Standard output may be the stream.
  fmt::print(options.stream ? stderr : stdout, "{}\n", text);
  if (!options.out.empty())
    fmt::print(options.stream ? stderr : stdout, "results in {}\n", options.out);
  if (!options.json.empty())
    WriteFileAtomically(options.json, Facts(options, counts, outputs).dump(2) + "\n");
  if (static_cast<double>(counts.tags_doubted) >
      kManyDoubted * static_cast<double>(counts.tags_judged))
    fmt::print(
        stderr,
        "poselift: {:.0f} % of the tags do not fit the poses: are left and right swapped in "
        "{}, a tag on another bone, their size wrong, or a second print of one in view? `poselift "
        "tags fit` finds where "
        "they sit\n",
        100.0 * static_cast<double>(counts.tags_doubted) / static_cast<double>(counts.tags_judged),
        options.tags);
  if (counts.frames > 0 && counts.ok == 0)
    fmt::print(stderr,
               "poselift: found nobody: are these the tags of {} and of its family? Whoever is "
               "looked for shows {} of them at once. `poselift doctor` tells of the pictures\n",
               options.tags, options.session.tracker.least_tags);
}

// What is only assumed.
void TellAssumptions(const TrackingInputs& inputs) {
  if (inputs.camera.empty())
    fmt::print(stderr,
               "camera: nobody calibrated it, so it is taken for one {}; `poselift calibrate` "
               "measures it, `tags fit` finds it roughly\n",
               inputs.focal_px > 0.0
                   ? fmt::format("of {:g} px (--focal-px)", inputs.focal_px)
                   : fmt::format("that sees {:g} degrees (--fov-deg)", inputs.fov_deg));
  if (inputs.pitch_deg == 0.0 && inputs.roll_deg == 0.0)
    fmt::print(stderr, "camera: taken for level (--pitch-deg, --roll-deg)\n");
}

fs::path VideoPath(const Options& options) { return fs::path(options.out) / "video.mkv"; }

// The raw video of a camera, when it is wanted.
std::optional<TrackVideo> StartVideo(const Options& options, const FrameSource& source) {
  if (!options.record) return std::nullopt;
  const auto* const live = dynamic_cast<const LiveFrameSource*>(&source);
  if (!live)
    throw InputError(options.inputs.input,
                     "--record: found no camera, wanted one: this video is recorded already");
  fs::create_directories(options.out);
  return std::optional<TrackVideo>(std::in_place, VideoPath(options), live->camera().format(),
                                   options.before_s);
}

fs::path PosesPath(const Options& options) { return fs::path(options.out) / "poses.json"; }

bool Replaces(const Options& options) {
  return !options.out.empty() && fs::exists(PosesPath(options));
}

// What was tracked from files can be had again, and is replaced as other commands do; nothing else.
void RefuseToReplace(const Options& options) {
  if (!Replaces(options) || options.may_overwrite) return;
  const bool is_of_files = SourceOfPosesJson(PosesPath(options)) == TrackRecording::kFiles &&
                           !fs::exists(VideoPath(options));
  if (IsCamera(options) || !is_of_files)
    throw InputError(
        options.out,
        "found a recording, wanted a folder without: name another, or say --overwrite");
}

int Track(Options options) {
  RefuseToReplace(options);
  const BodyTags tags = ReadBodyTags(options.tags);
  const TrackingModels models = ReadModels(options.inputs);
  const PhotoLifter lifter(models.dictionary);
  const std::unique_ptr<FrameSource> source = OpenSource(options.inputs);
  const Camera camera = CameraOf(options.inputs, source->size_px());
  options.session.cam_from_world = CamFromWorld(options.inputs);
  options.session.tracker.depth_sigma = DepthSigma(options.inputs);
  TagSession session(tags, camera, lifter, models.codebook, options.session);
  TellAssumptions(options.inputs);
  TellCamera(*source);
  const std::string flaw = ImplausibleBody(models.dictionary.skeleton, session.skeleton());
  if (!flaw.empty()) fmt::print(stderr, "poselift: {}: {}\n", options.tags, flaw);
  std::optional<TrackVideo> video = StartVideo(options, *source);
  if (Replaces(options))
    fmt::print(stderr, "poselift: replaces the recording in {}\n", options.out);
  Outputs outputs(options, session.skeleton(), FrameTime_s(options.inputs, *source));
  const Interrupt interrupt;  // the recording is closed as it should be

  const int64_t num_frames = NumFrames(options.inputs);
  std::optional<Progress> progress(std::in_place, "track", num_frames, "frames");
  Counts counts;
  const double start_s = Monotonic_s();
  const auto take = [&] {
    while (const auto tracked = session.Take()) {
      Count(*tracked, &counts);
      if (video && tracked->pose) video->Start();
      outputs.Write(*tracked);
    }
  };
  // A camera that is unplugged ends the recording with its last good frame.
  std::exception_ptr broken;
  while (!interrupt.asked() && !broken) try {
      const auto frame = source->Next();
      if (!frame) break;
      counts.lost += frame->num_lost;
      if (options.seconds > 0.0 && frame->time_s >= options.seconds) break;
      ++counts.frames;
      if (num_frames > 0)
        progress->Advance(static_cast<double>(counts.frames) / static_cast<double>(num_frames));
      if (video) video->Add(*frame);
      session.Add(*frame);
      take();
    } catch (const InputError&) {
      broken = std::current_exception();
    }
  session.End();
  take();
  counts.seconds = Monotonic_s() - start_s;
  outputs.Close();
  if (video) video->Close();
  progress.reset();
  Report(options, counts, outputs);
  // A tenth: containers state lengths, not frames, and round.
  if (!interrupt.asked() && !broken && options.seconds <= 0.0 &&
      10 * counts.frames < 9 * num_frames)
    fmt::print(stderr, "poselift: {}: found {} frames where {} are stated: it is damaged, or cut\n",
               options.inputs.input, counts.frames + counts.lost, num_frames);
  if (broken) std::rethrow_exception(broken);
  return counts.ok > 0 ? kDone : kFailed;
}

}  // namespace

CLI::App* AddTrack(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  options->session.search.threads = 2;
  CLI::App* command =
      app->add_subcommand("track", "A person who wears AprilTags, followed by a camera, live");
  command->footer(
      "Writes poses.json, poses.bvh, angles.csv and angles_sigma.csv into --out as it goes: they\n"
      "are whole at every moment. Ctrl-C ends it.\n"
      "Example:\n  poselift track /dev/video0 --camera cam.yaml --tags tags.toml --out run/");
  AddTrackingInputs(command, &options->inputs);
  command->add_option("--tags", options->tags, "Which tag sits where (tags.toml)")->required();
  command->add_option("--out", options->out, "Folder for the recording; made when missing");
  command->add_flag("--overwrite", options->may_overwrite,
                    "Replace a camera's recording that is in --out");
  command->add_flag("--stream", options->stream,
                    "Write each frame as a line of JSON to standard output");
  command->add_option("--udp", options->udp_port, "Send each line to this port of this machine")
      ->check(CLI::Range(1, 65535));
  command
      ->add_option("--latency-s", options->session.tracker.filter.latency_s,
                   "Wait so long for frames to come that set a pose right")
      ->check(IsNumber(0.0, 0.9))
      ->capture_default_str();
  command
      ->add_option("--max-gap-s", options->session.tracker.filter.max_gap_s,
                   "So long is a person foretold of whom no tag is seen")
      ->check(IsNumber(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "Stop after so long (default: at the end)")
      ->check(IsNumber(0.0, 1e6));
  command->add_option("--threads", options->session.search.threads, "That look for tags")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_flag("--record", options->inputs.keep_encoded,
                    "Camera: record its video too, as it came (video.mkv in --out)");
  command
      ->add_option("--record-before-s", options->before_s,
                   "The video begins so long before a person is first seen (default: at once)")
      ->needs("--record")
      ->check(IsNumber(0.0, 60.0));
  command->add_flag_callback(
      "--no-window", [] {}, "Open no window: what it does anyway");
  command->add_option("--json", options->json, "Write the report to this file");
  command->callback([options] {
    if (options->out.empty() && !options->stream && options->udp_port == 0)
      throw CLI::RequiredError("--out, --stream or --udp");
    options->record = options->inputs.keep_encoded;
    if (options->record && options->out.empty()) throw CLI::RequiredError("--out, for --record");
  });
  *run = [options] { return Track(*options); };
  return command;
}

}  // namespace poselift::cli
