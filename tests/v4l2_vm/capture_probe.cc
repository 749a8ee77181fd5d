// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What capture makes of a device, as lines of key=value for a script:
//
//   poselift_capture_probe --list                 a line a camera and a line a mode
//   poselift_capture_probe --controls DEVICE      a line a control
//   poselift_capture_probe DEVICE [--format MJPG] [--size 1280x720] [--rate 30] [--frames 30]
//     [--set NAME=VALUE]... [--timeout SECONDS] [--bgr]
//
// Streaming prints asked=, given=, a line a frame and the counts at the end. Exit code 3,
// with the message on stderr, for what capture refuses; what came before it is printed.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "src/capture/camera_controls.h"
#include "src/capture/camera_list.h"
#include "src/capture/camera_stream.h"
#include "src/capture/fourcc.h"
#include "src/input_error.h"

namespace {

using namespace poselift;

struct ProbeOptions {
  bool list = false;
  bool controls = false;
  bool bgr = false;
  std::string device;
  CameraOptions camera;
  int num_frames = 30;
  double timeout_s = 5.0;
};

ProbeOptions Parse(const std::vector<std::string>& words) {
  ProbeOptions options;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto next = [&]() -> std::string {
      if (i + 1 == words.size()) throw InputError(word, "wanted a value behind it");
      return words[++i];
    };
    CameraMode& wanted = options.camera.wanted;
    if (word == "--list") {
      options.list = true;
    } else if (word == "--controls") {
      options.controls = true;
    } else if (word == "--bgr") {
      options.bgr = true;
    } else if (word == "--format") {
      const std::string text = next() + "    ";
      wanted.fourcc = Fourcc(text[0], text[1], text[2], text[3]);
    } else if (word == "--size") {
      const std::string text = next();
      if (std::sscanf(text.c_str(), "%dx%d", &wanted.size_px.width, &wanted.size_px.height) != 2)
        throw InputError(word, "found " + text + ", wanted WIDTHxHEIGHT");
    } else if (word == "--rate") {
      wanted.rate_hz = std::atof(next().c_str());
    } else if (word == "--frames") {
      options.num_frames = std::atoi(next().c_str());
    } else if (word == "--timeout") {
      options.timeout_s = std::atof(next().c_str());
    } else if (word == "--set") {
      options.camera.controls.push_back(ParseControl(next()));
    } else {
      options.device = word;
    }
  }
  return options;
}

void List() {
  for (const CameraInfo& camera : ListCameras()) {
    fmt::print("camera={} name='{}' driver={} bus={} problem='{}'\n", camera.path, camera.name,
               camera.driver, camera.bus, camera.problem);
    for (const std::string& path : camera.stable_paths) fmt::print("  stable={}\n", path);
    for (const CameraFormat& format : camera.formats)
      for (const CameraSize& size : format.sizes) {
        fmt::print("  format={} size={}x{} any_size={} rates=", FourccText(format.fourcc),
                   size.size_px.width, size.size_px.height, format.any_size);
        for (const double rate_hz : size.rates_hz) fmt::print("{:.3f},", rate_hz);
        fmt::print("\n");
      }
  }
}

void ListDeviceControls(const std::string& path) {
  const V4l2Device device(path);
  for (const CameraControl& control : ListControls(device)) {
    fmt::print("control={} lowest={} highest={} step={} preset={} value={} inactive={} menu=",
               control.name, control.lowest, control.highest, control.step, control.preset,
               control.value ? std::to_string(*control.value) : "none", control.inactive);
    for (const auto& [value, words] : control.menu) fmt::print("{}:'{}',", value, words);
    fmt::print("\n");
  }
}

void Stream(const ProbeOptions& options) {
  CameraStream stream(options.device, options.camera);
  FrameDecoder decoder;
  fmt::print("name='{}' driver={}\nasked={}\ngiven={}\nbytes_per_line={}\n", stream.device().name(),
             stream.device().driver(), ModeText(stream.asked()), ModeText(stream.given()),
             stream.format().bytes_per_line);
  for (const ControlSetting& control : stream.controls())
    fmt::print("control={} asked={} given={}\n", control.name, control.asked, control.given);
  double first_s = 0.0, last_s = 0.0;
  int num_undecodable = 0;
  for (int i = 0; i < options.num_frames; ++i) {
    const auto frame = stream.Read(options.timeout_s);
    if (!frame) {
      fmt::print("timeout={}\n", options.timeout_s);
      break;
    }
    cv::Mat picture;
    const std::string flaw = options.bgr ? decoder.ToBgr(stream.format(), frame->bytes, &picture)
                                         : decoder.ToGrey(stream.format(), frame->bytes, &picture);
    num_undecodable += flaw.empty() ? 0 : 1;
    const double mean = flaw.empty() ? cv::mean(picture)[0] : 0.0;
    last_s = frame->monotonic_s;
    if (i == 0) first_s = last_s;
    fmt::print(
        "frame={} sequence={} lost={} time_s={:.6f} age_ms={:.3f} bytes={} mean={:.2f} "
        "flaw='{}'\n",
        i, frame->sequence, frame->num_lost, last_s - first_s,
        1000.0 * (RealSystem()->Now_s() - last_s), frame->bytes.total(), mean, flaw);
    std::fflush(stdout);
  }
  const CaptureCounts& counts = stream.counts();
  fmt::print("num_given={}\nnum_lost={}\nnum_bad={}\nnum_undecodable={}\nfps={:.3f}\n",
             counts.given, counts.lost, counts.bad, num_undecodable,
             last_s > first_s ? static_cast<double>(counts.given - 1) / (last_s - first_s) : 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const ProbeOptions options = Parse({argv + 1, argv + argc});
    if (options.list)
      List();
    else if (options.controls)
      ListDeviceControls(options.device);
    else
      Stream(options);
    return 0;
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "poselift_capture_probe: %s\n", error.what());
    return 3;
  }
}
