// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "src/layout.h"
#include "ui/label/label_history.h"

namespace poselift {

// What tells one version of a file from another: its size and a hash of its bytes (FNV-1a, 64
// bits: against accidents, not against forgers).
struct FileStamp {
  std::uint64_t size = 0;
  std::uint64_t hash = 0;

  bool operator==(const FileStamp&) const = default;
};
FileStamp StampOf(std::string_view bytes);

// A line of a journal (LabelJournal): JSON, and a line break at its end.
//   {"format": "poselift-journal", "version": 1, "file": {"size": 812, "hash": "90f3..."}}
//   {"step": "edit", "name": "place nose", "people": {"3": [PERSON, ...]},
//    "images": {"3": "a.jpg"}, "times": {"3": {"time_s": 0.5, "frame": 15}}, "dropped": 1,
//    "added": [FRAME, ...], "merge": "...",
//    "before": {"people": {"3": [PERSON, ...]}, "images": {"3": "b.jpg"}, "times": {"3": {}},
//               "added": [FRAME]}}
//   {"step": "undo"}                 {"step": "redo"}
//   {"step": "saving", "file": ...}  the labels as they are here are about to be the file's
//   {"step": "saved", "file": ...}   they are
// PERSON and FRAME are those of poselift-labels (docs/FORMATS.md); frames count from 0. An edit
// also says what was there before: the file may be of any moment, and the way leads from it in both
// directions.
struct JournalLine {
  enum class Kind { kEdit, kUndo, kRedo, kSaving, kSaved };

  Kind kind = Kind::kEdit;
  LabelEdit edit, before;  // of an edit
  FileStamp file;          // of saving and saved
  int line = 0;            // in the journal, from 1
};

std::string JournalHeader(const FileStamp& file);
std::string EditLine(const LabelEdit& edit, const LabelEdit& before);
std::string UndoLine();
std::string RedoLine();
std::string SavingLine(const FileStamp& file);
std::string SavedLine(const FileStamp& file);

// Throw InputError: FILE:LINE: what was found, what was wanted. text: one line, with or without
// its break.
FileStamp ReadJournalHeader(std::string_view text, const std::string& file);
JournalLine ReadJournalLine(std::string_view text, const std::string& file, int line,
                            const Layout& layout);

}  // namespace poselift
