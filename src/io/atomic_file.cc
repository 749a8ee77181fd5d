// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "src/input_error.h"

namespace poselift {
namespace {

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& doing, int error) {
  throw InputError(path.string(), "cannot " + doing + ": " + std::strerror(error));
}

// Writes and closes; 0 or the errno of what failed.
int WriteAndClose(int fd, std::string_view bytes, bool sync) {
  int error = 0;
  while (!bytes.empty() && error == 0) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written > 0)
      bytes.remove_prefix(static_cast<size_t>(written));
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && sync && ::fsync(fd) != 0) error = errno;
  if (::close(fd) != 0 && error == 0) error = errno;
  return error;
}

void WriteInPlace(const std::filesystem::path& path, std::string_view bytes) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) Fail(path, "open it for writing", errno);
  if (const int error = WriteAndClose(fd, bytes, false)) Fail(path, "write it", error);
}

}  // namespace

void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw InputError(path.string(), "found a directory, wanted the name of a file to write");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return WriteInPlace(path, bytes);

  const auto target = std::filesystem::weakly_canonical(path, ignored);
  const auto& destination = target.empty() ? path : target;
  static std::atomic<unsigned> counter{0};
  std::string temporary_name(".");
  temporary_name.append(destination.filename().string()).append(".");
  temporary_name.append(std::to_string(::getpid())).append("-");
  temporary_name.append(std::to_string(counter++)).append(".tmp");
  std::filesystem::path temporary = destination;
  temporary.replace_filename(temporary_name);
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) Fail(path, "create a file in its folder", errno);
  if (std::filesystem::exists(status)) ::fchmod(fd, static_cast<mode_t>(status.permissions()));
  int error = WriteAndClose(fd, bytes, true);
  if (error == 0 && ::rename(temporary.c_str(), destination.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    Fail(path, "write it", error);
  }
}

void PrepareFolderOf(const std::filesystem::path& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) Fail(folder, "make this folder", error.value());
  if (::access(folder.c_str(), W_OK | X_OK) != 0) Fail(folder, "write in this folder", errno);
}

}  // namespace poselift
