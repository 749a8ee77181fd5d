// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/angles_csv.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

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

// The first person in each frame; null where it is missing.
std::vector<const PersonPose*> FollowFirstPerson(const Poses& poses) {
  std::vector<const PersonPose*> rows;
  std::optional<int> id;
  for (const FramePoses& frame : poses.frames) {
    if (!id && !frame.people.empty()) id = frame.people.front().id;
    rows.push_back(id ? FindPerson(frame, *id) : nullptr);
  }
  return rows;
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

using NamedValues = std::vector<std::pair<std::string, double>>;

std::string Table(const Poses& poses, NamedValues PersonPose::*values) {
  const std::vector<const PersonPose*> rows = FollowFirstPerson(poses);
  std::unordered_map<std::string_view, size_t> column_of_name;
  std::string text = "frame,time_s";
  for (const PersonPose* person : rows) {
    if (!person) continue;
    for (const auto& [name, value] : person->*values) {
      if (!column_of_name.emplace(name, column_of_name.size()).second) continue;
      text += ',';
      AppendField(name, &text);
    }
  }
  text += "\r\n";
  std::vector<double> row(column_of_name.size());
  for (size_t f = 0; f < rows.size(); ++f) {
    std::fill(row.begin(), row.end(), kUnknown);
    if (rows[f])
      for (const auto& [name, value] : rows[f]->*values) row[column_of_name.at(name)] = value;
    text += std::to_string(f) + ",";
    AppendNumberField(poses.frames[f].time_s.value_or(kUnknown), kTimeDecimals, &text);
    for (const double value : row) {
      text += ',';
      AppendNumberField(value, kDegreeDecimals, &text);
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace

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
