// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/reader_tables.h"

#include <random>

#include "src/capture/camera_controls.h"
#include "src/input_error.h"
#include "src/io/labels.h"
#include "src/layout.h"
#include "tests/support/random_labels.h"
#include "ui/label/key_map.h"
#include "ui/label/label_journal.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

FileStamp Stamp(const Labels& labels) { return StampOf(LabelsText(labels)); }

// Steps of every kind, between two savings.
std::string SomeJournal(const fs::path&) {
  LabelHistory history(SomeLabels());
  std::mt19937 rng(1);
  std::string text = JournalHeader(Stamp(history.labels()));
  for (int i = 0; i < 4; ++i)
    if (history.Apply(RandomEdit(history.labels(), &rng)))
      text += EditLine(history.steps().back()->edit, history.steps().back()->before);
  const FileStamp saved = Stamp(history.labels());
  return text + UndoLine() + RedoLine() + SavingLine(saved) + SavedLine(saved) + UndoLine();
}

// What is damaged ends the journal, and is told; only one that cannot be told of is refused.
std::string ReadsJournal(const fs::path& path) {
  const Labels labels = SomeLabels();
  const auto journal = ReadJournal(path, *FindLayout(labels.layout));
  auto replayed = Replay(journal, labels, Stamp(labels), path);
  if (!journal.damage.empty()) throw InputError(journal.damage);
  while (replayed && replayed->history.Undo()) {
  }
  return "";
}

std::string ReadsKeys(const fs::path& path) {
  KeyMap::Read(path);
  return "";
}

std::string ReadsControl(const fs::path& path) {
  try {
    const ControlValue control = ParseControl(FileText(path));
    return control.name.empty() || control.value.empty() ? "a control without name or value" : "";
  } catch (const InputError& error) {
    throw InputError(path, error.what());
  }
}

}  // namespace

std::vector<Reader> WindowReaders() {
  return {
      {"journal", "labels.journal", SomeJournal, ReadsJournal},
      {"keys", "keys.toml", Text("save = 'Ctrl+S'\nfit = ['F', 'W']\nhelp = []\n"), ReadsKeys},
      {"control", "control", Text("exposure=50"), ReadsControl},
  };
}

}  // namespace poselift::testing
