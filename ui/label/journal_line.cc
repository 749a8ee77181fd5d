// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/journal_line.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "src/input_error.h"
#include "src/io/json_text.h"
#include "src/io/json_value.h"
#include "src/io/labels_formats.h"

namespace poselift {
namespace {

constexpr std::string_view kFormat = "poselift-journal";
constexpr double kLargestSize = 9007199254740992.0;  // 2^53: doubles count to it
constexpr int kMostFrames = 1 << 30;
constexpr std::pair<std::string_view, JournalLine::Kind> kSteps[] = {
    {"edit", JournalLine::Kind::kEdit},   {"undo", JournalLine::Kind::kUndo},
    {"redo", JournalLine::Kind::kRedo},   {"saving", JournalLine::Kind::kSaving},
    {"saved", JournalLine::Kind::kSaved},
};

std::string StampText(const FileStamp& file) {
  return fmt::format(R"("file": {{"size": {}, "hash": "{:016x}"}})", file.size, file.hash);
}

FileStamp ReadStamp(const JsonValue& json) {
  FileStamp file;
  file.size = static_cast<std::uint64_t>(json.At("size").Number(0.0, kLargestSize));
  const std::string& hash = json.At("hash").String();
  const char* const end = hash.data() + hash.size();
  if (hash.size() != 16 || std::from_chars(hash.data(), end, file.hash, 16).ptr != end)
    throw json.At("hash").Unwanted("16 hexadecimal digits");
  return file;
}

// , "key": {"3": VALUE, ...}; nothing for an empty map.
template <typename Map, typename AppendValue>
void AppendMap(std::string_view key, const Map& map, AppendValue append, std::string* out) {
  if (map.empty()) return;
  *out += fmt::format(", \"{}\": {{", key);
  for (const char* separator = ""; const auto& [frame, value] : map) {
    *out += fmt::format("{}\"{}\": ", std::exchange(separator, ", "), frame);
    append(value, out);
  }
  *out += "}";
}

// {"time_s": 0.5, "frame": 15}, without what is not known.
void AppendTime(const FrameTime& time, std::string* out) {
  const std::string time_s = time.time_s ? fmt::format("\"time_s\": {}", *time.time_s) : "";
  const std::string frame = time.frame ? fmt::format("\"frame\": {}", *time.frame) : "";
  *out += "{" + time_s + (time.time_s && time.frame ? ", " : "") + frame + "}";
}

FrameTime ReadTime(const JsonValue& json) {
  FrameTime time;
  if (const JsonValue* time_s = json.Find("time_s"))
    time.time_s = time_s->Number(-kLargestTime_s, kLargestTime_s);
  if (const JsonValue* frame = json.Find("frame")) time.frame = frame->Integer(0, kMostFrames);
  return time;
}

void AppendMaps(const LabelEdit& edit, std::string* out) {
  AppendMap("people", edit.people, AppendNativePeople, out);
  AppendMap(
      "images", edit.images,
      [](const std::string& image, std::string* to) { AppendJsonString(image, to); }, out);
  AppendMap("times", edit.times, AppendTime, out);
}

template <typename Value, typename ReadValue>
void ReadMap(const JsonValue* json, ReadValue read, std::map<size_t, Value>* map) {
  if (!json) return;
  for (size_t i = 0; i < json->Members().size(); ++i) {
    const std::string& key = json->Keys()[i];
    size_t frame = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), frame);
    if (error != std::errc() || end != key.data() + key.size())
      throw json->Members()[i].Error("wanted the number of a frame as its name");
    map->emplace(frame, read(json->Members()[i]));
  }
}

void AppendAdded(const LabelEdit& edit, std::string* out) {
  if (edit.added.empty()) return;
  *out += ", \"added\": [";
  for (size_t i = 0; i < edit.added.size(); ++i) {
    if (i > 0) *out += ", ";
    AppendNativeFrame(edit.added[i], out);
  }
  *out += "]";
}

