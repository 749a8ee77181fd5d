// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_project.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/json_value.h"
#include "src/io/labels.h"
#include "src/io/labels_formats.h"
#include "src/io/text_scanner.h"
#include "src/layout.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

// .NAME.ending beside NAME
fs::path Beside(const fs::path& file, const std::string& ending) {
  return file.parent_path() / fmt::format(".{}{}", file.filename().string(), ending);
}

bool IsThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

std::uint64_t SizeOf(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

void CopyNew(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!fs::copy_file(from, to, fs::copy_options::overwrite_existing, error))
    throw InputError(to.string(), WriteFailure("keep a copy", error.value()));
}

}  // namespace

void CreateLabelsFile(const fs::path& path, const Labels& labels) {
  LabelEdit all;
  all.added = labels.frames;
  CheckEdit({labels.layout, {}}, all);
  const std::string text = LabelsText(labels);
  // Whoever makes the file has it: no second one writes over what the first has made.
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0 && errno == EEXIST)
    throw InputError(path.string(), "found a file already, wanted a new name; open it instead");
  if (fd < 0) throw InputError(path.string(), WriteFailure("create it", errno));
  ::close(fd);
  try {
    WriteFileAtomically(path, text);
  } catch (...) {
    ::unlink(path.c_str());
    throw;
  }
}

LabelProject::LabelProject(const fs::path& path, const Options& options)
    : path_(fs::absolute(path)), options_(options) {
  std::error_code ignored;
  file_ = fs::weakly_canonical(path_, ignored);
  if (file_.empty()) file_ = path_;
  journal_path_ = Beside(file_, ".journal");
  if (!fs::exists(file_, ignored)) throw InputError(path_.string(), "cannot open it: not there");
  read_only_ = options.read_only;
  try {
    if (!read_only_) lock_ = ProjectLock::Take(Beside(file_, ".lock"), &lock_holder_);
    read_only_ = lock_ == nullptr;
  } catch (const InputError&) {
    // A read-only folder, perhaps: OpenJournal meets it again and has it told.
  }
  ReadFile();
  ReadOldJournal();
  if (read_only_ && !options.read_only)
    messages_.push_back(fmt::format(
        "{} is open in another window{}: it can be looked at here, not changed", path_.string(),
        lock_holder_.empty() ? "" : fmt::format(" (process {})", lock_holder_)));
  Flush();
}

LabelProject::~LabelProject() {
  Flush();
  if (journal_ && history_.steps().all().empty()) ::unlink(journal_path_.c_str());
}

void LabelProject::ReadFile() {
  const std::string text = ReadTextFile(file_);
  const JsonDocument document(text, path_.string());
  if (!IsNativeLabels(document.root()))
    throw InputError(path_.string(),
                     "found no poselift-labels file; read it as labels and save it as a new one");
  opened_stamp_ = file_stamp_ = StampOf(text);
  history_ = LabelHistory(ReadNativeLabels(document.root(), nullptr));
}

void LabelProject::ReadOldJournal() {
  const std::string name = journal_path_.string();
  journal_bytes_there_ = SizeOf(journal_path_);
  try {
    const JournalText journal = ReadJournal(journal_path_, *FindLayout(labels().layout));
    journal_bytes_ = journal.whole_bytes;
    if (journal_bytes_ > 0) {
      std::optional<ReplayedLabels> replayed = Replay(journal, labels(), file_stamp_, name);
      if (!replayed)
        throw InputError(name, "continues another version of the file; the file is taken as it is");
      history_ = std::move(replayed->history);
      saved_state_ = replayed->file_state;
      if (!IsSaved()) messages_.push_back("changes that were not saved to the file are back");
    }
    if (journal.damage.empty()) return;
    messages_.push_back(journal.damage + "; the steps before it are taken");
    old_journal_ = journal_bytes_ > 0 ? OldJournal::kCopyFirst : OldJournal::kMoveAside;
  } catch (const InputError& error) {
    messages_.emplace_back(error.what());
    journal_bytes_ = 0;
    old_journal_ = OldJournal::kMoveAside;
  }
}

// Free, or the oldest of those there are.
fs::path LabelProject::NameToKeep() const {
  std::vector<fs::path> names;
  for (int i = 1; i <= std::max(options_.num_kept_journals, 1); ++i) {
    names.push_back(journal_path_.string() + fmt::format(".{}", i));
    if (!IsThere(names.back())) return names.back();
  }
  return *std::min_element(names.begin(), names.end(), [](const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::last_write_time(a, ignored) < fs::last_write_time(b, ignored);
  });
}

