// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/json_value.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr size_t kDeepestNesting = 64;
constexpr size_t kLongestExplanation = 160;

// Counts the lines of what the parser has read. A line break belongs to the
// line it ends: the parser looks one character beyond a number.
class LineCountingIterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  LineCountingIterator(const char* at, int* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  LineCountingIterator& operator++() {
    if (after_break_) ++*line_;
    after_break_ = *at_ == '\n';
    ++at_;
    return *this;
  }
  LineCountingIterator operator++(int) {
    LineCountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const LineCountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const LineCountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  int* line_;
  bool after_break_ = false;
};

// nlohmann's text without its own marks and position:
// "[json.exception.parse_error.101] parse error at line 1, column 2: what is wrong"
std::string Explanation(const char* what) {
  std::string_view text = what;
  if (const size_t column = text.find(", column "); column != std::string_view::npos) {
    const size_t colon = text.find(": ", column);
    if (colon != std::string_view::npos) text.remove_prefix(colon + 2);
  } else if (const size_t bracket = text.find("] "); bracket != std::string_view::npos) {
    text.remove_prefix(bracket + 2);
  }
  std::string clean;
  for (const char c : text.substr(0, kLongestExplanation)) clean += c >= ' ' && c <= '~' ? c : '?';
  return clean + (text.size() > kLongestExplanation ? "..." : "");
}

}  // namespace

// Receives the parser's events and grows the tree.
class JsonBuilder {
 public:
  JsonBuilder(const std::string& file, JsonValue* root, const int* line)
      : file_(file), root_(root), line_(line) {}

  bool null() { return Add(JsonValue::Kind::kNull), true; }
  bool boolean(bool value) { return Add(JsonValue::Kind::kBoolean)->number_ = value, true; }
  bool number_integer(std::int64_t value) { return Number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return Number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) { return Number(value); }
  bool string(std::string& value) {
    Boxed(Add(JsonValue::Kind::kString)).text = std::move(value);
    return true;
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(size_t) { return Open(JsonValue::Kind::kObject); }
  bool start_array(size_t) { return Open(JsonValue::Kind::kArray); }
  bool key(std::string& name) {
    open_.back()->box_->keys.push_back(std::move(name));
    return true;
  }
  bool end_array() {
    open_.pop_back();
    return true;
  }
  bool end_object() {
    RefuseTwins(*open_.back());
    open_.pop_back();
    return true;
  }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception& error) {
    throw InputError(file_, *line_, "no valid JSON: " + Explanation(error.what()));
  }