void ReadMaps(const JsonValue& json, const Layout& layout, LabelEdit* edit) {
  ReadMap(
      json.Find("people"),
      [&](const JsonValue& people) { return ReadNativePeople(people, layout); }, &edit->people);
  ReadMap(
      json.Find("images"), [](const JsonValue& image) { return image.String(); }, &edit->images);
  ReadMap(json.Find("times"), ReadTime, &edit->times);
  if (const JsonValue* added = json.Find("added"))
    for (const JsonValue& frame : added->Items())
      edit->added.push_back(ReadNativeFrame(frame, layout));
}

void ReadEdit(const JsonValue& root, const Layout& layout, JournalLine* line) {
  line->edit.name = root.At("name").String();
  if (const JsonValue* merge = root.Find("merge")) line->edit.merge_key = merge->String();
  ReadMaps(root, layout, &line->edit);
  if (const JsonValue* dropped = root.Find("dropped"))
    line->edit.dropped = static_cast<size_t>(dropped->Integer(0, kMostFrames));
  ReadMaps(root.At("before"), layout, &line->before);
}

// The pieces of poselift-labels break lines, which a line of a journal must not.
std::string InOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text + "\n";
}

}  // namespace

FileStamp StampOf(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return {bytes.size(), hash};
}

std::string JournalHeader(const FileStamp& file) {
  return fmt::format("{{\"format\": \"{}\", \"version\": 1, {}}}\n", kFormat, StampText(file));
}

std::string EditLine(const LabelEdit& edit, const LabelEdit& before) {
  std::string text = R"({"step": "edit", "name": )";
  AppendJsonString(edit.name, &text);
  AppendMaps(edit, &text);
  if (edit.dropped > 0) text += fmt::format(", \"dropped\": {}", edit.dropped);
  AppendAdded(edit, &text);
  if (!edit.merge_key.empty()) {
    text += ", \"merge\": ";
    AppendJsonString(edit.merge_key, &text);
  }
  text += ", \"before\": {\"of\": ";  // a member for the commas to follow
  AppendJsonString(edit.name, &text);
  AppendMaps(before, &text);
  AppendAdded(before, &text);
  return InOneLine(text + "}}");
}

std::string UndoLine() { return "{\"step\": \"undo\"}\n"; }
std::string RedoLine() { return "{\"step\": \"redo\"}\n"; }

std::string SavingLine(const FileStamp& file) {
  return fmt::format("{{\"step\": \"saving\", {}}}\n", StampText(file));
}

std::string SavedLine(const FileStamp& file) {
  return fmt::format("{{\"step\": \"saved\", {}}}\n", StampText(file));
}

FileStamp ReadJournalHeader(std::string_view text, const std::string& file) {
  const JsonDocument document(text, file);
  const JsonValue& root = document.root();
  if (root.At("format").String() != kFormat)
    throw root.At("format").Unwanted(fmt::format("\"{}\"", kFormat));
  if (root.At("version").Number() != 1.0)
    throw root.At("version").Unwanted("1, the version that this poselift reads");
  return ReadStamp(root.At("file"));
}

JournalLine ReadJournalLine(std::string_view text, const std::string& file, int line,
                            const Layout& layout) {
  const JsonDocument document(text, file, line);
  const JsonValue& root = document.root();
  const JsonValue& step = root.At("step");
  const auto* found = std::find_if(std::begin(kSteps), std::end(kSteps),
                                   [&](const auto& known) { return known.first == step.String(); });
  if (found == std::end(kSteps)) throw step.Unwanted("edit, undo, redo, saving or saved");
  JournalLine read;
  read.kind = found->second;
  read.line = line;
  if (read.kind == JournalLine::Kind::kEdit) ReadEdit(root, layout, &read);
  if (read.kind == JournalLine::Kind::kSaving || read.kind == JournalLine::Kind::kSaved)
    read.file = ReadStamp(root.At("file"));
  return read;
}

}  // namespace poselift
