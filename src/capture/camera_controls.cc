// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/camera_controls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

#include "src/input_error.h"
#include "src/nearest_names.h"

namespace poselift {
namespace {

constexpr int kMostControls = 1024;
constexpr int64_t kMostMenuItems = 256;

// Names that stay the same while kernels rename theirs.
struct Alias {
  std::string_view name;
  uint32_t id;
};
constexpr std::array kAliases = {Alias{"exposure", V4L2_CID_EXPOSURE_ABSOLUTE},
                                 Alias{"exposure", V4L2_CID_EXPOSURE}, Alias{"gain", V4L2_CID_GAIN},
                                 Alias{"focus", V4L2_CID_FOCUS_ABSOLUTE},
                                 Alias{"white_balance", V4L2_CID_WHITE_BALANCE_TEMPERATURE}};

// What must be set to manual before a value counts.
struct Automatic {
  uint32_t id;
  uint32_t automatic_id;
  std::array<int64_t, 2> manual;  // the first that its menu has
};
constexpr std::array kAutomatics = {
    Automatic{V4L2_CID_EXPOSURE_ABSOLUTE,
              V4L2_CID_EXPOSURE_AUTO,
              {V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_SHUTTER_PRIORITY}},
    Automatic{V4L2_CID_EXPOSURE,
              V4L2_CID_EXPOSURE_AUTO,
              {V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_SHUTTER_PRIORITY}},
    Automatic{V4L2_CID_GAIN, V4L2_CID_AUTOGAIN, {0, 0}},
    Automatic{V4L2_CID_FOCUS_ABSOLUTE, V4L2_CID_FOCUS_AUTO, {0, 0}},
    Automatic{V4L2_CID_WHITE_BALANCE_TEMPERATURE, V4L2_CID_AUTO_WHITE_BALANCE, {0, 0}},
    Automatic{V4L2_CID_HUE, V4L2_CID_HUE_AUTO, {0, 0}},
    Automatic{V4L2_CID_BRIGHTNESS, V4L2_CID_AUTOBRIGHTNESS, {0, 0}}};

// As v4l2-ctl does it: letters and figures, one underscore for all else between.
std::string PlainName(std::string_view label) {
  std::string name;
  for (const char letter : label) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code))
      name += static_cast<char>(std::tolower(code));
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

template <typename Char, size_t kSize>
std::string Text(const Char (&field)[kSize]) {
  const auto* text = reinterpret_cast<const char*>(field);
  return {text, strnlen(text, kSize)};
}

std::map<int64_t, std::string> ListMenu(const V4l2Device& device, const CameraControl& control,
                                        bool of_numbers) {
  std::map<int64_t, std::string> menu;
  const int64_t last = std::min(control.highest, control.lowest + kMostMenuItems);
  for (int64_t i = control.lowest; i <= last; ++i) {
    v4l2_querymenu item{};
    item.id = control.id;
    item.index = static_cast<uint32_t>(i);
    if (device.Try(VIDIOC_QUERYMENU, &item)) continue;  // a gap
    menu[i] = of_numbers ? std::to_string(item.value) : Text(item.name);
  }
  return menu;
}

bool HasNumber(uint32_t type) {
  return type == V4L2_CTRL_TYPE_INTEGER || type == V4L2_CTRL_TYPE_BOOLEAN ||
         type == V4L2_CTRL_TYPE_MENU || type == V4L2_CTRL_TYPE_INTEGER_MENU ||
         type == V4L2_CTRL_TYPE_BITMASK || type == V4L2_CTRL_TYPE_BUTTON;
}

// The control after that id, by the newer call or the older one.
int QueryNext(const V4l2Device& device, uint32_t id, v4l2_query_ext_ctrl* next) {
  *next = {};
  next->id = id | V4L2_CTRL_FLAG_NEXT_CTRL;
  const int error = device.Try(VIDIOC_QUERY_EXT_CTRL, next);
  if (error != ENOTTY) return error;
  v4l2_queryctrl older{};
  older.id = id | V4L2_CTRL_FLAG_NEXT_CTRL;
  if (const int older_error = device.Try(VIDIOC_QUERYCTRL, &older)) return older_error;
  next->id = older.id;
  next->type = older.type;
  std::memcpy(next->name, older.name, sizeof(older.name));
  next->minimum = older.minimum;
  next->maximum = older.maximum;
  next->step = static_cast<uint32_t>(older.step);
  next->default_value = older.default_value;
  next->flags = older.flags;
  return 0;
}

std::optional<int64_t> ReadValue(const V4l2Device& device, uint32_t id) {
  v4l2_control control{};
  control.id = id;
  if (device.Try(VIDIOC_G_CTRL, &control)) return std::nullopt;
  return control.value;
}

CameraControl Describe(const V4l2Device& device, const v4l2_query_ext_ctrl& query) {
  CameraControl control;
  control.id = query.id;
  control.label = Text(query.name);
  control.name = PlainName(control.label);
  control.lowest = query.minimum;
  control.highest = query.maximum;
  control.step = std::max<int64_t>(1, static_cast<int64_t>(query.step));
  control.preset = query.default_value;
  control.inactive = (query.flags & V4L2_CTRL_FLAG_INACTIVE) != 0;
  control.read_only = (query.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
  if (query.type == V4L2_CTRL_TYPE_MENU || query.type == V4L2_CTRL_TYPE_INTEGER_MENU)
    control.menu = ListMenu(device, control, query.type == V4L2_CTRL_TYPE_INTEGER_MENU);
  if (query.type != V4L2_CTRL_TYPE_BUTTON && !(query.flags & V4L2_CTRL_FLAG_WRITE_ONLY))
    control.value = ReadValue(device, query.id);
  return control;
}

const CameraControl* FindId(const std::vector<CameraControl>& controls, uint32_t id) {
  const auto found = std::find_if(controls.begin(), controls.end(),
                                  [&](const CameraControl& control) { return control.id == id; });
  return found == controls.end() ? nullptr : &*found;
}

const CameraControl& Find(const V4l2Device& device, const std::vector<CameraControl>& controls,
                          const std::string& name) {
  for (const CameraControl& control : controls)
    if (control.name == name) return control;
  std::vector<std::string> names;
  for (const Alias& alias : kAliases)
    if (const CameraControl* control = FindId(controls, alias.id)) {
      if (alias.name == name) return *control;
      names.emplace_back(alias.name);
    }
  if (controls.empty())
    throw InputError(device.path(), fmt::format("found the control '{}', but it has none", name));
  for (const CameraControl& control : controls) names.push_back(control.name);
  throw InputError(device.path(),
                   fmt::format("found the control '{}', wanted one it has, such as {}", name,
                               fmt::join(NearestNames(name, names, 4), ", ")));
}

std::string RangeText(const CameraControl& control) {
  if (control.menu.empty())
    return fmt::format("{} to {}{}", control.lowest, control.highest,
                       control.step == 1 ? "" : fmt::format(" in steps of {}", control.step));
  std::string text;
  for (const auto& [value, words] : control.menu)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", value, words);
  return text;
}

int64_t ParseValue(const V4l2Device& device, const CameraControl& control,
                   const std::string& text) {
  for (const auto& [value, words] : control.menu)
    if (PlainName(words) == PlainName(text)) return value;
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  const bool is_in_range = value >= control.lowest && value <= control.highest;
  const bool is_in_menu = control.menu.empty() || control.menu.count(value) > 0;
  if (!is_number || !is_in_range || !is_in_menu)
    throw InputError(device.path(), fmt::format("found {} = {}, wanted {}", control.name, text,
                                                RangeText(control)));
  return value;
}

void Write(const V4l2Device& device, const CameraControl& control, int64_t value) {
  v4l2_control written{};
  written.id = control.id;
  written.value = static_cast<int32_t>(value);
  const int error = device.Try(VIDIOC_S_CTRL, &written);
  if (error == ENODEV) device.Fail("set it", error);
  if (error)
    throw InputError(device.path(),
                     fmt::format("refuses {} = {}: {}", control.name, value, std::strerror(error)));
}

void SetManual(const V4l2Device& device, const std::vector<CameraControl>& controls, uint32_t id) {
  for (const Automatic& automatic : kAutomatics) {
    if (automatic.id != id) continue;
    const CameraControl* control = FindId(controls, automatic.automatic_id);
    if (!control || control->read_only) continue;
    const bool has_first =
        control->menu.empty() || control->menu.count(automatic.manual.front()) > 0;
    Write(device, *control, has_first ? automatic.manual.front() : automatic.manual.back());
  }
}

}  // namespace

std::vector<CameraControl> ListControls(const V4l2Device& device) {
  std::vector<CameraControl> controls;
  v4l2_query_ext_ctrl query{};
  for (int i = 0; i < kMostControls && QueryNext(device, query.id, &query) == 0; ++i)
    if (HasNumber(query.type) && !(query.flags & V4L2_CTRL_FLAG_DISABLED))
      controls.push_back(Describe(device, query));
  return controls;
}

ControlValue ParseControl(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw InputError(fmt::format("found the control '{}', wanted name=value: exposure=50", text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

ControlSetting SetControl(const V4l2Device& device, const ControlValue& wanted) {
  const std::vector<CameraControl> controls = ListControls(device);
  const CameraControl& control = Find(device, controls, wanted.name);
  if (control.read_only)
    throw InputError(device.path(), fmt::format("cannot set {}: it is read only", control.name));
  const int64_t value = ParseValue(device, control, wanted.value);
  SetManual(device, controls, control.id);
  Write(device, control, value);
  return {control.name, value, ReadValue(device, control.id).value_or(value)};
}

}  // namespace poselift
