// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "src/input_error.h"

namespace poselift {
namespace {

[[noreturn]] void Fail(const std::string& name, const char* doing) {
  throw InputError(name, std::string("cannot ") + doing + ": " + std::strerror(errno));
}

size_t UsableSize(int fd, const std::string& name) {
  struct stat status {};
  if (::fstat(fd, &status) != 0) Fail(name, "read it");
  if (S_ISDIR(status.st_mode)) throw InputError(name, "found a directory, wanted a file");
  if (!S_ISREG(status.st_mode))
    throw InputError(name, "found a pipe or a device, wanted an ordinary file");
  if (status.st_size == 0) throw InputError(name, "found an empty file, wanted one with content");
  return static_cast<size_t>(status.st_size);
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
  const std::string name = path.string();
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) Fail(name, "open it");
  struct Closer {
    int fd;
    ~Closer() { ::close(fd); }
  } closer{fd};
  size_ = UsableSize(fd, name);
  void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd, 0);
  if (mapped == MAP_FAILED) Fail(name, "map it into memory");
  data_ = static_cast<const char*>(mapped);
}

MappedFile::~MappedFile() { ::munmap(const_cast<char*>(data_), size_); }

}  // namespace poselift
