// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// poselift-labels, version 1: docs/FORMATS.md.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>

#include "src/io/atomic_file.h"
#include "src/io/json_text.h"
#include "src/io/labels.h"
#include "src/io/labels_formats.h"
#include "src/io/text_scanner.h"
#include "src/joint_relation.h"
#include "src/nearest_names.h"

namespace poselift {
namespace {

constexpr std::string_view kFormat = "poselift-labels";
constexpr std::string_view kStateNames[] = {"visible", "occluded", "absent"};

const JsonValue& Joints(const JsonValue& person) { return person.At("joints"); }

// The layout's own name of a landmark; "head" also stands for head_top, and
// "neck" and thorax for each other. Empty when the layout has no such landmark.
std::string_view NameInLayout(const Layout& layout, std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kAliases[] = {
      {"head", "head_top"}, {"neck", "thorax"}, {"thorax", "neck"}};
  if (const auto found = layout.Find(name)) return layout.landmarks[*found].name;
  for (const auto& [alias, own] : kAliases)
    if (const auto found = alias == name ? layout.Find(own) : std::nullopt)
      return layout.landmarks[*found].name;
  return {};
}

bool HasAllJoints(const Layout& layout, const JsonValue& root) {
  for (const JsonValue& frame : root.At("frames").Items())
    for (const JsonValue& person : frame.At("people").Items())
      for (const std::string& name : Joints(person).Keys())
        if (NameInLayout(layout, name).empty()) return false;
  return true;
}

const Layout& LayoutOfFile(const JsonValue& root) {
  const JsonValue* name = root.Find("layout");
  if (!name) return *FindLayout("body15");
  if (const Layout* layout = FindLayout(name->String())) return *layout;
  throw name->Unwanted("one of " + LayoutSizes());
}

// The file's layout, or joints23 when the file names joints beyond it: more
// joints than the layout promised do no harm.
const Layout& LayoutThatFits(const JsonValue& root) {
  const Layout& layout = LayoutOfFile(root);
  const Layout& joints23 = *FindLayout("joints23");
  return !HasAllJoints(layout, root) && HasAllJoints(joints23, root) ? joints23 : layout;
}

InputError UnknownJoint(const JsonValue& landmark, std::string_view name, const Layout& layout) {
  std::vector<std::string> known = {"neck", "head"};
  for (const Landmark& other : layout.landmarks) known.emplace_back(other.name);
  for (const JointInfo& joint : poselift::Joints()) known.emplace_back(joint.name);
  return landmark.Error(fmt::format("found the unknown joint {} (layout {}), wanted perhaps \"{}\"",
                                    Quoted(name), layout.name,
                                    NearestNames(name, known, 1).front()));
}

LabelState ReadState(const JsonValue& state) {
  const auto* found = std::find(std::begin(kStateNames), std::end(kStateNames), state.String());
  if (found == std::end(kStateNames)) throw state.Unwanted("visible, occluded or absent");
  return static_cast<LabelState>(found - std::begin(kStateNames));
}

LandmarkLabel ReadLandmark(const JsonValue& json, std::string_view name) {
  LandmarkLabel landmark;
  landmark.name = name;
  if (const JsonValue* state = json.Find("state")) landmark.state = ReadState(*state);
  const bool needs_position = landmark.state != LabelState::kAbsent;
  for (int i = 0; i < 2; ++i) {
    const char* key = i == 0 ? "x" : "y";
    if (needs_position || json.Find(key))
      landmark.x_px[i] = json.At(key).Number(-kLargestCoordinate_px, kLargestCoordinate_px);
  }
  if (const JsonValue* radius = json.Find("radius_px")) {
    landmark.radius_px = radius->Number(0.0, kLargestCoordinate_px);
    if (*landmark.radius_px == 0.0)
      throw radius->Unwanted("a standard deviation above 0 (leave it out when not known)");
  }
  return landmark;
}

constexpr std::pair<std::string_view, LabelHint::Kind> kHintKinds[] = {
    {"nearer", LabelHint::Kind::kNearer},
    {"towards_camera", LabelHint::Kind::kTowardsCamera},
    {"away_from_camera", LabelHint::Kind::kAwayFromCamera},
    {"on_floor", LabelHint::Kind::kOnFloor},
    {"height", LabelHint::Kind::kHeight},
    {"pin", LabelHint::Kind::kPin}};

LabelHint::Kind ReadHintKind(const JsonValue& kind) {
  std::string names;
  for (const auto& [name, value] : kHintKinds) {
    if (kind.String() == name) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw kind.Unwanted("one of " + names);
}

LabelHint ReadHint(const JsonValue& json) {
  LabelHint hint;
  hint.kind = ReadHintKind(json.At("kind"));
  if (hint.kind != LabelHint::Kind::kHeight) hint.joint = json.At("joint").String();
  if (hint.kind == LabelHint::Kind::kNearer) hint.other = json.At("than").String();
  if (hint.kind == LabelHint::Kind::kHeight)
    hint.metres_m = json.At("metres").Number();
  else if (const JsonValue* metres = json.Find("metres"))
    hint.metres_m = metres->Number();
  if (hint.kind == LabelHint::Kind::kPin) {
    const JsonValue& place = json.At("x_in_cam");
    if (place.Items().size() != 3) throw place.Unwanted("three metres from the pelvis");
    for (Eigen::Index i = 0; i < 3; ++i)
      hint.x_in_cam_m[i] = place.Items()[static_cast<size_t>(i)].Number();
  }
  return hint;
}

std::vector<LabelHint> ReadHints(const JsonValue& json, const Layout& layout) {
  std::vector<LabelHint> hints;
  for (const JsonValue& item : json.Items()) {
    const LabelHint hint = ReadHint(item);
    if (const std::string error = WhatIsWrongWith(hint, hints, layout); !error.empty())
      throw item.Error(error);
    hints.push_back(hint);
  }
  return hints;
}

PersonLabels ReadPerson(const JsonValue& json, const Layout& layout, int index) {
  PersonLabels person;
  person.id = index;
  if (const JsonValue* id = json.Find("id"))
    person.id = id->Integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  const JsonValue& joints = Joints(json);
  std::set<std::string_view> seen;
  for (size_t i = 0; i < joints.Members().size(); ++i) {
    const JsonValue& landmark = joints.Members()[i];
    const std::string_view name = NameInLayout(layout, joints.Keys()[i]);
    if (name.empty()) throw UnknownJoint(landmark, joints.Keys()[i], layout);
    if (!seen.insert(name).second)
      throw landmark.Error(fmt::format("found the joint {} under two names, wanted one", name));
    person.landmarks.push_back(ReadLandmark(landmark, name));
  }
  if (const JsonValue* hints = json.Find("hints")) person.hints = ReadHints(*hints, layout);
  if (const JsonValue* propagated = json.Find("propagated"))
    person.is_propagated = propagated->Boolean();
  return person;
}

void AppendNumber(double value, std::string* out) {
  if (!std::isfinite(value)) throw std::invalid_argument("labels must be finite to be written");
  fmt::format_to(std::back_inserter(*out), "{}", value);  // the shortest that reads back equal
}

void AppendLandmark(const LandmarkLabel& landmark, std::string* out) {
  AppendJsonString(landmark.name, out);
  *out += ": {";
  // An absent landmark may have a place: where it was, and will be when it is seen again.
  if (landmark.state != LabelState::kAbsent || !landmark.x_px.isZero(0.0)) {
    *out += "\"x\": ";
    AppendNumber(landmark.x_px.x(), out);
    *out += ", \"y\": ";
    AppendNumber(landmark.x_px.y(), out);
    *out += ", ";
  }
  *out += fmt::format("\"state\": \"{}\"", kStateNames[static_cast<int>(landmark.state)]);
  if (landmark.radius_px) {
    *out += ", \"radius_px\": ";
    AppendNumber(*landmark.radius_px, out);
  }
  *out += "}";
}

void AppendHint(const LabelHint& hint, std::string* out) {
  const auto* kind = std::find_if(std::begin(kHintKinds), std::end(kHintKinds),
                                  [&](const auto& named) { return named.second == hint.kind; });
  *out += fmt::format("{{\"kind\": \"{}\"", kind->first);
  const auto append_name = [&](const char* key, const std::string& name) {
    if (name.empty()) return;
    *out += fmt::format(", \"{}\": ", key);
    AppendJsonString(name, out);
  };
  append_name("joint", hint.joint);
  append_name("than", hint.other);
  if (hint.metres_m) {
    *out += ", \"metres\": ";
    AppendNumber(*hint.metres_m, out);
  }
  if (hint.kind == LabelHint::Kind::kPin)
    for (Eigen::Index i = 0; i < 3; ++i) {
      *out += i == 0 ? ", \"x_in_cam\": [" : ", ";
      AppendNumber(hint.x_in_cam_m[i], out);
    }
  *out += hint.kind == LabelHint::Kind::kPin ? "]}" : "}";
}

void AppendPerson(const PersonLabels& person, std::string* out) {
  *out += fmt::format("    {{\"id\": {}, \"joints\": {{", person.id);
  for (size_t i = 0; i < person.landmarks.size(); ++i) {
    if (i > 0) *out += ", ";
    AppendLandmark(person.landmarks[i], out);
  }
  *out += "}";
  for (size_t i = 0; i < person.hints.size(); ++i) {
    *out += i > 0 ? ", " : ", \"hints\": [";
    AppendHint(person.hints[i], out);
  }
  if (!person.hints.empty()) *out += "]";
  *out += person.is_propagated ? ", \"propagated\": true}" : "}";
}

}  // namespace

std::string WhatIsWrongWith(const LabelHint& hint, std::span<const LabelHint> before,
                            const Layout& layout) {
  const auto is_height = [](const LabelHint& h) { return h.kind == LabelHint::Kind::kHeight; };
  if (is_height(hint) && std::any_of(before.begin(), before.end(), is_height))
    return "found a second height of a person, wanted one";
  return WhatIsWrongWith(hint, layout);
}

void AppendNativePeople(const std::vector<PersonLabels>& people, std::string* out) {
  *out += "[";
  for (size_t i = 0; i < people.size(); ++i) {
    *out += i > 0 ? ",\n" : "\n";
    AppendPerson(people[i], out);
  }
  *out += "]";
}

void AppendNativeFrame(const FrameLabels& frame, std::string* out) {
  *out += "  {";
  if (!frame.image.empty()) {
    *out += "\"image\": ";
    AppendJsonString(frame.image, out);
    *out += ", ";
  }
  if (frame.width_px > 0 && frame.height_px > 0)
    *out += fmt::format("\"width\": {}, \"height\": {}, ", frame.width_px, frame.height_px);
  if (frame.time_s) {
    *out += "\"time_s\": ";
    AppendNumber(*frame.time_s, out);
    *out += ", ";
  }
  if (frame.frame) *out += fmt::format("\"frame\": {}, ", *frame.frame);
  *out += "\"people\": ";
  AppendNativePeople(frame.people, out);
  *out += "}";
}

std::vector<PersonLabels> ReadNativePeople(const JsonValue& json, const Layout& layout) {
  std::vector<PersonLabels> people;
  std::set<int> ids;
  for (const JsonValue& person : json.Items()) {
    people.push_back(ReadPerson(person, layout, static_cast<int>(people.size())));
    const int id = people.back().id;
    if (!ids.insert(id).second)
      throw person.Error(fmt::format("found a second person with the id {}, wanted one", id));
  }
  return people;
}

FrameLabels ReadNativeFrame(const JsonValue& json, const Layout& layout) {
  FrameLabels frame;
  if (const JsonValue* image = json.Find("image")) frame.image = image->String();
  if (const JsonValue* width = json.Find("width"))
    frame.width_px = width->Integer(0, kLargestPicture_px);
  if (const JsonValue* height = json.Find("height"))
    frame.height_px = height->Integer(0, kLargestPicture_px);
  if (const JsonValue* time = json.Find("time_s"))
    frame.time_s = time->Number(-kLargestTime_s, kLargestTime_s);
  if (const JsonValue* index = json.Find("frame"))
    frame.frame = index->Integer(0, std::numeric_limits<int>::max());
  frame.people = ReadNativePeople(json.At("people"), layout);
  return frame;
}

bool IsNativeLabels(const JsonValue& root) {
  return root.Is(JsonValue::Kind::kObject) && root.Find("format");
}

Labels ReadNativeLabels(const JsonValue& root, const Layout* layout) {
  if (const JsonValue& format = root.At("format"); format.String() != kFormat)
    throw format.Unwanted(fmt::format("\"{}\"", kFormat));
  if (const JsonValue& version = root.At("version"); version.Number() != 1.0)
    throw version.Unwanted("1, the version that this poselift reads");
  if (!layout) layout = &LayoutThatFits(root);
  Labels labels;
  labels.layout = layout->name;
  for (const JsonValue& frame : root.At("frames").Items())
    labels.frames.push_back(ReadNativeFrame(frame, *layout));
  return labels;
}

std::string LabelsText(const Labels& labels) {
  std::string text = fmt::format("{{\"format\": \"{}\", \"version\": 1, \"layout\": ", kFormat);
  AppendJsonString(labels.layout, &text);
  text += ",\n \"frames\": [";
  for (size_t i = 0; i < labels.frames.size(); ++i) {
    text += i > 0 ? ",\n" : "\n";
    AppendNativeFrame(labels.frames[i], &text);
  }
  text += "]}\n";
  return text;
}

void WriteLabels(const Labels& labels, const std::filesystem::path& path) {
  WriteFileAtomically(path, LabelsText(labels));
}

}  // namespace poselift
