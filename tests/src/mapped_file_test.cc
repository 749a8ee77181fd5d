// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real files, folders and pipes in the scratch folder. What is there is seen
// byte for byte; each thing that cannot be mapped is refused by its name.
#include "src/io/mapped_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "src/input_error.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::WriteScratch;

std::string Refusal(const std::filesystem::path& path) {
  try {
    const MappedFile file(path);
    return "not refused";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(MappedFile, ShowsEveryByteFromThePageOn) {
  std::string bytes;
  for (int i = 0; i < 10000; ++i) bytes += static_cast<char>(i % 251);
  const MappedFile file(WriteScratch("bytes", bytes));
  EXPECT_EQ(file.Bytes(), bytes);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(file.Bytes().data()) % 4096, 0U);
}

TEST(MappedFile, KeepsTheOldBytesWhenTheFileIsReplaced) {
  const std::string path = WriteScratch("file", "old");
  const MappedFile file(path);
  std::filesystem::rename(WriteScratch("other", "new!"), path);
  EXPECT_EQ(file.Bytes(), "old");
}

TEST(MappedFile, RefusesWhatIsNoFileWithContent) {
  const auto dir = ScratchDir();
  EXPECT_THAT(Refusal(dir), AllOf(HasSubstr(dir.string()), HasSubstr("directory")));
  EXPECT_THAT(Refusal(dir / "absent"), HasSubstr("No such file"));
  EXPECT_THAT(Refusal(WriteScratch("empty", "")), HasSubstr("empty"));
  EXPECT_THAT(Refusal("/dev/null"), HasSubstr("device"));
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(Refusal(dir / "pipe"), HasSubstr("pipe"));
}

TEST(MappedFile, RefusesAFileThatMayNotBeRead) {
  const std::string path = WriteScratch("secret", "bytes");
  ASSERT_EQ(chmod(path.c_str(), 0), 0);
  constexpr uid_t kNobody = 65534;
  const bool is_root = geteuid() == 0;  // root may read everything
  if (is_root) {
    ASSERT_EQ(seteuid(kNobody), 0);
  }
  const std::string refusal = Refusal(path);
  if (is_root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_THAT(refusal, HasSubstr("Permission denied"));
}

}  // namespace
}  // namespace poselift
