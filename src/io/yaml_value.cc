// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/yaml_value.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr size_t kLargestFile = size_t{16} << 20;
constexpr int kDeepest = 64;

// The parser of yaml-cpp 0.7 descends by a call a level: what is deeper than this is refused
// before it sees it. Blocks nest by their indentation, flows by brackets; dashes on one line
// nest as well.
void CheckDepth(const std::string& file, std::string_view text) {
  int line = 1, brackets = 0, dashes = 0;
  bool at_start = true;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dashes = 0;
      at_start = true;
      continue;
    }
    if (c == '[' || c == '{') ++brackets;
    if (c == ']' || c == '}') brackets = std::max(0, brackets - 1);
    if (at_start && (c == '-' || c == '?')) ++dashes;
    if (c != ' ' && c != '-' && c != '?') at_start = false;
    if (brackets > kDeepest || dashes > kDeepest)
      throw InputError(file, line,
                       fmt::format("found more than {} levels, wanted fewer", kDeepest));
  }
}

std::string KindOf(const YAML::Node& node) {
  if (node.IsMap()) return "a map";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (node.IsScalar()) return Quoted(node.Scalar());
  return "nothing";
}

std::string Joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

// Decimal, whole text, finite.
std::optional<double> ToNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  if (error == std::errc::result_out_of_range) return 0.0;
  if (error != std::errc() || std::abs(value) > TextScanner::kLargestNumber) return std::nullopt;
  return value;
}

}  // namespace

YamlValue::YamlValue(std::shared_ptr<const std::string> file, const YAML::Node& node,
                     std::string path)
    : file_(std::move(file)),
      node_(std::make_shared<const YAML::Node>(node)),
      path_(std::move(path)) {}

int YamlValue::line() const { return std::max(0, node_->Mark().line) + 1; }

double YamlValue::Number() const {
  if (node_->IsScalar())
    if (const auto number = ToNumber(node_->Scalar())) return *number;
  throw Unwanted("a number");
}

int YamlValue::Integer(int lower, int upper) const {
  const double number = Number();
  if (number != std::floor(number) || number < lower || number > upper)
    throw Unwanted(fmt::format("a whole number from {} to {}", lower, upper));
  return static_cast<int>(number);
}

std::string YamlValue::String() const {
  if (!node_->IsScalar()) throw Unwanted("a text");
  return node_->Scalar();
}

std::vector<double> YamlValue::Numbers() const {
  std::vector<double> numbers;
  for (const YamlValue& item : Items()) numbers.push_back(item.Number());
  return numbers;
}

std::vector<YamlValue> YamlValue::Items() const {
  if (!node_->IsSequence()) throw Unwanted("a list");
  std::vector<YamlValue> items;
  for (const YAML::Node& item : *node_)
    items.push_back(YamlValue(file_, item, fmt::format("{}[{}]", path_, items.size())));
  return items;
}

std::vector<std::string> YamlValue::Keys() const {
  if (!node_->IsMap()) throw Unwanted("a map");
  std::vector<std::string> keys;
  for (const auto& member : *node_)
    if (member.first.IsScalar()) keys.push_back(member.first.Scalar());
  return keys;
}

bool YamlValue::IsMap() const { return node_->IsMap(); }

std::optional<YamlValue> YamlValue::Find(const std::string& key) const {
  if (!node_->IsMap()) throw Unwanted("a map");
  std::optional<YamlValue> found;
  for (const auto& member : *node_) {
    if (!member.first.IsScalar() || member.first.Scalar() != key) continue;
    const YamlValue value(file_, member.second, Joined(path_, key));
    if (found) throw value.Error(fmt::format("found it twice (first in line {})", found->line()));
    found = value;
  }
  if (found && found->node_->IsNull()) return std::nullopt;
  return found;
}

YamlValue YamlValue::At(const std::string& key) const {
  if (auto found = Find(key)) return *found;
  throw Error(fmt::format("found no {}, wanted it", key));
}

InputError YamlValue::Error(const std::string& message) const {
  return {*file_, line(), path_.empty() ? message : path_ + ": " + message};
}

InputError YamlValue::Unwanted(const std::string& wanted) const {
  return Error(fmt::format("found {}, wanted {}", KindOf(*node_), wanted));
}

YamlDocument::YamlDocument(const std::filesystem::path& path) {
  const std::string text = ReadTextFile(path);
  if (text.size() > kLargestFile)
    throw InputError(path, fmt::format("found {} bytes, wanted a YAML file of at most {}",
                                       text.size(), kLargestFile));
  CheckDepth(path, text);
  try {
    root_ = YamlValue(std::make_shared<const std::string>(path), YAML::Load(text), "");
  } catch (const YAML::Exception& error) {
    throw InputError(path, std::max(0, error.mark.line) + 1,
                     fmt::format("found no YAML: {}", error.msg));
  }
}

}  // namespace poselift
