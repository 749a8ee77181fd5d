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
#include <vector>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/poses_to_motion.h"
#include "lift/smooth_motion.h"
#include "lift/temporal/foot_contact.h"
#include "lift/temporal/foot_lock.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "ui/cli/command.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/motion_input.h"
#include "ui/cli/progress.h"
#include "ui/cli/smooth_stream.h"
#include "ui/cli/smoothing_methods.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string in;
  std::string out;
  std::string json;
  std::string method{SmoothingMethods().front().name};
  MotionInputOptions input;
  SmoothingOptions smoothing;
  SmoothMotionOptions smooth;
  bool lock_feet = false;
};

std::vector<std::string> MethodNames() {
  std::vector<std::string> names;
  for (const SmoothingMethod& method : SmoothingMethods()) names.emplace_back(method.name);
  return names;
}

std::string MethodHelp() {
  std::string help = "How to smooth:";
  for (const SmoothingMethod& method : SmoothingMethods())
    help += fmt::format("{} {} ({})", &method == SmoothingMethods().data() ? "" : ",", method.name,
                        method.about);
  return help;
}

Smoothing MakeSmoothing(const std::string& name, const Motion& motion,
                        const SmoothingOptions& options) {
  const auto methods = SmoothingMethods();
  const auto found = std::find_if(methods.begin(), methods.end(),
                                  [&](const SmoothingMethod& row) { return row.name == name; });
  return found->make(motion, options);
}

// Feet locked in place, and how far they slid before.
struct Feet {
  int num_contacts = 0;
  double slide_before_mm = -1.0;
  double slide_after_mm = -1.0;
  int num_failures = 0;
};

Feet Lock(Motion* motion) {
  Progress progress("lock feet", static_cast<int64_t>(motion->frames.size()), "frames");
  const FootContacts contacts = FindFootContacts(*motion);
  LockedFeet locked = LockFeet(*motion, contacts, {}, progress.Callback());
  Feet feet;
  feet.num_contacts =
      static_cast<int>(SpansOf(contacts.Left()).size() + SpansOf(contacts.Right()).size());
  feet.slide_before_mm = FootSlide_mm(*motion, contacts);
  feet.slide_after_mm = FootSlide_mm(locked.motion, contacts);
  feet.num_failures = locked.num_failures;
  *motion = std::move(locked.motion);
  return feet;
}

Json SpansJson(const std::vector<FrameSpan>& spans, double frame_time_s) {
  Json json = Json::array();
  for (const FrameSpan& span : spans)
    json.push_back(
        {{"first", span.first}, {"last", span.last}, {"seconds", span.NumFrames() * frame_time_s}});
  return json;
}

// -1 stands for what there is none of.
Json NumberOrNone(double value) { return value < 0.0 ? Json() : Json(value); }

Json Facts(const PosesMotion& source, const SmoothedMotion& smoothed, const Feet* feet,
           const std::string& summary, const Options& options) {
  const double frame_time_s = smoothed.motion.frame_time_s;
  Json facts = {{"command", "smooth"},
                {"file", options.in},
                {"out", options.out},
                {"method", options.method},
                {"summary", summary},
                {"frames", smoothed.motion.frames.size()},
                {"rate_hz", 1.0 / frame_time_s},
                {"resampled", source.is_resampled},
                {"filled", SpansJson(smoothed.filled, frame_time_s)},
                {"not_known", SpansJson(smoothed.unknown, frame_time_s)},
                {"jitter_before_mm", NumberOrNone(smoothed.jitter_before_mm)},
                {"jitter_after_mm", NumberOrNone(smoothed.jitter_after_mm)},
                {"moved_mm", NumberOrNone(smoothed.moved_mm)}};
  if (IsPosesFile(options.in)) {
    facts["person"] = source.person_id;
    facts["ik_worst_rms_mm"] = 1e3 * source.worst_ik_rms_m;
    facts["ik_failures"] = source.num_ik_failures;
  }
  if (feet)
    facts["feet"] = {{"contacts", feet->num_contacts},
                     {"slide_before_mm", NumberOrNone(feet->slide_before_mm)},
                     {"slide_after_mm", NumberOrNone(feet->slide_after_mm)},
                     {"failures", feet->num_failures}};
  return facts;
}

