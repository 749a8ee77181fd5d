// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/capture/v4l2_device.h"

namespace poselift {

// A setting of a camera: exposure, gain, focus.
struct CameraControl {
  uint32_t id = 0;    // V4L2_CID_...
  std::string name;   // as v4l2-ctl writes it: "exposure_time_absolute"
  std::string label;  // the driver's: "Exposure Time, Absolute"
  int64_t lowest = 0, highest = 0, step = 1, preset = 0;
  std::map<int64_t, std::string> menu;  // the values of a menu
  std::optional<int64_t> value;         // nothing where it cannot be read
  bool inactive = false;                // for the time, as an automatic has it
  bool read_only = false;
};

// Those with a number for a value; boolean: 0 and 1.
std::vector<CameraControl> ListControls(const V4l2Device& device);

struct ControlValue {
  std::string name;
  std::string value;  // a number, or the words of a menu
};

// "exposure=50". Throws InputError for other text.
ControlValue ParseControl(const std::string& text);

struct ControlSetting {
  std::string name;
  int64_t asked = 0;
  int64_t given = 0;  // read back: drivers round
};

// Sets a control by its name, or by one of these that do for every kernel: exposure (in
// 0.1 ms), gain, focus, white_balance. Before a value that an automatic would
// overrule that is set to manual: exposure, gain, focus, white balance, hue, brightness.
// Throws InputError for a name that the camera does not have (the nearest are named), a
// value outside its range, and what the driver refuses.
ControlSetting SetControl(const V4l2Device& device, const ControlValue& control);

}  // namespace poselift
