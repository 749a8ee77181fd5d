// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <new>

namespace poselift::testing {

// A child that does some work, to be killed at it, and what it shares with us.
class Child {
 public:
  struct Shared {
    std::atomic<int> added{0};
    char complaint[400] = {};
  };

  explicit Child(const std::function<void(Shared*)>& work) {
    void* memory =
        ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    shared_ = new (memory) Shared;
    id_ = ::fork();
    if (id_ != 0) return;
    work(shared_);
    ::_exit(0);
  }
  ~Child() { ::munmap(shared_, sizeof(Shared)); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  const Shared& shared() const { return *shared_; }
  void Kill() const { ::kill(id_, SIGKILL); }
  int Wait() const {
    int status = 0;
    ::waitpid(id_, &status, 0);
    return status;
  }

 private:
  Shared* shared_ = nullptr;
  pid_t id_ = -1;
};

}  // namespace poselift::testing
