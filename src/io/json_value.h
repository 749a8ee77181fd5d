// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/input_error.h"

namespace poselift {

// A value of a JSON file that knows its line and its path, so that a reader's
// complaint says where:
//   run.json:12: frames[0].people[0].joints.left_knee.x: found "a", wanted a number
//
// The getters throw InputError when the value is of another kind. All values
// live in their JsonDocument.
class JsonValue {
 public:
  enum class Kind : std::uint8_t { kNull, kBoolean, kNumber, kString, kArray, kObject };

  bool Is(Kind kind) const { return kind_ == kind; }
  int line() const { return line_; }  // where the value begins, from 1

  // Finite (a JSON file has no other), and from lower to upper.
  double Number(double lower = -std::numeric_limits<double>::max(),
                double upper = std::numeric_limits<double>::max()) const;
  int Integer(int lower, int upper) const;
  const std::string& String() const;
  bool Boolean() const;

  const std::vector<JsonValue>& Items() const;    // of an array
  const std::vector<JsonValue>& Members() const;  // of an object, in the file's order
  const std::vector<std::string>& Keys() const;   // of an object, side by side with Members()

  // A member of an object. Find: null when it is not there or is JSON's null.
  const JsonValue* Find(std::string_view key) const;
  const JsonValue& At(std::string_view key) const;

  std::string Path() const;  // frames[0].people[0]; empty for the whole file
  const std::string& File() const;

  InputError Error(const std::string& message) const;
  // 'found <this>, wanted <wanted>'
  InputError Unwanted(const std::string& wanted) const;

 private:
  friend class JsonBuilder;
  friend class JsonDocument;

  // What a number has no need of: a file holds many numbers.
  struct Box {
    std::string text;
    std::vector<JsonValue> items;
    std::vector<std::string> keys;
    std::string file;  // of the outermost value
  };

  void Link();
  void Expect(Kind kind, const char* wanted) const;

  Kind kind_ = Kind::kNull;
  int line_ = 1;
  double number_ = 0.0;
  const JsonValue* parent_ = nullptr;
  std::unique_ptr<Box> box_;
};

// A whole JSON file in memory. Throws InputError with file:line for what is no
// JSON (RFC 8259, UTF-8, with or without a byte order mark), for a key that
// stands twice in an object, for numbers too large for a double and for more
// than 64 levels of nesting.
class JsonDocument {
 public:
  explicit JsonDocument(const std::filesystem::path& path);
  // file: the name for messages; first_line: where the text begins in it.
  JsonDocument(std::string_view text, const std::string& file, int first_line = 1);

  const JsonValue& root() const { return *root_; }

 private:
  std::unique_ptr<JsonValue> root_;
};

}  // namespace poselift
