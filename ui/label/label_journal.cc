// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_journal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "src/input_error.h"
#include "src/io/labels.h"

namespace poselift {
namespace {

constexpr int kLinesToSync = 16;
constexpr std::uintmax_t kLargestJournal = std::uintmax_t{4} << 30;

// Unlike ReadTextFile with zeros in it: a loss of power may leave them at the end.
std::string ReadBytes(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return {};
  if (!std::filesystem::is_regular_file(status))
    throw InputError(path.string(), "found no plain file, wanted a journal; move it away");
  if (std::filesystem::file_size(path, error) > kLargestJournal)
    throw InputError(path.string(), "found more than 4 GiB, wanted a journal; move it away");
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file.good() && !file.eof()) throw InputError(path.string(), "cannot read it");
  return bytes;
}

InputError Impossible(const std::string& journal, const JournalLine& line, const std::string& why) {
  return InputError(journal, line.line, "found a step that cannot have happened: " + why);
}

bool IsMark(const JournalLine& line) {
  return line.kind == JournalLine::Kind::kSaving || line.kind == JournalLine::Kind::kSaved;
}

// How many lines lead up to the labels of the file. After the last save that is known to have been
// done, each that was begun may have been.
std::optional<size_t> LinesUpTo(const JournalText& journal, const FileStamp& file) {
  for (size_t i = journal.lines.size(); i-- > 0;) {
    const JournalLine& line = journal.lines[i];
    if (!IsMark(line)) continue;
    if (line.file == file) return i + 1;
    if (line.kind == JournalLine::Kind::kSaved) return std::nullopt;
  }
  if (journal.continues == file) return 0;
  return std::nullopt;
}

// The labels that the journal began with, by going back from those of the file.
Labels FirstLabels(const JournalText& journal, size_t num_lines, Labels labels,
                   const std::string& name) {
  LabelSteps steps;
  for (size_t i = 0; i < num_lines; ++i) {
    const JournalLine& line = journal.lines[i];
    if (line.kind == JournalLine::Kind::kEdit) {
      steps.Push(line.edit, line.before);
    } else if (line.kind == JournalLine::Kind::kUndo) {
      if (!steps.back()) throw Impossible(name, line, "nothing to undo");
      steps.Back();
    } else if (line.kind == JournalLine::Kind::kRedo) {
      if (!steps.forward()) throw Impossible(name, line, "nothing to redo");
      steps.Forward();
    } else {
      steps.Seal();
    }
  }
  try {
    for (; steps.back(); steps.Back()) RevertStep(*steps.back(), &labels);
  } catch (const InputError& error) {
    throw InputError(name, std::string("does not fit its labels file: ") + error.what());
  }
  return labels;
}

void Take(const JournalLine& line, const std::string& name, LabelHistory* history) {
  try {
    if (line.kind == JournalLine::Kind::kEdit && !history->Apply(line.edit))
      throw InputError("an edit that changes nothing");
    if (line.kind == JournalLine::Kind::kUndo && !history->Undo())
      throw InputError("nothing to undo");
    if (line.kind == JournalLine::Kind::kRedo && !history->Redo())
      throw InputError("nothing to redo");
  } catch (const InputError& error) {
    throw Impossible(name, line, error.what());
  }
  if (IsMark(line)) history->Seal();
}

}  // namespace

LabelJournal::LabelJournal(const std::filesystem::path& path, std::uint64_t whole_bytes,
                           std::string_view header)
    : path_(path), size_(whole_bytes) {
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
  if (fd_ < 0) throw InputError(path.string(), WriteFailure("open it for writing", errno));
  try {
    struct stat status {};
    if (::fstat(fd_, &status) != 0 || !S_ISREG(status.st_mode))
      throw InputError(path.string(), "found no plain file, wanted a journal; move it away");
    CutTo(size_);
    if (size_ == 0) Append(header);
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

LabelJournal::~LabelJournal() {
  ::fdatasync(fd_);  // nobody is left to be told that it failed
  ::close(fd_);
}

void LabelJournal::CutTo(std::uint64_t size) const {
  struct stat status {};
  if (::fstat(fd_, &status) != 0) throw InputError(path_.string(), WriteFailure("write it", errno));
  const auto there = static_cast<std::uint64_t>(status.st_size);
  if (status.st_nlink == 0 || there < size)
    throw InputError(path_.string(), "another program has removed or cut it; save the labels");
  if (there > size && ::ftruncate(fd_, static_cast<off_t>(size)) != 0)
    throw InputError(path_.string(), WriteFailure("cut off what was half written", errno));
}

void LabelJournal::WriteAll(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written > 0)
      bytes.remove_prefix(static_cast<size_t>(written));
    else if (written == 0 || errno != EINTR)
      throw InputError(path_.string(), WriteFailure("write it", written == 0 ? ENOSPC : errno));
  }
}

