// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: a process that labels, saves and shortens its journal, killed by SIGKILL at 300 random
// moments; the files that this leaves. Made up: the labels and the steps. Property: after opening
// again everything that was acknowledged is there, and at most the one step that was not yet.
#include <fcntl.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <random>

#include "tests/support/random_labels.h"
#include "tests/support/support.h"
#include "ui/label/label_project.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ExactText;

constexpr int kStepsOfSession = 24;

// Spawns the script, kills it some microseconds after it has acknowledged `count` steps. Returns
// how many it had acknowledged by its end.
int AcknowledgedBeforeKill(const std::vector<std::string>& arguments, int count, long wait_us) {
  int ends[2];
  EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = -1;
  EXPECT_EQ(::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  int acknowledged = 0;
  const auto next = [&] {
    std::uint32_t number = 0;
    if (::read(ends[0], &number, sizeof number) != sizeof number) return false;
    EXPECT_EQ(number, static_cast<std::uint32_t>(acknowledged));
    ++acknowledged;
    return true;
  };
  while (acknowledged < count && next()) {
  }
  const timespec wait{0, wait_us * 1000};
  ::nanosleep(&wait, nullptr);
  ::kill(child, SIGKILL);
  while (next()) {
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "it ended by itself";
  ::close(ends[0]);
  return acknowledged;
}

void Save(LabelHistory* history) { history->Seal(); }
void Save(LabelProject* project) { project->Save(); }

template <typename HistoryOrProject>
void TakeStep(std::uint32_t seed, HistoryOrProject* target) {
  if (seed == 0)
    Save(target);
  else
    testing::TakeRandomStep(seed, target);
}

// The project as it stands, under another name.
fs::path Twin(const fs::path& file) {
  const fs::path dir = file.parent_path() / "twin";
  fs::remove_all(dir);
  fs::create_directories(dir);
  fs::copy_file(file, dir / file.filename());
  const std::string journal = fmt::format(".{}.journal", file.filename().string());
  if (fs::exists(file.parent_path() / journal))
    fs::copy_file(file.parent_path() / journal, dir / journal);
  return dir / file.filename();
}

// What one project goes through: sessions, each killed at some moment.
struct Sessions {
  fs::path file;
  std::uint64_t longest_journal;
  std::mt19937_64 rng;
  // False when an acknowledged step is not there.
  bool Survives() {
    LabelProject::Options options;
    options.longest_journal = longest_journal;
    LabelHistory before = LabelProject(file, options).history();
    const fs::path twin_file = Twin(file);
    std::vector<std::string> arguments = {POSELIFT_SCRIPTED_LABELLING, file.string(),
                                          std::to_string(longest_journal)};
    std::vector<std::uint32_t> seeds = {0};  // a save: no nudge meets one of the last session
    while (seeds.size() < kStepsOfSession)
      seeds.push_back(rng() % 12 == 0 ? 0 : 1 + static_cast<std::uint32_t>(rng() % 1000000));
    for (const std::uint32_t seed : seeds) arguments.push_back(std::to_string(seed));
    const int count = static_cast<int>(rng() % kStepsOfSession);
    const int acknowledged =
        AcknowledgedBeforeKill(arguments, count, static_cast<long>(rng() % 400));
    const LabelProject opened(file, options);
    EXPECT_FALSE(opened.read_only());
    EXPECT_EQ(opened.unsaved_reason(), "");
    seeds.resize(std::min(seeds.size(), static_cast<size_t>(acknowledged) + 1));
    if (!IsShortened()) return IsThere(seeds, acknowledged, &before, before, opened);
    LabelProject twin(twin_file, options);
    return IsThere(seeds, acknowledged, &twin, twin.history(), opened);
  }

  bool IsShortened() const { return longest_journal < 1'000'000; }

  // After the acknowledged steps, or with the one that was on its way.
  template <typename HistoryOrProject>
  bool IsThere(const std::vector<std::uint32_t>& seeds, int acknowledged,
               HistoryOrProject* expected, const LabelHistory& history,
               const LabelProject& opened) const {
    for (size_t i = 0; i < seeds.size(); ++i) {
      if (static_cast<int>(i) == acknowledged && IsEqual(history, opened.history())) return true;
      TakeStep(seeds[i], expected);
    }
    return IsEqual(history, opened.history());
  }

  // The steps of a shortened journal do not merge any more: there the labels are compared.
  bool IsEqual(const LabelHistory& a, const LabelHistory& b) const {
    if (IsShortened()) return ExactText(a.labels()) == ExactText(b.labels());
    return ExactText(a) == ExactText(b);
  }
};

TEST(LabelProjectKilled, At300MomentsHasEveryAcknowledgedStep) {
  std::mt19937_64 rng = testing::TestRng();
  int num_good = 0;
  for (int i = 0; i < 30; ++i) {
    const fs::path file = testing::ScratchDir() / fmt::format("{}.json", i);
    CreateLabelsFile(file, testing::SomeLabels());
    Sessions sessions{file, i % 3 == 0 ? 6'000u : 1'000'000'000u, std::mt19937_64(rng())};
    for (int k = 0; k < 10; ++k) num_good += sessions.Survives();
  }
  EXPECT_EQ(num_good, 300);
}

}  // namespace
}  // namespace poselift
