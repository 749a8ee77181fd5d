// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/broken_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/support/support.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kMuchMemory_mib = 1024.0;

std::set<std::string> FilesInScratch() {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(ScratchDir()))
    files.insert(entry.path().string());
  return files;
}

std::string With(std::string command, const std::string& file) {
  for (size_t at = command.find("{}"); at != std::string::npos; at = command.find("{}"))
    command.replace(at, 2, file);
  return command;
}

// Removes what the command wrote.
void ExpectSuccess(const std::string& arguments) {
  const std::set<std::string> before = FilesInScratch();
  const ProgramRun run = RunProgram(arguments);
  EXPECT_EQ(run.code, 0) << "poselift " << arguments << "\n" << run.err;
  for (const std::string& file : FilesInScratch())
    if (!before.contains(file)) fs::remove_all(file);
}

}  // namespace

const std::vector<BrokenFile>& BrokenInEveryFormat() {
  static const std::vector<BrokenFile> kBroken = {
      {"empty", "", ""},
      {"one line break", "\n", ""},
      {"binary", "\x01\x00\xFE\x02\x00\x7F"s, ""},
      {"UTF-16", "\xFF\xFE{\x00}\x00\n\x00"s, ""},
      {"no UTF-8", "\xC3\x28 \xFF\xFF", ""},
      {"the head of a PNG", "\x89PNG\r\n\x1A\n\x00\x00\x00\rIHDR"s, ""},
      {"a long line", std::string(1 << 20, 'x'), ""},
      {"deep nesting", std::string(100000, '['), ""},
  };
  return kBroken;
}

void ExpectRefusal(const std::string& arguments, const std::string& mention, RunAs user) {
  SCOPED_TRACE("poselift " + arguments);
  const std::set<std::string> before = FilesInScratch();
  const ProgramRun run = RunProgram(arguments, user);
  EXPECT_EQ(run.signal, 0) << run.err;
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, StartsWith("poselift: "));
  EXPECT_THAT(run.err, HasSubstr(mention));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(run.err.find('\n') + 1, run.err.size());
  EXPECT_LT(run.err.size(), 1000u);
  EXPECT_LT(run.peak_memory_mib, kMuchMemory_mib);
  EXPECT_EQ(FilesInScratch(), before);
}

void ExpectRefusals(const std::string& file, const std::string& whole,
                    const std::vector<std::string>& commands, std::vector<BrokenFile> broken) {
  broken.insert(broken.end(), BrokenInEveryFormat().begin(), BrokenInEveryFormat().end());
  const fs::path path = WriteScratch(file, whole);
  for (const std::string& command : commands) ExpectSuccess(With(command, file));
  for (const BrokenFile& each : broken) {
    SCOPED_TRACE(each.what);
    WriteScratch(file, each.content);
    for (const std::string& command : commands)
      ExpectRefusal(With(command, file), file + each.mention);
  }
  // A command that finds its files itself may not know which one is missing.
  const auto expect_without_file = [&] {
    for (const std::string& command : commands)
      ExpectRefusal(With(command, file), command.find("{}") == std::string::npos ? "" : file);
  };
  fs::remove(path);
  expect_without_file();
  fs::create_directory(path);
  expect_without_file();
  fs::remove(path);
}

std::string Replaced(std::string whole, const std::string& old, const std::string& with) {
  const size_t at = whole.find(old);
  EXPECT_NE(at, std::string::npos) << "found no " << old;
  return at == std::string::npos ? whole : whole.replace(at, old.size(), with);
}

}  // namespace poselift::testing
