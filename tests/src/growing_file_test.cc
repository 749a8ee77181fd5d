// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Files that are read while they grow and after a kill at random moments, on the real file
// system; a file that may not grow further; a system that cannot exchange names, which a
// seccomp filter plays.
#include "src/io/growing_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>

#include "src/input_error.h"
#include "tests/support/child.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::Child;
using testing::FileText;
using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

constexpr size_t kCountPlace = 2;

std::string Count(int count) {
  std::string text = std::to_string(count);
  text.resize(6, ' ');
  return text;
}

// Longer than a page, so that each crosses one, and different from one to the next.
std::string Text(int i) {
  std::string text(5000, static_cast<char>('a' + i % 26));
  return text + '\n';
}

void AppendAndCount(GrowingFile* file, int i) {
  file->Overwrite(kCountPlace, Count(i + 1));
  file->Append(Text(i));
}

// How many texts stand in it; -1 when it is not what it should be, to the byte.
int NumTexts(const fs::path& path) {
  const std::string text = FileText(path);
  const int count = std::atoi(text.c_str() + kCountPlace);
  std::string wanted = "# " + Count(count) + "\n";
  for (int i = 0; i < count; ++i) wanted += Text(i);
  return text == wanted + "end\n" ? count : -1;
}

GrowingFile Counted(const fs::path& path) { return {path, "# " + Count(0) + "\n", "end\n"}; }

std::string Complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no complaint)";
}

// From here on this process has no renameat2.
void ForbidExchange() {
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{4, filter};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    ::_exit(77);
}

TEST(GrowingFile, IsWholeFromTheStartAndAfterEachText) {
  const fs::path path = ScratchDir() / "a.txt";
  GrowingFile file(path, "[", "]");
  EXPECT_EQ(FileText(path), "[]");
  file.Append("one");
  EXPECT_EQ(FileText(path), "[one]");
  file.Append("");
  file.Append(", two");
  file.Append(", three");
  EXPECT_EQ(FileText(path), "[one, two, three]");
  file.Close();
  file.Close();
  EXPECT_EQ(FileText(path), "[one, two, three]");
  EXPECT_THROW(file.Append("x"), std::logic_error);
  EXPECT_EQ(std::distance(fs::directory_iterator(ScratchDir()), {}), 1);
}

TEST(GrowingFile, ChangesItsHeadTogetherWithTheNextText) {
  const fs::path path = ScratchDir() / "a.txt";
  GrowingFile file(path, "0123456789|", "$");
  file.Overwrite(2, "AB");
  EXPECT_EQ(FileText(path), "0123456789|$");
  file.Append("x");
  EXPECT_EQ(FileText(path), "01AB456789|x$");
  file.Append("y");
  file.Overwrite(7, "C");
  file.Append("z");
  EXPECT_EQ(FileText(path), "01AB456C89|xyz$");
  file.Append("!");
  EXPECT_EQ(FileText(path), "01AB456C89|xyz!$");
  EXPECT_THROW(file.Overwrite(10, "||"), std::invalid_argument);
  EXPECT_THROW(file.Overwrite(12, ""), std::invalid_argument);
}

TEST(GrowingFile, TakesThePlaceOfAnOlderOneAndOfWhatAKillLeft) {
  const fs::path path = WriteScratch("a.txt", "old and longer");
  WriteScratch(".a.txt.spare", "left");
  GrowingFile file(path, "[", "]");
  file.Append("new");
  file.Close();
  EXPECT_EQ(FileText(path), "[new]");
  EXPECT_FALSE(fs::exists(ScratchDir() / ".a.txt.spare"));
}

TEST(GrowingFile, SaysWhyItCannotBeWritten) {
  const auto complaint = [](const fs::path& path) {
    return Complaint([&] { GrowingFile(path, "a", "b"); });
  };
  const fs::path dir = ScratchDir();
  EXPECT_EQ(complaint(dir),
            dir.string() + ": found no plain file, wanted the name of a file to write");
  EXPECT_THAT(complaint("/dev/full"), HasSubstr("found no plain file"));
  EXPECT_EQ(complaint(dir / "no/a.txt"),
            (dir / "no/a.txt").string() + ": cannot create it: No such file or directory");
  EXPECT_TRUE(fs::is_empty(dir));
}

