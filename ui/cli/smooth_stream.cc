// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/smooth_stream.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

#include "lift/poses_to_motion.h"
#include "src/input_error.h"
#include "src/io/poses_json.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

// What has waited for long enough.
void WriteReady(PersonStream* stream, StreamReport* report, std::ostream* out) {
  while (const auto frame = stream->Take()) {
    const std::string& status = frame->people.front().status;
    ++report->num_frames;
    report->num_filled += status == kFilledStatus;
    report->num_unknown += status == kUnknownStatus;
    *out << FramePosesLine(*frame);
  }
  out->flush();
  if (!*out) throw InputError("the smoothed poses cannot be written: is the disk full?");
}

StreamReport SmoothLines(std::istream& in, const std::string& name,
                         const std::optional<double>& frame_time_s, PersonStream* stream,
                         std::ostream& out) {
  StreamReport report;
  long num_read = 0;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    FramePoses frame = ReadFramePosesLine(text, name, line);
    if (frame_time_s) frame.time_s = static_cast<double>(num_read++) * *frame_time_s;
    if (!frame.time_s)
      throw InputError(name, line,
                       "found a frame without time_s, wanted its time, or the rate (--fps)");
    try {
      stream->Add(std::move(frame));
    } catch (const InputError& error) {
      throw InputError(name, line, error.what());
    }
    WriteReady(stream, &report, &out);
  }
  if (in.bad()) throw InputError(name, "reading broke off");
  stream->End();
  WriteReady(stream, &report, &out);
  return report;
}

}  // namespace

StreamReport SmoothLines(const std::string& in, const std::string& out,
                         const std::optional<double>& frame_time_s, PersonStream* stream) {
  std::ifstream file;
  if (in != kStandardStream) {
    file.open(in);
    if (!file || fs::is_directory(in)) throw InputError(in, "cannot be opened");
  }
  std::istream& lines = in == kStandardStream ? std::cin : file;
  const std::string name = in == kStandardStream ? "standard input" : in;
  if (out == kStandardStream) return SmoothLines(lines, name, frame_time_s, stream, std::cout);

  const fs::path part = out + ".part";
  std::ofstream growing(part);
  if (!growing) throw InputError(out, "cannot be written");
  try {
    const StreamReport report = SmoothLines(lines, name, frame_time_s, stream, growing);
    growing.close();
    if (!growing) throw InputError(out, "cannot be written: is the disk full?");
    fs::rename(part, out);
    return report;
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

}  // namespace poselift::cli
