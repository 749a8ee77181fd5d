// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/camera_options.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <functional>

#include "src/capture/camera_formats.h"
#include "src/capture/live_frame_source.h"
#include "src/input_error.h"
#include "ui/cli/frame_rate.h"

namespace poselift::cli {
namespace {

// What a reader complains of is wrong usage.
CLI::Validator Reads(const std::function<void(const std::string&)>& read, const std::string& name) {
  const auto flaw = [read](const std::string& text) -> std::string {
    try {
      read(text);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  return {flaw, name};
}

}  // namespace

void TellCamera(const FrameSource& source) {
  const auto* const live = dynamic_cast<const LiveFrameSource*>(&source);
  if (!live) return;
  fmt::print(stderr, "camera: asked for {}, got {}\n", ModeText(live->camera().asked()),
             ModeText(live->camera().given()));
  for (const ControlSetting& control : live->camera().controls())
    fmt::print(stderr, "camera: {} asked for {}, got {}\n", control.name, control.asked,
               control.given);
}

void AddCameraOptions(CLI::App* command, CameraChoice* choice) {
  command->add_option("--size", choice->size, "The camera's picture, WIDTHxHEIGHT")
      ->check(Reads(ParseSize, "WIDTHxHEIGHT"))
      ->capture_default_str();
  command->add_option("--rate", choice->rate_hz, "The camera's pictures a second")
      ->check(IsFrameRate())
      ->capture_default_str();
  command
      ->add_option("--format", choice->format,
                   "The camera's format: " + DecodableFormats() + "; else the best for the rate")
      ->check(Reads(ParseFormat, "FORMAT"));
  command
      ->add_option("--set", choice->controls,
                   "A control of the camera: exposure=50 (0.1 ms), gain=20, ...; exposure, gain, "
                   "focus and white balance are set to manual before")
      ->check(Reads(ParseControl, "NAME=VALUE"))
      ->allow_extra_args(false);
}

}  // namespace poselift::cli