TEST(GrowingFile, KilledAnywhereIsWholeWithAllThatWasAppended) {
  const fs::path path = ScratchDir() / "a.txt";
  auto rng = TestRng();
  for (int trial = 0; trial < 50; ++trial) {
    const Child child([&](Child::Shared* shared) {
      GrowingFile file = Counted(path);
      for (int i = 0;; ++i) {
        AppendAndCount(&file, i);
        ++shared->added;
      }
    });
    while (child.shared().added < 2) ::usleep(100);
    ::usleep(static_cast<useconds_t>(rng() % 20000));
    child.Kill();
    ASSERT_TRUE(WIFSIGNALED(child.Wait()));
    const int added = child.shared().added;
    const int found = NumTexts(path);
    ASSERT_GE(found, added);
    ASSERT_LE(found, added + 1);
  }
}

TEST(GrowingFile, StaysAsItIsForAReaderThatAnAdditionOvertakes) {
  const fs::path path = ScratchDir() / "a.txt";
  GrowingFile file = Counted(path);
  for (int i = 0; i < 5; ++i) {
    std::ifstream reader(path);
    const int first = reader.get();
    AppendAndCount(&file, i);
    std::string seen(1, static_cast<char>(first));
    seen.append(std::istreambuf_iterator<char>(reader), {});
    std::string wanted = "# " + Count(i) + "\n";
    for (int k = 0; k < i; ++k) wanted += Text(k);
    EXPECT_EQ(seen, wanted + "end\n");
    EXPECT_EQ(NumTexts(path), i + 1);
  }
}

// Both with two copies and with one.
class FullDisk : public ::testing::TestWithParam<bool> {};

TEST_P(FullDisk, LeavesWhatStoodThereAndAppendsAgainWhenThereIsPlace) {
  const fs::path path = ScratchDir() / "a.txt";
  for (const rlim_t limit : {20000u, 20016u, 20017u, 22222u, 25018u}) {
    const Child child([&](Child::Shared* shared) {
      if (GetParam()) ForbidExchange();
      ::signal(SIGXFSZ, SIG_IGN);
      rlimit bytes{limit, RLIM_INFINITY};
      ::setrlimit(RLIMIT_FSIZE, &bytes);
      GrowingFile file = Counted(path);
      const std::string complaint = Complaint([&] {
        for (;; ++shared->added) AppendAndCount(&file, shared->added);
      });
      complaint.copy(shared->complaint, sizeof shared->complaint - 1);
      if (NumTexts(path) != shared->added) ::_exit(1);
      if (Complaint([&] { AppendAndCount(&file, shared->added); }) != complaint) ::_exit(2);
      if (NumTexts(path) != shared->added) ::_exit(3);
      bytes.rlim_cur = RLIM_INFINITY;
      ::setrlimit(RLIMIT_FSIZE, &bytes);
      for (int i = 0; i < 3; ++i, ++shared->added) AppendAndCount(&file, shared->added);
      if (NumTexts(path) != shared->added) ::_exit(4);
      file.Close();
    });
    const int status = child.Wait();
    if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no seccomp filters here";
    EXPECT_EQ(status, 0);
    const int fitting = static_cast<int>((limit - 13) / 5001);  // head and tail are 13
    EXPECT_EQ(child.shared().added, fitting + 3) << limit;
    EXPECT_EQ(NumTexts(path), fitting + 3);
    EXPECT_EQ(child.shared().complaint,
              path.string() + ": cannot write it any further: File too large");
    EXPECT_EQ(std::distance(fs::directory_iterator(ScratchDir()), {}), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(GrowingFile, FullDisk, ::testing::Bool());

}  // namespace
}  // namespace poselift
