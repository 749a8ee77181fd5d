// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace poselift {

// A text file that grows while a program runs and is whole at every moment: a head, what was
// appended so far, a tail. That is what kill -9 leaves, and what a reader sees who is done
// with it before the next addition but one.
//
// One pwrite does not do: a kill cuts it where it crosses a page (measured: 2 to 6 % of
// kills). So there are two copies. An addition goes to the one that nobody sees, which then
// changes places with the other in one step (renameat2, RENAME_EXCHANGE) and so leaves the
// other to be caught up at the next addition. The other stands beside the file as
// .NAME.spare until Close; after a kill it stays there and may be removed.
// A file system without that step (FAT, NFS) gets one copy, written to in place: there a kill
// in the middle of a write, some microseconds, can cut the last addition.
//
// Nothing waits for the disk: a loss of power may take the last seconds.
class GrowingFile {
 public:
  // The file is there, with head and tail, and takes the place of an older one.
  // Throws InputError when it cannot be written, or when there is something else than a file.
  GrowingFile(const std::filesystem::path& path, std::string_view head, std::string_view tail);
  // Closes; says nothing of what fails then.
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  // Puts text before the tail. Throws InputError when that fails (the disk is full): the file
  // is then as it was before, and the next Append may succeed.
  void Append(std::string_view text);

  // Puts text in the place of as much of the head, together with the next Append: a count.
  // Throws std::invalid_argument when the head ends before it.
  void Overwrite(size_t offset, std::string_view text);

  // Removes the other copy. Throws InputError when the system says only now that a write
  // failed. Nothing can be appended afterwards; a second Close does nothing.
  void Close();

 private:
  struct Copy {
    int fd = -1;
    size_t body_end = 0;  // where the tail begins
  };
  Copy Create(const std::filesystem::path& path) const;
  bool ExchangeNames() const;
  void Write(Copy* copy, std::string_view text) const;
  void RemoveSpare();
  [[noreturn]] void Fail(const std::string& doing, int error) const;

  std::filesystem::path path_, spare_path_;
  std::string head_, tail_;
  size_t changed_from_ = 0, changed_to_ = 0;  // of the head, since the start
  Copy shown_, spare_;                        // spare_.fd < 0: there is none
  std::string behind_;                        // what was appended last: spare_ lacks it
};

}  // namespace poselift