void PrintSpans(const char* what, const std::vector<FrameSpan>& spans, double frame_time_s) {
  if (spans.empty()) return;
  fmt::print("{}:", what);
  for (const FrameSpan& span : spans)
    fmt::print("{} {}-{} ({:.3g} s)", &span == spans.data() ? "" : ",", span.first, span.last,
               span.NumFrames() * frame_time_s);
  fmt::print("\n");
}

void Print(const PosesMotion& source, const SmoothedMotion& smoothed, const Feet* feet,
           const std::string& summary, const Options& options) {
  const Motion& motion = smoothed.motion;
  const double frame_time_s = motion.frame_time_s;
  fmt::print("{}: {} frames at {:.4g} Hz, {:.4g} s\n", options.in, motion.frames.size(),
             1.0 / frame_time_s, static_cast<double>(motion.frames.size()) * frame_time_s);
  if (source.is_resampled)
    fmt::print("its times are uneven: resampled to their median step, {:.4g} ms\n",
               1e3 * frame_time_s);
  if (source.num_ik_failures > 0)
    fmt::print("{} poses that no skeleton fits are taken as not known\n", source.num_ik_failures);
  fmt::print("{}\n", summary);
  PrintSpans("filled frames", smoothed.filled, frame_time_s);
  PrintSpans(
      "frames not known, in gaps that are too long (--max-gap-s), where the motion is a "
      "straight line or held",
      smoothed.unknown, frame_time_s);
  if (smoothed.jitter_before_mm >= 0.0)
    fmt::print("jitter {:.3g} -> {:.3g} mm/frame^2, poses moved by {:.3g} mm on average\n",
               smoothed.jitter_before_mm, smoothed.jitter_after_mm, smoothed.moved_mm);
  if (feet && feet->num_contacts > 0)
    fmt::print("feet locked in {} contacts: slide {:.3g} -> {:.3g} mm{}\n", feet->num_contacts,
               feet->slide_before_mm, feet->slide_after_mm,
               feet->num_failures > 0 ? fmt::format(", {} frames failed", feet->num_failures) : "");
  if (feet && feet->num_contacts == 0) fmt::print("no foot stands on the floor: none is locked\n");
}

std::vector<std::string> Statuses(const SmoothedMotion& smoothed) {
  std::vector<std::string> statuses(smoothed.motion.frames.size(), "ok");
  const auto mark = [&](const std::vector<FrameSpan>& spans, std::string_view status) {
    for (const FrameSpan& span : spans)
      std::fill_n(statuses.begin() + span.first, span.NumFrames(), std::string(status));
  };
  mark(smoothed.filled, kFilledStatus);
  mark(smoothed.unknown, kUnknownStatus);
  return statuses;
}

void Write(const PosesMotion& source, const SmoothedMotion& smoothed, const Options& options) {
  if (IsPosesFile(options.out)) {
    WritePosesJson(MotionToPoses(smoothed.motion, source, Statuses(smoothed)), options.out);
  } else {
    WriteMotion(smoothed.motion, options.out,
                {.skeleton = {}, .metres_per_unit = *MetresPerUnit(options.input.units)});
  }
}

// JSON lines come as they are captured, from a program or a file of any length.
bool IsStream(const std::string& path) {
  return path == kStandardStream || std::filesystem::path(path).extension() == ".jsonl";
}

void RequireStreamOptions(const Options& options) {
  if (!IsStream(options.in) || !IsStream(options.out))
    throw InputError(fmt::format(
        "found {} in and {} out, wanted JSON lines (- or .jsonl) for both or for neither",
        options.in, options.out));
  if (options.method != SmoothingMethods().front().name && options.method != kOnlineMethod)
    throw InputError(
        fmt::format("--method {}: wanted online, or auto, for JSON lines", options.method));
  if (options.lock_feet || !options.json.empty())
    throw InputError("--lock-feet and --json want a file that ends: write poses.json instead");
}

