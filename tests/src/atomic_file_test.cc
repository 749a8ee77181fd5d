// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Files written all or not at all, on the real file system.
#include "src/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "src/input_error.h"
#include "src/io/text_scanner.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ScratchDir;
using testing::WriteScratch;

long NumFiles(const std::filesystem::path& dir) {
  return std::distance(std::filesystem::directory_iterator(dir), {});
}

TEST(WriteFileAtomically, ReplacesTheBytesAndKeepsTheMode) {
  const std::string path = WriteScratch("a.txt", "old and longer");
  ::chmod(path.c_str(), 0640);
  WriteFileAtomically(path, "new");
  EXPECT_EQ(ReadTextFile(path), "new");
  struct stat status {};
  ::stat(path.c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
  EXPECT_EQ(NumFiles(ScratchDir()), 1);
}

TEST(WriteFileAtomically, FollowsASymbolicLink) {
  const std::string path = WriteScratch("target.txt", "old");
  std::filesystem::create_symlink("target.txt", ScratchDir() / "link.txt");
  WriteFileAtomically(ScratchDir() / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(ScratchDir() / "link.txt"));
  EXPECT_EQ(ReadTextFile(path), "new");
}

TEST(WriteFileAtomically, LeavesADeviceADevice) {
  WriteFileAtomically("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteFileAtomically, RefusesADirectoryAndAFolderThatIsNotThere) {
  EXPECT_THROW(WriteFileAtomically(ScratchDir(), "x"), InputError);
  EXPECT_THROW(WriteFileAtomically(ScratchDir() / "no" / "a.txt", "x"), InputError);
  EXPECT_EQ(NumFiles(ScratchDir()), 0);
}

}  // namespace
}  // namespace poselift
