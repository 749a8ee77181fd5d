// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/tag_check.h"
#include "calib/tag_family.h"
#include "src/capture/camera_list.h"
#include "src/capture/fourcc.h"
#include "src/capture/open_frame_source.h"
#include "src/capture/source_facts.h"
#include "src/capture/source_findings.h"
#include "src/io/atomic_file.h"
#include "ui/cli/camera_options.h"
#include "ui/cli/command.h"
#include "ui/cli/frame_rate.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

struct DoctorOptions {
  std::string source;
  std::string json;
  std::string family = "tag36h11";
  double seconds = 5.0;
  double folder_rate_hz = 1.0;
  CameraChoice camera;
};

std::string SizeText(cv::Size size_px) {
  return fmt::format("{}x{}", size_px.width, size_px.height);
}

// ---- Findings

const char* WeightText(Finding::Weight weight) {
  if (weight == Finding::Weight::kProblem) return "problem";
  return weight == Finding::Weight::kAdvice ? "advice" : "note";
}

void Print(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    fmt::print("  {:<8} {}\n", WeightText(finding.weight), finding.what);
    if (!finding.why.empty()) fmt::print("           why: {}\n", finding.why);
    if (!finding.to_do.empty()) fmt::print("           do:  {}\n", finding.to_do);
  }
}

Json ToJson(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings)
    list.push_back({{"weight", WeightText(finding.weight)},
                    {"what", finding.what},
                    {"why", finding.why},
                    {"to_do", finding.to_do}});
  return list;
}

// ---- Formats

std::string RatesText(const CameraSize& size) {
  std::string text;
  for (const double rate_hz : size.rates_hz)
    text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", rate_hz);
  return text.empty() ? "rates not told" : text + " Hz";
}

void Print(const std::vector<CameraFormat>& formats) {
  for (const CameraFormat& format : formats) {
    fmt::print("  {} ({})", FourccText(format.fourcc), format.description);
    if (format.any_size)
      fmt::print(", any size from {} to {}, such as", SizeText(format.smallest_px),
                 SizeText(format.largest_px));
    fmt::print("\n");
    for (const CameraSize& size : format.sizes)
      fmt::print("    {:<10} {}\n", SizeText(size.size_px), RatesText(size));
  }
}

Json ToJson(const std::vector<CameraFormat>& formats) {
  Json list = Json::array();
  for (const CameraFormat& format : formats) {
    Json sizes = Json::array();
    for (const CameraSize& size : format.sizes)
      sizes.push_back({{"width_px", size.size_px.width},
                       {"height_px", size.size_px.height},
                       {"rates_hz", size.rates_hz}});
    list.push_back({{"format", FourccText(format.fourcc)},
                    {"description", format.description},
                    {"any_size", format.any_size},
                    {"sizes", sizes}});
  }
  return list;
}

// ---- All cameras

Json ExamineAll(const DoctorOptions& options) {
  Json list = Json::array();
  for (const CameraInfo& camera : ListCameras()) {
    if (!camera.problem.empty()) {
      fmt::print("{}\n", camera.problem);
      list.push_back({{"path", camera.path}, {"problem", camera.problem}});
      continue;
    }
    fmt::print("{}: {} ({}, {})\n", camera.path, camera.name, camera.driver, camera.bus);
    for (const std::string& path : camera.stable_paths) fmt::print("  {}\n", path);
    Print(camera.formats);
    const auto findings = JudgeFormats(camera.formats, options.camera.Options().wanted);
    Print(findings);
    list.push_back({{"path", camera.path},
                    {"stable_paths", camera.stable_paths},
                    {"name", camera.name},
                    {"driver", camera.driver},
                    {"bus", camera.bus},
                    {"formats", ToJson(camera.formats)},
                    {"findings", ToJson(findings)}});
  }
  if (list.empty())
    fmt::print(
        "There is no camera: plug one in, then see whether `ls /dev/video*` has it; a "
        "virtual machine or a container must be given the device.\n");
  else
    fmt::print("`poselift doctor DEVICE` looks through one of them.\n");
  return {{"command", "doctor"}, {"cameras", list}};
}

// ---- One source

std::string ValueText(const CameraControl& control) {
  if (!control.value) return "not told";
  const auto words = control.menu.find(*control.value);
  return words == control.menu.end() ? std::to_string(*control.value)
                                     : fmt::format("{} ({})", *control.value, words->second);
}

void Print(const CameraFacts& camera) {
  fmt::print("  asked for            {}\n  given                {}\n", ModeText(camera.asked),
             ModeText(camera.given));
  for (const CameraControl& control : camera.controls)
    fmt::print("  {:<30} {}, from {} to {}{}\n", control.name, ValueText(control), control.lowest,
               control.highest, control.inactive ? ", automatic" : "");
}

Json ToJson(const CameraMode& mode) {
  return {{"format", FourccText(mode.fourcc)},
          {"width_px", mode.size_px.width},
          {"height_px", mode.size_px.height},
          {"rate_hz", mode.rate_hz}};
}