void LabelJournal::Append(std::string_view lines) {
  CutTo(size_);  // what an earlier failure could not
  try {
    WriteAll(lines);
    if (++lines_to_sync_ >= kLinesToSync) Sync();
  } catch (const InputError&) {
    if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0) { /* the next Append tries again */
    }
    throw;
  }
  size_ += lines.size();
}

void LabelJournal::Sync() {
  if (::fdatasync(fd_) != 0)
    throw InputError(path_.string(), WriteFailure("bring it to the disk", errno));
  lines_to_sync_ = 0;
}

JournalText ReadJournal(const std::filesystem::path& path, const Layout& layout) {
  const std::string bytes = ReadBytes(path), name = path.string();
  JournalText journal;
  int number = 0;
  for (size_t end; (end = bytes.find('\n', journal.whole_bytes)) != std::string::npos;) {
    const std::string_view line(bytes.data() + journal.whole_bytes, end - journal.whole_bytes);
    ++number;
    if (number == 1) {
      journal.continues = ReadJournalHeader(line, name);
    } else {
      try {
        journal.lines.push_back(ReadJournalLine(line, name, number, layout));
      } catch (const InputError& error) {
        journal.damage = error.what();
        break;
      }
    }
    journal.whole_bytes = end + 1;
  }
  return journal;
}

std::optional<ReplayedLabels> Replay(const JournalText& journal, const Labels& labels,
                                     const FileStamp& file, const std::string& journal_name) {
  const std::optional<size_t> num_lines = LinesUpTo(journal, file);
  if (!num_lines) return std::nullopt;
  ReplayedLabels replayed{LabelHistory(FirstLabels(journal, *num_lines, labels, journal_name)), 0};
  for (size_t i = 0; i <= journal.lines.size(); ++i) {
    if (i == *num_lines) {
      replayed.file_state = replayed.history.state();
      if (LabelsText(replayed.history.labels()) != LabelsText(labels))
        throw InputError(journal_name, "its steps do not lead to its labels file");
    }
    if (i < journal.lines.size()) Take(journal.lines[i], journal_name, &replayed.history);
  }
  return replayed;
}

CompactedJournal CompactJournal(const LabelSteps& steps, const FileStamp& file,
                                std::uint64_t largest_size) {
  std::vector<std::string> lines;
  std::uint64_t size = 0;
  for (const LabelStep& step : steps.all()) {
    LabelEdit edit = step.edit;
    edit.merge_key.clear();  // steps that did not merge must not merge now
    lines.push_back(EditLine(edit, step.before));
    size += lines.back().size();
  }
  CompactedJournal journal;
  for (; journal.num_forgotten < steps.applied() && size > largest_size; ++journal.num_forgotten)
    size -= lines[journal.num_forgotten].size();
  journal.text = JournalHeader(file);
  for (size_t i = journal.num_forgotten; i < lines.size(); ++i) journal.text += lines[i];
  for (size_t i = steps.applied(); i < lines.size(); ++i) journal.text += UndoLine();
  journal.text += SavedLine(file);
  return journal;
}

std::string WriteFailure(std::string_view doing, int error_number) {
  std::string_view advice = "try again";
  if (error_number == ENOSPC)
    advice = "make room on the disk";
  else if (error_number == EDQUOT)
    advice = "your quota is used up: remove files of yours";
  else if (error_number == EFBIG)
    advice = "files may not grow so large here: raise the limit (ulimit -f)";
  else if (error_number == EROFS || error_number == EACCES || error_number == EPERM)
    advice = "make the folder writable, or save to another one";
  else if (error_number == EIO)
    advice = "the disk may be failing: save to another one";
  return fmt::format("cannot {}: {}; {}", doing, std::strerror(error_number), advice);
}

}  // namespace poselift