void LabelProject::OpenJournal() {
  if (!lock_) {
    lock_ = ProjectLock::Take(Beside(file_, ".lock"), &lock_holder_);
    if (!lock_)
      throw InputError(path_.string(), "another window has opened it; save under another name");
    if (SizeOf(journal_path_) != journal_bytes_there_)
      throw InputError(journal_path_.string(), "another window has written it; open the file anew");
  }
  if (old_journal_ != OldJournal::kContinue) {
    const fs::path kept = NameToKeep();
    if (old_journal_ == OldJournal::kCopyFirst)
      CopyNew(journal_path_, kept);
    else if (::rename(journal_path_.c_str(), kept.c_str()) != 0)
      throw InputError(journal_path_.string(), WriteFailure("move it to " + kept.string(), errno));
    old_journal_ = OldJournal::kContinue;
    messages_.push_back(fmt::format("the journal was kept as {}", kept.string()));
  }
  journal_.emplace(journal_path_, journal_bytes_, JournalHeader(opened_stamp_));
}

void LabelProject::Flush() {
  if (read_only_) return;
  try {
    if (!journal_) OpenJournal();
    if (!pending_.empty()) journal_->Append(pending_);
    pending_.clear();
    unsaved_reason_.clear();
  } catch (const InputError& error) {
    unsaved_reason_ = fmt::format("{} (changes are in memory only)", error.what());
  }
}

void LabelProject::Note(const std::string& line) {
  pending_ += line;
  Flush();
}

void LabelProject::RefuseWhenReadOnly() const {
  if (!read_only_) return;
  throw InputError(path_.string(), options_.read_only
                                       ? "it is open to be looked at; open it without --read-only"
                                       : "it is open in another window; change it there");
}

bool LabelProject::Apply(LabelEdit edit) {
  RefuseWhenReadOnly();
  if (!history_.Apply(std::move(edit))) return false;
  const LabelStep& step = *history_.steps().back();
  Note(EditLine(step.edit, step.before));
  return true;
}

bool LabelProject::Undo() {
  RefuseWhenReadOnly();
  if (!history_.Undo()) return false;
  Note(UndoLine());
  return true;
}

bool LabelProject::Redo() {
  RefuseWhenReadOnly();
  if (!history_.Redo()) return false;
  Note(RedoLine());
  return true;
}

size_t LabelProject::Relink(const fs::path& folder) {
  LabelEdit edit = RelinkImages(labels(), dir(), folder);
  const size_t num_found = edit.images.size();
  Apply(std::move(edit));
  return num_found;
}

void LabelProject::KeepForeignVersion() {
  if (!IsThere(file_)) return;
  // A rename would do: it asks the folder alone, not the file that is replaced.
  if (::access(file_.c_str(), W_OK) != 0)
    throw InputError(path_.string(), WriteFailure("write it", errno));
  if (StampOf(ReadTextFile(file_)) == file_stamp_) return;
  fs::path kept;
  for (int i = 1; IsThere(kept = file_.string() + fmt::format(".{}", i));) ++i;
  CopyNew(file_, kept);
  messages_.push_back(fmt::format("{} was changed by another program; that version was kept as {}",
                                  path_.string(), kept.string()));
}

void LabelProject::Save() {
  RefuseWhenReadOnly();
  KeepForeignVersion();
  const std::string text = LabelsText(labels());
  const FileStamp stamp = StampOf(text);
  // First the journal: the file is one it knows, whether a kill comes before the rename or after.
  history_.Seal();
  Note(SavingLine(stamp));
  Sync();
  WriteFileAtomically(file_, text);
  file_stamp_ = stamp;
  saved_state_ = history_.state();
  Note(SavedLine(stamp));
  Shorten();
}

void LabelProject::Sync() {
  Flush();
  try {
    if (journal_) journal_->Sync();
  } catch (const InputError& error) {
    unsaved_reason_ = error.what();
  }
}

void LabelProject::Shorten() {
  // Also when the journal did not take the last steps: another one may be easier to write.
  const bool is_behind = !journal_ || !pending_.empty();
  if (!lock_ || old_journal_ != OldJournal::kContinue) return;
  if (!is_behind && journal_->size() <= options_.longest_journal) return;
  const CompactedJournal compact =
      CompactJournal(history_.steps(), file_stamp_, options_.longest_journal / 2);
  try {
    WriteFileAtomically(journal_path_, compact.text);
  } catch (const InputError& error) {
    if (!is_behind) messages_.emplace_back(error.what());
    return;  // the long one does as well
  }
  pending_.clear();
  journal_.reset();
  journal_bytes_ = compact.text.size();
  // A later Undo must find its step in the journal too.
  history_.Forget(compact.num_forgotten);
  Flush();
}

}  // namespace poselift
