// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/support/support.h"

namespace poselift::testing {
namespace {

constexpr std::chrono::seconds kPatience(300);

// A file without a name.
class Capture {
 public:
  Capture() : fd_(::memfd_create("capture", MFD_CLOEXEC)) {}
  ~Capture() { ::close(fd_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int fd() const { return fd_; }
  std::string Text() const {
    std::string text(static_cast<size_t>(::lseek(fd_, 0, SEEK_END)), '\0');
    const ssize_t num_read = ::pread(fd_, text.data(), text.size(), 0);
    text.resize(num_read > 0 ? static_cast<size_t>(num_read) : 0);
    return text;
  }

 private:
  int fd_;
};

std::vector<std::string> Words(const std::string& arguments, RunAs user) {
  std::vector<std::string> words;
  if (user == RunAs::kNobody)
    words = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  words.emplace_back(POSELIFT_PROGRAM);
  std::istringstream stream(arguments);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

pid_t Start(std::vector<std::string> words, const Capture& out, const Capture& err) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, ScratchDir().c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.fd(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.fd(), STDERR_FILENO);
  pid_t child = -1;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " + words[0]);
  return child;
}

// The exit status; ends the program when it takes too long.
int Wait(pid_t child, rusage* usage) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  int status = 0;
  while (::wait4(child, &status, WNOHANG, usage) == 0) {
    if (std::chrono::steady_clock::now() > deadline) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return status;
}

}  // namespace

ProgramRun RunProgram(const std::string& arguments, RunAs user) {
  const Capture out, err;
  rusage usage{};
  const int status = Wait(Start(Words(arguments, user), out, err), &usage);
  ProgramRun run;
  if (WIFEXITED(status)) run.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  run.out = out.Text();
  run.err = err.Text();
  run.peak_memory_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return run;
}

bool CanRunAsNobody() {
  return ::geteuid() == 0 && RunProgram("--version", RunAs::kNobody).code == 0;
}

}  // namespace poselift::testing
