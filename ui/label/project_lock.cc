// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/project_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "src/input_error.h"
#include "ui/label/label_journal.h"

namespace poselift {
namespace {

std::string ReadHolder(int fd) {
  char text[24];
  const ssize_t size = ::pread(fd, text, sizeof text, 0);
  std::string holder(text, static_cast<size_t>(std::max<ssize_t>(size, 0)));
  const bool is_number = !holder.empty() && std::all_of(holder.begin(), holder.end(), [](char c) {
    return c >= '0' && c <= '9';
  });
  return is_number ? holder : "";
}

// The last holder removes the file: whoever has locked it by then holds a file without a name.
bool HasItsName(int fd, const std::filesystem::path& path) {
  struct stat locked {
  }, named{};
  return ::fstat(fd, &locked) == 0 && ::stat(path.c_str(), &named) == 0 &&
         locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

void WriteHolder(int fd) {
  const std::string pid = std::to_string(::getpid());
  // On a full disk the lock still holds; only its holder cannot be told.
  if (::ftruncate(fd, 0) != 0 || ::pwrite(fd, pid.data(), pid.size(), 0) < 0) return;
}

}  // namespace

std::unique_ptr<ProjectLock> ProjectLock::Take(const std::filesystem::path& path,
                                               std::string* holder) {
  for (;;) {
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (fd < 0) throw InputError(path.string(), WriteFailure("create it", errno));
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      *holder = ReadHolder(fd);
      ::close(fd);
      return nullptr;
    }
    if (HasItsName(fd, path)) {
      WriteHolder(fd);
      return std::unique_ptr<ProjectLock>(new ProjectLock(path, fd));
    }
    ::close(fd);
  }
}

ProjectLock::~ProjectLock() {
  ::unlink(path_.c_str());
  ::close(fd_);
}

}  // namespace poselift
