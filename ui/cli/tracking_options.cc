// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/tracking_options.h"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include "src/input_error.h"
#include "ui/cli/camera_options.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/refuse_options.h"

namespace poselift::cli {

void AddViewOptions(CLI::App* command, TrackingInputs* inputs) {
  command->add_option(
      "--camera", inputs->camera,
      "Calibrated camera (see poselift calibrate), FILE#NAME in a file of several; without "
      "one --fov-deg is taken");
  command
      ->add_option("--fov-deg", inputs->fov_deg,
                   "How wide a camera sees that nobody calibrated, horizontally, in degrees; 1 is "
                   "weak perspective")
      ->check(IsNumber(1.0, 170.0))
      ->capture_default_str();
  command
      ->add_option("--focal-px", inputs->focal_px,
                   "Likewise, by its focal length in pixels of the picture")
      ->check(IsNumber(1.0, 1e6))
      ->excludes("--fov-deg");
  command
      ->add_option("--pitch-deg", inputs->pitch_deg,
                   "How far the camera looks down, so that who stands is upright")
      ->check(IsNumber(-90.0, 90.0))
      ->capture_default_str();
  command
      ->add_option("--roll-deg", inputs->roll_deg,
                   "How far the camera leans to its right, as seen from behind it")
      ->check(IsNumber(-180.0, 180.0))
      ->capture_default_str();
  AddCameraOptions(command, &inputs->device);
  command->add_option("--fps", inputs->folder_rate_hz, "Folder: pictures a second")
      ->check(IsFrameRate())
      ->capture_default_str();
}

std::optional<SourceKind> RefuseViewOptions(const CLI::App& command, const TrackingInputs& inputs) {
  SourceKind kind = SourceKind::kCamera;
  try {
    kind = KindOfSource(inputs.input);
  } catch (const InputError&) {
    return std::nullopt;  // who opens it says what is wrong
  }
  if (kind != SourceKind::kCamera)
    RefuseOptions(command, {"--size", "--rate", "--format", "--set"},
                  "it is of a camera, and " + inputs.input + " is none");
  if (kind != SourceKind::kFolder)
    RefuseOptions(command, {"--fps"}, "it is of a folder of pictures, which have no times");
  if (!inputs.camera.empty())
    RefuseOptions(command, {"--fov-deg", "--focal-px"},
                  "the file of --camera says how wide it sees");
  return kind;
}

void AddTrackingInputs(CLI::App* command, TrackingInputs* inputs) {
  command->add_option("INPUT,--device", inputs->input,
                      "A camera (/dev/video0, or 0), a video, or a folder of pictures");
  AddViewOptions(command, inputs);
  command->add_flag("--realtime", inputs->realtime,
                    "Video: as a camera would give it, late frames lost");
  command->add_option("--dictionary", inputs->dictionary, "Default: the one that ships");
  command->add_option("--motion-model", inputs->motion_model, "Default: the one that ships");
  command->parse_complete_callback([command, inputs] {
    if (inputs->input.empty())
      throw CLI::RequiredError("INPUT (a camera, /dev/video0, a video, or a folder of pictures)");
    const auto kind = RefuseViewOptions(*command, *inputs);
    if (kind == SourceKind::kCamera)
      RefuseOptions(*command, {"--realtime"}, "a camera is so anyway");
  });
}

}  // namespace poselift::cli
