// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "src/input_error.h"
#include "src/io/mapped_file.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

// Fields of a line; none of ours is quoted.
std::vector<std::string_view> Fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

// The next line, without its end; the text goes on behind it.
std::string_view TakeLine(std::string_view* text) {
  const size_t end = std::min(text->find('\n'), text->size());
  std::string_view line = text->substr(0, end);
  text->remove_prefix(std::min(end + 1, text->size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

// All of ours say first which command wrote them.
bool IsReport(const std::filesystem::path&, std::string_view head) {
  constexpr size_t kFirstKey = 20;
  return head.starts_with('{') &&
         head.substr(0, kFirstKey).find("\"command\"") != std::string_view::npos;
}

// Its values; of lists how long they are.
Json DescribeReport(const std::filesystem::path& path) {
  const MappedFile file(path);
  const Json report = Json::parse(file.Bytes(), nullptr, false);
  if (!report.is_object())
    throw InputError(path.string(), "found a report that is cut short or no JSON, wanted it whole");
  Json facts = Json::object();
  for (const auto& [name, value] : report.items()) {
    const std::string key = name == "file" || name == "kind" ? "of_" + name : name;
    facts[key] = value.is_array() ? Json(fmt::format("{} entries", value.size())) : value;
  }
  return facts;
}

bool IsAnglesCsv(const std::filesystem::path&, std::string_view head) {
  return head.starts_with("frame,time_s");
}

Json DescribeAnglesCsv(const std::filesystem::path& path) {
  const MappedFile file(path);
  std::string_view text = file.Bytes();
  const std::vector<std::string_view> columns = Fields(TakeLine(&text));
  size_t num_frames = 0, num_known = 0;
  std::string first_s, last_s;
  for (int line = 2; !text.empty(); ++line) {
    const std::vector<std::string_view> fields = Fields(TakeLine(&text));
    if (fields.size() != columns.size())
      throw InputError(path.string(), line,
                       fmt::format("found {} fields, wanted {} as in the first line", fields.size(),
                                   columns.size()));
    if (num_frames++ == 0) first_s = fields[1];
    last_s = fields[1];
    num_known += std::any_of(fields.begin() + 2, fields.end(),
                             [](std::string_view field) { return !field.empty(); });
  }
  Json facts = {{"angles", columns.size() - 2}, {"frames", num_frames}, {"known", num_known}};
  if (!last_s.empty()) facts["time_s"] = fmt::format("{} to {}", first_s, last_s);
  return facts;
}

}  // namespace poselift::cli
