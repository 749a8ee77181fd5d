// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace poselift {

// One window at a time for a labels file: an flock on a file beside it that holds the number of
// the process. It goes with the process, however that ends; what a kill leaves of it is an unlocked
// file that the next window takes. A file system without flock gives a lock that keeps nobody out.
class ProjectLock {
 public:
  // Null when somebody else has it: *holder is then the number of that process, or empty when it
  // cannot be told. Throws InputError when the file cannot be made.
  static std::unique_ptr<ProjectLock> Take(const std::filesystem::path& path, std::string* holder);
  ~ProjectLock();  // removes the file
  ProjectLock(const ProjectLock&) = delete;
  ProjectLock& operator=(const ProjectLock&) = delete;

 private:
  ProjectLock(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}

  std::filesystem::path path_;
  int fd_;
};

}  // namespace poselift