int SmoothStream(const Options& options) {
  RequireStreamOptions(options);
  MotionFilterOptions online = options.smoothing.online;
  online.max_gap_s = options.smooth.max_gap_s;
  std::optional<double> frame_time_s;
  if (options.input.fps > 0.0) frame_time_s = 1.0 / options.input.fps;
  PersonStream stream(ReadDictionary(options.input.dictionary.empty()
                                         ? DefaultDictionaryPath()
                                         : std::filesystem::path(options.input.dictionary))
                          .skeleton,
                      ReadCodebook(options.smoothing), options.input.person_id, online);
  const StreamReport report = SmoothLines(options.in, options.out, frame_time_s, &stream);
  fmt::print(stderr, "{} frames, {:.3g} s late; {} filled, {} not known\n", report.num_frames,
             online.latency_s, report.num_filled, report.num_unknown);
  return kDone;
}

int Smooth(const Options& options) {
  if (IsStream(options.in) || IsStream(options.out)) return SmoothStream(options);
  const PosesMotion source = ReadMotionInput(options.in, options.input);
  const Smoothing smoothing = MakeSmoothing(options.method, source.motion, options.smoothing);
  SmoothedMotion smoothed = SmoothMotion(source.motion, smoothing.smoother, options.smooth);
  Feet feet;
  if (options.lock_feet) feet = Lock(&smoothed.motion);
  Write(source, smoothed, options);
  const Feet* locked = options.lock_feet ? &feet : nullptr;
  Print(source, smoothed, locked, smoothing.summary, options);
  if (!options.json.empty())
    WriteFileAtomically(options.json, Facts(source, smoothed, locked, smoothing.summary, options)
                                              .dump(1, ' ', false, Json::error_handler_t::replace) +
                                          "\n");
  return kDone;
}

void AddMethodOptions(CLI::App* command, SmoothingOptions* options) {
  constexpr double kMost = 1e6;
  command
      ->add_option("--cutoff-hz", options->cutoff_hz,
                   "Of butterworth: faster movement is taken away [6, at most a quarter of the "
                   "frame rate]")
      ->check(IsNumber(1e-3, kMost));
  command->add_option("--motion-model", options->motion_model,
                      "Of motion-model, online and auto: a codebook [the one that ships]");
  command
      ->add_option("--latency-s", options->online.latency_s,
                   "Of online: how much later frames come out, the wiser for it")
      ->check(IsNumber(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--window-frames", options->savitzky_golay.window_frames,
                   "Of savitzky-golay: odd")
      ->capture_default_str();
  command->add_option("--degree", options->savitzky_golay.degree, "Of savitzky-golay")
      ->capture_default_str();
  command
      ->add_option("--min-cutoff-hz", options->one_euro.min_cutoff_hz,
                   "Of one-euro: lower, less jitter at rest")
      ->check(IsNumber(1e-3, kMost))
      ->capture_default_str();
  command->add_option("--beta", options->one_euro.beta, "Of one-euro: higher, less lag at speed")
      ->check(IsNumber(0.0, kMost))
      ->capture_default_str();
}

}  // namespace

CLI::App* AddSmooth(CLI::App* app, Run* run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("smooth", "Fill the gaps of a motion and smooth it");
  command->footer(
      "JSON lines (.jsonl, or - for standard input and output), a frame of poses.json each, are\n"
      "smoothed as they come and may go on for ever.\n"
      "To see what it did: poselift plot BEFORE AFTER --angles left_knee.flexion --out knee.svg\n"
      "Example: poselift smooth out/poses.json --out smooth.bvh --lock-feet");
  command->add_option("IN", options->in, "Motion to read: poses.json, .bvh, .amc, or .jsonl")
      ->required();
  command->add_option("--out", options->out, "File to write: .json (poses), .bvh, .amc, or .jsonl")
      ->required();
  command->add_option("--method", options->method, MethodHelp())
      ->check(CLI::IsMember(MethodNames()))
      ->capture_default_str();
  AddMethodOptions(command, &options->smoothing);
  command
      ->add_option("--max-gap-s", options->smooth.max_gap_s,
                   "Longer gaps are not filled, but said to be not known")
      ->check(IsNumber(0.0, 1e6))
      ->capture_default_str();
  command->add_flag("--lock-feet", options->lock_feet,
                    "Feet that stand on a level floor stay where they are");
  AddMotionInputOptions(command, &options->input);
  command->add_option("--json", options->json, "Write the report to this file too");
  *run = [options] { return Smooth(*options); };
  return command;
}

}  // namespace poselift::cli