Json ToJson(const CameraFacts& camera) {
  Json controls = Json::object();
  for (const CameraControl& control : camera.controls)
    controls[control.name] = {{"value", control.value ? Json(*control.value) : Json()},
                              {"lowest", control.lowest},
                              {"highest", control.highest}};
  return {{"asked", ToJson(camera.asked)},        {"given", ToJson(camera.given)},
          {"num_lost", camera.counts.lost},       {"num_bad", camera.counts.bad},
          {"num_dropped", camera.counts.dropped}, {"controls", controls},
          {"formats", ToJson(camera.formats)}};
}

void Print(const SourceFacts& facts, cv::Size size_px) {
  fmt::print("{}: {} picture{} of {}", facts.name, facts.num_frames,
             facts.num_frames == 1 ? "" : "s", SizeText(size_px));
  if (facts.num_frames > 1)
    fmt::print(" in {:.2f} s, {:.4g} a second", facts.duration_s, facts.rate_hz());
  fmt::print("\n");
  if (facts.camera) Print(*facts.camera);
  fmt::print("  grey                 mean {:.0f} of 255, {:.1f} % near black, {:.1f} % saturated\n",
             facts.mean_grey, 100.0 * facts.dark_part, 100.0 * facts.saturated_part);
  if (!facts.tags || facts.tags->num_found == 0) return;
  fmt::print("  tags                 {} in the {} looked at", facts.tags->num_found,
             facts.samples.size());
  if (facts.tags->wider_edge_px > 0.0)
    fmt::print(", edges {:.1f} and {:.1f} px wide", facts.tags->sharper_edge_px,
               facts.tags->wider_edge_px);
  fmt::print("\n");
}

Json ToJson(const SourceFacts& facts, cv::Size size_px) {
  Json json = {{"command", "doctor"},
               {"source", facts.name},
               {"width_px", size_px.width},
               {"height_px", size_px.height},
               {"num_pictures", facts.num_frames},
               {"duration_s", facts.duration_s},
               {"rate_hz", facts.rate_hz()},
               {"longest_gap_s", facts.longest_gap_s},
               {"mean_grey", facts.mean_grey},
               {"dark_part", facts.dark_part},
               {"saturated_part", facts.saturated_part}};
  if (facts.tags)
    json["tags"] = {{"num_found", facts.tags->num_found},
                    {"num_found_mirrored", facts.tags->num_found_mirrored},
                    {"num_pictures", facts.samples.size()},
                    {"sharper_edge_px", facts.tags->sharper_edge_px},
                    {"wider_edge_px", facts.tags->wider_edge_px}};
  if (facts.camera) json["camera"] = ToJson(*facts.camera);
  return json;
}

Json ExamineOne(const DoctorOptions& options) {
  FrameSourceOptions opening;
  opening.pictures = Pictures::kGrey;
  opening.folder_rate_hz = options.folder_rate_hz;
  opening.live.camera = options.camera.Options();
  opening.live.max_waiting = 8;  // what is lost here is the camera's doing
  const auto source = OpenFrameSource(options.source, opening);
  SourceFacts facts = WatchSource(source.get(), options.seconds);
  facts.name = options.source;
  if (const auto* live = dynamic_cast<const LiveFrameSource*>(source.get()))
    facts.camera = FactsOf(*live, opening.live.camera.wanted);
  facts.tags = CheckTags(facts.samples, options.family);
  Print(facts, source->size_px());
  const std::vector<Finding> findings = JudgeSource(facts);
  Print(findings);
  if (findings.empty()) fmt::print("  nothing to be better\n");
  Json json = ToJson(facts, source->size_px());
  json["findings"] = ToJson(findings);
  return json;
}

int Doctor(const DoctorOptions& options) {
  const Json report = options.source.empty() ? ExamineAll(options) : ExamineOne(options);
  if (!options.json.empty())
    WriteFileAtomically(options.json,
                        report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return kDone;
}

}  // namespace

CLI::App* AddDoctor(CLI::App* app, Run* run) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command =
      app->add_subcommand("doctor", "Say what a camera can do and what would make it better");
  command->add_option(
      "SOURCE", options->source,
      "A camera (/dev/video0), a video, or a folder of pictures; none: all cameras");
  command->add_option("--seconds", options->seconds, "How long to look at it")
      ->check(IsNumber(0.1, 3600.0))
      ->capture_default_str();
  command->add_option("--tag-family", options->family, "Of the tags that may be in view")
      ->check(CLI::IsMember(TagFamily::Names()))
      ->capture_default_str();
  AddCameraOptions(command, &options->camera);
  command->add_option("--json", options->json, "Write the same to this file");
  command->footer("Example: poselift doctor /dev/video0 --set exposure=50 --json camera.json");
  *run = [options] { return Doctor(*options); };
  return command;
}

}  // namespace poselift::cli