 private:
  static JsonValue::Box& Boxed(JsonValue* value) {
    value->box_ = std::make_unique<JsonValue::Box>();
    return *value->box_;
  }
  JsonValue* Add(JsonValue::Kind kind) {
    JsonValue* value = open_.empty() ? root_ : &open_.back()->box_->items.emplace_back();
    value->kind_ = kind;
    value->line_ = *line_;
    return value;
  }
  bool Number(double value) {
    Add(JsonValue::Kind::kNumber)->number_ = value;
    return true;
  }
  bool Open(JsonValue::Kind kind) {
    if (open_.size() >= kDeepestNesting)
      throw InputError(file_, *line_,
                       fmt::format("found more than {} levels of nesting, wanted a plainer file",
                                   kDeepestNesting));
    JsonValue* value = Add(kind);
    Boxed(value);
    open_.push_back(value);
    return true;
  }
  void RefuseTwins(const JsonValue& object) const {
    const std::vector<std::string>& keys = object.box_->keys;
    std::vector<size_t> order(keys.size());
    for (size_t i = 0; i < keys.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
    for (size_t i = 1; i < order.size(); ++i)
      if (keys[order[i]] == keys[order[i - 1]])
        throw InputError(
            file_, object.box_->items[order[i]].line_,
            fmt::format("found the key {} twice (first in line {}), wanted it once",
                        Quoted(keys[order[i]]), object.box_->items[order[i - 1]].line_));
  }

  const std::string& file_;
  JsonValue* root_;
  const int* line_;
  std::vector<JsonValue*> open_;
};

JsonDocument::JsonDocument(const std::filesystem::path& path)
    : JsonDocument(ReadTextFile(path), path.string()) {}

JsonDocument::JsonDocument(std::string_view text, const std::string& file, int first_line)
    : root_(std::make_unique<JsonValue>()) {
  int line = first_line;
  JsonBuilder builder(file, root_.get(), &line);
  nlohmann::json::sax_parse(LineCountingIterator(text.data(), &line),
                            LineCountingIterator(text.data() + text.size(), &line), &builder);
  if (!root_->box_) root_->box_ = std::make_unique<JsonValue::Box>();
  root_->box_->file = file;
  root_->Link();
}

void JsonValue::Link() {
  if (!box_) return;
  for (JsonValue& item : box_->items) {
    item.parent_ = this;
    item.Link();
  }
}

void JsonValue::Expect(Kind kind, const char* wanted) const {
  if (kind_ != kind) throw Unwanted(wanted);
}

double JsonValue::Number(double lower, double upper) const {
  Expect(Kind::kNumber, "a number");
  if (!(number_ >= lower && number_ <= upper))
    throw Unwanted(fmt::format("a number from {:g} to {:g}", lower, upper));
  return number_;
}

int JsonValue::Integer(int lower, int upper) const {
  Expect(Kind::kNumber, "a whole number");
  if (!(number_ >= lower && number_ <= upper) || number_ != std::floor(number_))
    throw Unwanted(fmt::format("a whole number from {} to {}", lower, upper));
  return static_cast<int>(number_);
}

bool JsonValue::Boolean() const {
  Expect(Kind::kBoolean, "true or false");
  return number_ != 0.0;
}

const std::string& JsonValue::String() const {
  Expect(Kind::kString, "a string");
  return box_->text;
}

const std::vector<JsonValue>& JsonValue::Items() const {
  Expect(Kind::kArray, "a list");
  return box_->items;
}

const std::vector<JsonValue>& JsonValue::Members() const {
  Expect(Kind::kObject, "an object");
  return box_->items;
}

const std::vector<std::string>& JsonValue::Keys() const {
  Expect(Kind::kObject, "an object");
  return box_->keys;
}

const JsonValue* JsonValue::Find(std::string_view key) const {
  const std::vector<JsonValue>& members = Members();
  for (size_t i = 0; i < members.size(); ++i)
    if (box_->keys[i] == key) return members[i].Is(Kind::kNull) ? nullptr : &members[i];
  return nullptr;
}

const JsonValue& JsonValue::At(std::string_view key) const {
  if (const JsonValue* value = Find(key)) return *value;
  throw Error(fmt::format("found no \"{}\", wanted one", key));
}

std::string JsonValue::Path() const {
  if (!parent_) return {};
  const size_t index = static_cast<size_t>(this - parent_->box_->items.data());
  std::string before = parent_->Path();
  if (parent_->Is(Kind::kArray)) return before + fmt::format("[{}]", index);
  const std::string quoted = Quoted(parent_->box_->keys[index]);
  const std::string key = quoted.substr(1, quoted.rfind('"') - 1);
  return before.empty() ? key : before + "." + key;
}

const std::string& JsonValue::File() const {
  const JsonValue* root = this;
  while (root->parent_) root = root->parent_;
  return root->box_->file;
}

InputError JsonValue::Error(const std::string& message) const {
  const std::string path = Path();
  return InputError(File(), line_, path.empty() ? message : path + ": " + message);
}

InputError JsonValue::Unwanted(const std::string& wanted) const {
  std::string found;
  switch (kind_) {
    case Kind::kNull:
      found = "null";
      break;
    case Kind::kBoolean:
      found = number_ != 0.0 ? "true" : "false";
      break;
    case Kind::kNumber:
      found = fmt::format("{:g}", number_);
      break;
    case Kind::kString:
      found = Quoted(box_->text);
      break;
    case Kind::kArray:
      found = fmt::format("a list of {}", box_->items.size());
      break;
    case Kind::kObject:
      found = "an object";
      break;
  }
  return Error("found " + found + ", wanted " + wanted);
}

}  // namespace poselift
