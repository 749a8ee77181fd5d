// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/labels.h"
#include "ui/label/journal_line.h"
#include "ui/label/label_history.h"

namespace poselift {

// A file of lines, written at its end and nowhere else, that makes labelling survive a kill:
// a line that Append has returned for was taken by the kernel and is there however the program
// ends. To the disk it goes with every 16th line and at Sync: a loss of power may take the last
// steps, never older ones, and leaves a journal that can be read.
class LabelJournal {
 public:
  // Continues the journal: of what is there the first whole_bytes stay (JournalText), the rest,
  // a torn line, is cut off. An empty journal begins with the header.
  // Throws InputError with what to do when it cannot be written (a full disk, a read-only folder).
  LabelJournal(const std::filesystem::path& path, std::uint64_t whole_bytes,
               std::string_view header);
  ~LabelJournal();
  LabelJournal(const LabelJournal&) = delete;
  LabelJournal& operator=(const LabelJournal&) = delete;

  // Whole lines. Throws InputError with what to do when the file does not take all of them: it then
  // has none of them, and the next Append may succeed.
  void Append(std::string_view lines);

  // To the disk. Throws InputError when the disk does not take it.
  void Sync();

  std::uint64_t size() const { return size_; }

 private:
  void WriteAll(std::string_view bytes);
  void CutTo(std::uint64_t size) const;

  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;  // up to the last line that was acknowledged
  int lines_to_sync_ = 0;
};

// What was read of a journal.
struct JournalText {
  FileStamp continues;             // the labels file it began with
  std::vector<JournalLine> lines;  // whole and without fault
  std::uint64_t whole_bytes = 0;   // of header and lines; 0: nothing was ever written
  std::string damage;              // file:line: what is wrong with the line after these, or nothing
};

// A last line without a break was never acknowledged: it is passed over. A journal that is not
// there is an empty one. Throws InputError for what is no journal: a folder, another file, a
// header with a fault.
JournalText ReadJournal(const std::filesystem::path& path, const Layout& layout);

struct ReplayedLabels {
  LabelHistory history;
  std::uint64_t file_state = 0;  // LabelHistory::state() of the labels file
};

// The history that a journal has kept, from the labels of the file, whose stamp says of which
// moment they are: what was last known to be saved, or was being saved since. Nothing when they are
// of none. Throws InputError, file:line, for steps that cannot have happened.
std::optional<ReplayedLabels> Replay(const JournalText& journal, const Labels& labels,
                                     const FileStamp& file, const std::string& journal_name);

// A journal of the same steps without detours, for labels that have just been saved as `file`.
// The oldest steps are left out until the rest has at most largest_size bytes, so far as they are
// in force.
struct CompactedJournal {
  std::string text;
  size_t num_forgotten = 0;  // steps left out: the history that goes on must forget them too
};
CompactedJournal CompactJournal(const LabelSteps& steps, const FileStamp& file,
                                std::uint64_t largest_size);

// "cannot write it: No space left on device; make room on the disk"
std::string WriteFailure(std::string_view doing, int error_number);

}  // namespace poselift
