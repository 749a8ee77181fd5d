// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace poselift {

// A whole file in memory, to read: pages are fetched when they are touched and
// shared by all processes that map the file. The bytes begin at a page, so
// what is aligned in the file is aligned in memory.
//
// Throws InputError that says which: no such file, no permission, a directory,
// no ordinary file (a pipe, a device), empty.
//
// As with every map: a file that is replaced by renaming (as all of ours are)
// stays as it was, one that somebody else cuts short in place ends the process
// at the next touch.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view Bytes() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace poselift
