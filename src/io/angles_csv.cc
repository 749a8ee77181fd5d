// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/angles_csv.h"

#include <cmath>
#include <string_view>
#include <unordered_set>

#include "src/io/atomic_file.h"
#include "src/io/json_text.h"

namespace poselift {
namespace {

constexpr int kDegreeDecimals = 3, kTimeDecimals = 6;

const PersonPose* FindPerson(const FramePoses& frame, int id) {
  for (const PersonPose& person : frame.people)
    if (person.id == id) return &person;
  return nullptr;
}

// The person of the table: the first of the first frame with anybody.
const PersonPose* Follow(const FramePoses& frame, std::optional<int>* id) {
  if (!*id && !frame.people.empty()) *id = frame.people.front().id;
  return *id ? FindPerson(frame, **id) : nullptr;
}

void AppendField(std::string_view text, std::string* out) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    *out += text;
    return;
  }
  *out += '"';
  for (const char c : text) {
    if (c == '"') *out += '"';
    *out += c;
  }
  *out += '"';
}

void AppendNumberField(double value, int decimals, std::string* out) {
  if (std::isfinite(value)) AppendJsonNumber(value, decimals, out);
}

std::string Header(const std::vector<std::string>& columns) {
  std::string text = "frame,time_s";
  for (const std::string& name : columns) {
    text += ',';
    AppendField(name, &text);
  }
  return text + "\r\n";
}

double Find(const NamedAngles& angles, std::string_view name) {
  for (const auto& [angle, value] : angles)
    if (angle == name) return value;
  return kUnknown;
}

// person: may be null.
void AppendRow(int64_t number, const FramePoses& frame, const PersonPose* person,
               NamedAngles PersonPose::*values, const std::vector<std::string>& columns,
               std::string* text) {
  *text += std::to_string(number) + ",";
  AppendNumberField(frame.time_s.value_or(kUnknown), kTimeDecimals, text);
  for (const std::string& name : columns) {
    *text += ',';
    if (person) AppendNumberField(Find(person->*values, name), kDegreeDecimals, text);
  }
  *text += "\r\n";
}

std::vector<std::string> ColumnsOf(const Poses& poses, NamedAngles PersonPose::*values) {
  std::vector<std::string> columns;
  std::unordered_set<std::string_view> known;
  std::optional<int> id;
  for (const FramePoses& frame : poses.frames)
    if (const PersonPose* person = Follow(frame, &id))
      for (const auto& [name, value] : person->*values)
        if (known.insert(name).second) columns.push_back(name);
  return columns;
}

std::string Table(const Poses& poses, NamedAngles PersonPose::*values) {
  const std::vector<std::string> columns = ColumnsOf(poses, values);
  std::string text = Header(columns);
  std::optional<int> id;
  for (size_t f = 0; f < poses.frames.size(); ++f)
    AppendRow(static_cast<int64_t>(f), poses.frames[f], Follow(poses.frames[f], &id), values,
              columns, &text);
  return text;
}

}  // namespace

GrowingAnglesCsv::GrowingAnglesCsv(const std::filesystem::path& path,
                                   NamedAngles PersonPose::*values,
                                   const std::vector<std::string>& columns)
    : values_(values), columns_(columns), file_(path, Header(columns), "") {}

void GrowingAnglesCsv::Add(const FramePoses& frame) {
  std::string row;
  AppendRow(num_frames_, frame, Follow(frame, &person_id_), values_, columns_, &row);
  file_.Append(row);
  ++num_frames_;
}

std::string AnglesCsv(const Poses& poses) { return Table(poses, &PersonPose::angles_deg); }

std::string AnglesSigmaCsv(const Poses& poses) {
  return Table(poses, &PersonPose::angles_sigma_deg);
}

void WriteAnglesCsv(const Poses& poses, const std::filesystem::path& path) {
  WriteFileAtomically(path, AnglesCsv(poses));
}

void WriteAnglesSigmaCsv(const Poses& poses, const std::filesystem::path& path) {
  WriteFileAtomically(path, AnglesSigmaCsv(poses));
}

}  // namespace poselift
