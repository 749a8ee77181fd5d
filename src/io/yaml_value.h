// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/input_error.h"

namespace YAML {  // NOLINT(readability-identifier-naming): the name of yaml-cpp
class Node;
}

namespace poselift {

// A value of a YAML file that knows its line and its path, as JsonValue does (json_value.h):
//   camchain.yaml:7: cam0.intrinsics: found 3 values, wanted 4
// The getters throw InputError when the value is of another kind. Copies are cheap; they keep
// the document alive.
class YamlValue {
 public:
  int line() const;  // where the value begins, from 1
  const std::string& path() const { return path_; }

  double Number() const;  // finite, at most 1e9 large
  int Integer(int lower, int upper) const;
  std::string String() const;
  std::vector<double> Numbers() const;    // of a list
  std::vector<YamlValue> Items() const;   // of a list
  std::vector<std::string> Keys() const;  // of a map, in the file's order

  bool IsMap() const;
  // A member of a map. Find: nothing when it is not there or is null.
  std::optional<YamlValue> Find(const std::string& key) const;
  YamlValue At(const std::string& key) const;

  InputError Error(const std::string& message) const;
  // 'found <this>, wanted <wanted>'
  InputError Unwanted(const std::string& wanted) const;

 private:
  friend class YamlDocument;
  YamlValue(std::shared_ptr<const std::string> file, const YAML::Node& node, std::string path);

  std::shared_ptr<const std::string> file_;
  std::shared_ptr<const YAML::Node> node_;
  std::string path_;
};

// A whole YAML file of one document in memory. Throws InputError with file:line for what is no
// YAML, is nested deeper than 64 or larger than 16 MiB.
class YamlDocument {
 public:
  explicit YamlDocument(const std::filesystem::path& path);

  YamlValue root() const { return *root_; }

 private:
  std::optional<YamlValue> root_;
};

}  // namespace poselift
