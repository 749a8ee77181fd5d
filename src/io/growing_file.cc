// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/growing_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "src/input_error.h"

namespace poselift {
namespace {

// 0 or the errno of what failed.
int WriteAt(int fd, size_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written > 0) {
      offset += static_cast<size_t>(written);
      bytes.remove_prefix(static_cast<size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      return written == 0 ? EIO : errno;
    }
  }
  return 0;
}

std::filesystem::path SpareOf(std::filesystem::path path) {
  std::string name(".");
  name.append(path.filename().string()).append(".spare");
  return path.replace_filename(name);
}

}  // namespace

GrowingFile::GrowingFile(const std::filesystem::path& path, std::string_view head,
                         std::string_view tail)
    : path_(path), spare_path_(SpareOf(path)), head_(head), tail_(tail) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path.string(), "found no plain file, wanted the name of a file to write");
  shown_ = Create(spare_path_);
  if (::rename(spare_path_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    ::close(shown_.fd);
    ::unlink(spare_path_.c_str());
    Fail("create it", error);
  }
  try {
    spare_ = Create(spare_path_);
  } catch (...) {
    ::close(shown_.fd);
    throw;
  }
  if (ExchangeNames())
    std::swap(shown_, spare_);
  else
    RemoveSpare();
}

GrowingFile::~GrowingFile() {
  try {
    Close();
  } catch (const InputError&) {
  }
}

GrowingFile::Copy GrowingFile::Create(const std::filesystem::path& path) const {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (fd < 0) Fail("create it", errno);
  if (const int error = WriteAt(fd, 0, head_ + tail_)) {
    ::close(fd);
    ::unlink(path.c_str());
    Fail("write it", error);
  }
  return {fd, head_.size()};
}

bool GrowingFile::ExchangeNames() const {
  return ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, spare_path_.c_str(), RENAME_EXCHANGE) == 0;
}

void GrowingFile::Append(std::string_view text) {
  if (shown_.fd < 0) throw std::logic_error("GrowingFile: text behind the end");
  if (spare_.fd < 0) return Write(&shown_, text);
  const Copy before = spare_;
  Write(&spare_, behind_ + std::string(text));
  if (!ExchangeNames()) {
    const int error = errno;
    spare_ = before;
    Fail("exchange it for its continuation", error);
  }
  std::swap(shown_, spare_);
  behind_ = text;
}

// All or, as far as the system lets us, nothing.
void GrowingFile::Write(Copy* copy, std::string_view text) const {
  int error = WriteAt(copy->fd, copy->body_end, std::string(text) + tail_);
  if (error == 0)
    error = WriteAt(copy->fd, changed_from_,
                    std::string_view(head_).substr(changed_from_, changed_to_ - changed_from_));
  if (error != 0) {
    // The tail has its place already, where the text began.
    const auto good_bytes = static_cast<off_t>(copy->body_end + tail_.size());
    const bool is_whole =
        WriteAt(copy->fd, copy->body_end, tail_) == 0 && ::ftruncate(copy->fd, good_bytes) == 0;
    Fail(is_whole ? "write it any further" : "write it, nor mend it", error);
  }
  copy->body_end += text.size();
}

void GrowingFile::Overwrite(size_t offset, std::string_view text) {
  if (offset > head_.size() || text.size() > head_.size() - offset)
    throw std::invalid_argument("GrowingFile: the head ends before what is to be overwritten");
  head_.replace(offset, text.size(), text);
  const bool is_first = changed_from_ == changed_to_;
  changed_from_ = is_first ? offset : std::min(changed_from_, offset);
  changed_to_ = std::max(changed_to_, offset + text.size());
}

void GrowingFile::RemoveSpare() {
  ::close(spare_.fd);
  spare_.fd = -1;
  ::unlink(spare_path_.c_str());
}

void GrowingFile::Close() {
  if (shown_.fd < 0) return;
  if (spare_.fd >= 0) RemoveSpare();
  if (::close(std::exchange(shown_.fd, -1)) != 0) Fail("write all of it", errno);
}

void GrowingFile::Fail(const std::string& doing, int error) const {
  throw InputError(path_.string(), "cannot " + doing + ": " + std::strerror(error));
}

}  // namespace poselift
