// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/label/label_history.h"
#include "ui/label/label_journal.h"
#include "ui/label/label_relink.h"
#include "ui/label/project_lock.h"

namespace poselift {

// Writes labels where there is no file yet, for LabelProject to open. Throws InputError when there
// is one, when the labels are such as CheckEdit refuses, or the file cannot be written.
void CreateLabelsFile(const std::filesystem::path& path, const Labels& labels);

// A labels file that is being worked on, and never loses a step:
//   NAME                labels (poselift-labels), as they were saved last
//   .NAME.journal       every step since the file was opened first, as it is taken (LabelJournal)
//   .NAME.journal.1 ... journals that did not continue the file any more, up to 10: then the oldest
//                       makes room
//   .NAME.lock          who works on it (ProjectLock)
// Opening brings back what was not saved, and all steps that can be taken back. A file that is not
// the one which the journal continues is taken as it is; a damaged journal counts up to the damage;
// in both cases the journal is kept beside it, and messages() says so.
//
// A journal without steps is removed on closing. Save makes one that has grown beyond
// Options::longest_journal shorter: steps that no Undo or Redo leads to go, then the oldest, until
// half of that is left. So it is bounded by the steps between two Saves.
class LabelProject {
 public:
  struct Options {
    std::uint64_t longest_journal = 32u << 20;  // bytes
    int num_kept_journals = 10;
    bool read_only = false;  // to look at the file alone: nothing is written
  };

  // Throws InputError for a file that cannot be read or is of another format (ReadLabels and
  // CreateLabelsFile make one of it). A journal that cannot be written is no error yet: see
  // unsaved_reason(), which is known at once.
  LabelProject(const std::filesystem::path& path, const Options& options);
  explicit LabelProject(const std::filesystem::path& path) : LabelProject(path, Options()) {}
  ~LabelProject();
  LabelProject(const LabelProject&) = delete;
  LabelProject& operator=(const LabelProject&) = delete;

  const Labels& labels() const { return history_.labels(); }
  const LabelHistory& history() const { return history_; }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path dir() const { return path_.parent_path(); }  // of image paths

  // On return the step is in the journal, or else unsaved_reason() says why it is in memory alone;
  // every further step tries again with all of them. False: there was nothing to do.
  // Throws InputError, and changes nothing, as CheckEdit and when read_only().
  bool Apply(LabelEdit edit);
  bool Undo();
  bool Redo();
  // Points the frames whose pictures are missing to those in the folder, as one step. Returns how
  // many.
  size_t Relink(const std::filesystem::path& folder);

  // Puts the labels into the file; its older version, when somebody else has changed it since, is
  // kept as NAME.1, NAME.2, ... Throws InputError when the file cannot be written: nothing is lost
  // then that was not before. The steps stay.
  void Save();
  bool IsSaved() const { return history_.state() == saved_state_; }

  // For idle moments: tries again what could not be written, and waits for the disk.
  void Sync();

  // Empty while every step is in the journal; else why not, and what to do.
  const std::string& unsaved_reason() const { return unsaved_reason_; }
  // As wanted, or somebody else works on the file: one may look, and read why in messages().
  bool read_only() const { return read_only_; }
  // What happened on opening and saving that a person should know, oldest first.
  const std::vector<std::string>& messages() const { return messages_; }
  void Tell(std::string message) { messages_.push_back(std::move(message)); }

 private:
  enum class OldJournal { kContinue, kCopyFirst, kMoveAside };

  void ReadFile();
  void ReadOldJournal();
  void OpenJournal();
  std::filesystem::path NameToKeep() const;
  void Note(const std::string& line);
  void Flush();
  void RefuseWhenReadOnly() const;
  void KeepForeignVersion();
  void Shorten();

  std::filesystem::path path_;                 // absolute
  std::filesystem::path file_, journal_path_;  // without symbolic links
  Options options_;
  std::unique_ptr<ProjectLock> lock_;
  std::string lock_holder_;
  bool read_only_ = false;

  LabelHistory history_{Labels{}};
  std::uint64_t saved_state_ = 0;
  FileStamp opened_stamp_, file_stamp_;  // the file when it was opened, and now

  OldJournal old_journal_ = OldJournal::kContinue;
  std::uint64_t journal_bytes_ = 0, journal_bytes_there_ = 0;  // those to continue, and all
  std::optional<LabelJournal> journal_;
  std::string pending_;  // lines that the journal has not taken
  std::string unsaved_reason_;
  std::vector<std::string> messages_;
};

}  // namespace poselift
