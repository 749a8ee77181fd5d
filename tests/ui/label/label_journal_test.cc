// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: journals in files, cut, damaged and full (by the limit of a file's size). Made up: the
// labels. Properties: a journal gives back the same history, to the last bit, wherever its end is
// torn off; what was damaged is refused by file and line, or ends the journal there; a line that
// did not get in leaves nothing behind and gets in later.
#include "ui/label/label_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <filesystem>
#include <fstream>

#include "src/input_error.h"
#include "src/io/labels.h"
#include "src/layout.h"
#include "tests/support/mutation.h"
#include "tests/support/random_labels.h"
#include "tests/support/size_limit.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ExactText;
using testing::FileText;
using ::testing::HasSubstr;
using testing::ScratchDir;
using testing::SomeLabels;
using testing::WriteScratch;

const Layout& Body15() { return *FindLayout("body15"); }

FileStamp SomeStamp() { return StampOf(LabelsText(SomeLabels())); }

// A history, its journal as text, and where each line of it ends.
class Writer {
 public:
  const Labels& labels() const { return history.labels(); }
  void Apply(LabelEdit edit) {
    if (history.Apply(std::move(edit)))
      Line(EditLine(history.steps().back()->edit, history.steps().back()->before));
  }
  void Undo() {
    if (history.Undo()) Line(UndoLine());
  }
  void Redo() {
    if (history.Redo()) Line(RedoLine());
  }
  void Save() {
    history.Seal();
    saved = labels();
    Line(SavingLine(StampOf(LabelsText(saved))));
    Line(SavedLine(StampOf(LabelsText(saved))));
  }
  void Line(const std::string& line) {
    text += line;
    ends.push_back(text.size());
    states.push_back(ExactText(history));
  }

  LabelHistory history{SomeLabels()};
  Labels saved = SomeLabels();
  std::string text = JournalHeader(SomeStamp());
  std::vector<size_t> ends = {text.size()};
  std::vector<std::string> states = {ExactText(history)};
};

Writer Written(const std::vector<std::uint32_t>& seeds) {
  Writer writer;
  for (const std::uint32_t seed : seeds) testing::TakeRandomStep(seed, &writer);
  return writer;
}

std::optional<ReplayedLabels> ReplayText(const std::string& text, const Labels& labels) {
  const std::string path = WriteScratch("journal", text);
  return Replay(ReadJournal(path, Body15()), labels, StampOf(LabelsText(labels)), path);
}

TEST(LabelJournal, ReplayIsTheHistoryWhereverTheEndIsTornOff) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint32_t>& seeds) {
    const Writer writer = Written(seeds);
    const size_t cut = *rc::gen::inRange<size_t>(writer.ends[0], writer.text.size() + 1);
    const auto replayed = ReplayText(writer.text.substr(0, cut), SomeLabels());
    const auto end = std::upper_bound(writer.ends.begin(), writer.ends.end(), cut);
    RC_ASSERT(replayed.has_value());
    RC_ASSERT(ExactText(replayed->history) ==
              writer.states[static_cast<size_t>(end - writer.ends.begin()) - 1]);
    RC_ASSERT(replayed->file_state == 0u);
  }));
}

TEST(LabelJournal, TheWayLeadsFromASavedFileInBothDirections) {
  EXPECT_TRUE(rc::check(
      [](const std::vector<std::uint32_t>& before, const std::vector<std::uint32_t>& after) {
        Writer writer = Written(before);
        writer.Save();
        const std::uint64_t file_state = writer.history.state();
        for (const std::uint32_t seed : after) testing::TakeRandomStep(seed, &writer);
        WriteLabels(writer.saved, ScratchDir() / "labels.json");
        auto replayed = ReplayText(writer.text, ReadLabels(ScratchDir() / "labels.json"));
        RC_ASSERT(replayed.has_value());
        RC_ASSERT(replayed->file_state == file_state);
        RC_ASSERT(ExactText(replayed->history) == ExactText(writer.history));
        while (replayed->history.Undo()) {
        }
        RC_ASSERT(ExactText(replayed->history.labels()) == ExactText(SomeLabels()));
      }));
}

TEST(LabelJournal, ACompactOneHasTheSameSteps) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint32_t>& seeds) {
    Writer writer = Written(seeds);
    writer.Save();
    const auto& steps = writer.history.steps();
    const auto whole = ReplayText(
        CompactJournal(steps, StampOf(LabelsText(writer.saved)), 1 << 30).text, writer.saved);
    RC_ASSERT(whole.has_value());
    RC_ASSERT(ExactText(whole->history.labels()) == ExactText(writer.labels()));
    RC_ASSERT(whole->history.NumSteps() == writer.history.NumSteps());
    RC_ASSERT(whole->history.UndoName() == writer.history.UndoName());
    RC_ASSERT(whole->history.RedoName() == writer.history.RedoName());
    const auto none =
        ReplayText(CompactJournal(steps, StampOf(LabelsText(writer.saved)), 0).text, writer.saved);
    RC_ASSERT(none->history.NumSteps() == 0u);
    RC_ASSERT(none->history.RedoName() == writer.history.RedoName());
    RC_ASSERT(ExactText(none->history.labels()) == ExactText(writer.labels()));
  }));
}

TEST(LabelJournal, ContinuesOnlyTheFileItKnows) {
  Writer writer = Written({3, 4, 5, 6, 7});
  Labels other = SomeLabels();
  other.frames.pop_back();
  EXPECT_FALSE(ReplayText(writer.text, other));
  // A save that was begun may have been done or not; one that was done leaves the old file behind.
  const FileStamp next = StampOf(LabelsText(writer.labels()));
  const std::string saving = writer.text + SavingLine(next);
  EXPECT_TRUE(ReplayText(saving, SomeLabels()));
  EXPECT_TRUE(ReplayText(saving, writer.labels()));
  EXPECT_FALSE(ReplayText(saving + SavedLine(next), SomeLabels()));
  EXPECT_TRUE(ReplayText(saving + SavedLine(next), writer.labels()));
}

TEST(LabelJournal, RefusesStepsThatCannotHaveHappenedByTheirLine) {
  const std::string header = JournalHeader(SomeStamp());
  const LabelEdit far{"far", {{99, {}}}, {}, {}, {}};
  const LabelEdit nothing{"nothing", {}, {}, {}, {}};
  for (const std::string& line :
       {UndoLine(), RedoLine(), EditLine(far, far), EditLine(nothing, nothing)}) {
    try {
      ReplayText(header + line, SomeLabels());
      ADD_FAILURE() << line;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("journal:2: found a step that cannot have happened"));
    }
  }
  // Steps that do not lead to the file: whose way back has other labels than the way there.
  const LabelEdit empty{"empty", {{1, {}}}, {}, {}, {}};
  EXPECT_THROW(ReplayText(header + EditLine(empty, empty) + SavedLine(SomeStamp()), SomeLabels()),
               InputError);
}

TEST(LabelJournal, ALineWithAFaultEndsIt) {
  const Writer writer = Written({3, 4, 5, 6, 7});
  const std::string path =
      WriteScratch("journal", writer.text + "{\"step\": \"dance\"}\n" + UndoLine());
  const JournalText journal = ReadJournal(path, Body15());
  EXPECT_EQ(journal.whole_bytes, writer.text.size());
  EXPECT_EQ(journal.lines.size() + 1, writer.ends.size());
  EXPECT_THAT(journal.damage, HasSubstr("found \"dance\", wanted edit, undo, redo"));
  EXPECT_THAT(journal.damage, HasSubstr(":" + std::to_string(writer.ends.size() + 1) + ":"));
}

TEST(LabelJournal, WhatWasNeverWrittenIsEmpty) {
  const fs::path dir = ScratchDir();
  EXPECT_EQ(ReadJournal(dir / "absent", Body15()).whole_bytes, 0u);
  EXPECT_EQ(ReadJournal(WriteScratch("empty", ""), Body15()).whole_bytes, 0u);
  EXPECT_EQ(ReadJournal(WriteScratch("torn", "{\"format\": \"pos"), Body15()).whole_bytes, 0u);
}

TEST(LabelJournal, RefusesWhatIsNoJournal) {
  EXPECT_THROW(ReadJournal(ScratchDir(), Body15()), InputError);
  EXPECT_THROW(ReadJournal("/dev/null", Body15()), InputError);
  const std::string huge_size = R"({"format": "poselift-journal", "version": 1,
 "file": {"size": 1e300, "hash": "0000000000000000"}}
)";
  for (std::string text :
       {std::string("\n"), std::string("walk\n"), std::string("{}\n"), std::string(3, '\0') + "\n",
        LabelsText(SomeLabels()), huge_size, Written({}).text.replace(45, 1, "9"),
        testing::FileText(testing::SourcePath("tests/golden/leg.bvh"))}) {
    std::replace(text.begin(), text.end() - 1, '\n', ' ');
    EXPECT_THROW(ReadJournal(WriteScratch("other", text), Body15()), InputError) << text;
  }
}

TEST(LabelJournal, DamageIsRefusedOrPassedOver) {
  std::mt19937_64 rng = testing::TestRng();
  Writer writer = Written({11, 12, 13, 14, 15, 16});
  writer.Save();
  int refused = 0, taken = 0;
  for (const std::string& damaged : testing::DamagedCopies(writer.text, 150, &rng)) {
    try {
      const auto replayed = ReplayText(damaged, SomeLabels());
      if (replayed) {
        LabelEdit all;
        all.added = replayed->history.labels().frames;
        EXPECT_NO_THROW(CheckEdit({"body15", {}}, all));
      }
      ++taken;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("journal"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 5);
  EXPECT_GT(taken, 5);
}

TEST(LabelJournal, ATornLineIsCutOffBeforeTheNextOne) {
  const Writer writer = Written({3, 4, 5, 6, 7});
  const std::string path = WriteScratch("journal", writer.text + "{\"step\": \"un");
  {
    LabelJournal journal(path, writer.text.size(), "");
    journal.Append(UndoLine());
    journal.Sync();
    EXPECT_EQ(journal.size(), writer.text.size() + UndoLine().size());
  }
  EXPECT_EQ(FileText(path), writer.text + UndoLine());
}

TEST(LabelJournal, OnAFullDiskStaysWholeAndGoesOnLater) {
  const std::string header = JournalHeader(SomeStamp());
  const fs::path path = ScratchDir() / "journal";
  LabelJournal journal(path, 0, header);
  journal.Append(UndoLine());
  for (const size_t room : {0u, 1u, 10u}) {
    const testing::SizeLimit limit(header.size() + UndoLine().size() + room);
    try {
      journal.Append(RedoLine());
      ADD_FAILURE() << "no limit";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string() + ": cannot write it: "));
      EXPECT_THAT(error.what(), HasSubstr("; files may not grow so large here"));
    }
    EXPECT_EQ(FileText(path), header + UndoLine());
  }
  journal.Append(RedoLine());
  EXPECT_EQ(FileText(path), header + UndoLine() + RedoLine());
}

TEST(LabelJournal, SaysWhyItCannotBegin) {
  const fs::path dir = ScratchDir();
  const std::string header = JournalHeader(SomeStamp());
  EXPECT_THROW(LabelJournal(dir, 0, header), InputError);
  EXPECT_THROW(LabelJournal(dir / "none" / "journal", 0, header), InputError);
  EXPECT_THROW(LabelJournal("/dev/null", 0, header), InputError);
  const testing::SizeLimit limit(5);
  EXPECT_THROW(LabelJournal(dir / "journal", 0, header), InputError);
  EXPECT_EQ(FileText(dir / "journal"), "");
}

TEST(LabelJournal, NoticesThatItWasRemovedOrCut) {
  const fs::path path = ScratchDir() / "journal";
  {
    LabelJournal journal(path, 0, JournalHeader(SomeStamp()));
    fs::resize_file(path, 10);
    EXPECT_THROW(journal.Append(UndoLine()), InputError);
    EXPECT_EQ(fs::file_size(path), 10u);
  }
  LabelJournal journal(path, 0, JournalHeader(SomeStamp()));
  fs::remove(path);
  EXPECT_THROW(journal.Append(UndoLine()), InputError);
}

TEST(LabelJournal, AdvisesByWhatFailed) {
  EXPECT_EQ(WriteFailure("write it", ENOSPC),
            "cannot write it: No space left on device; make room on the disk");
  EXPECT_THAT(WriteFailure("write it", EROFS), HasSubstr("make the folder writable"));
  EXPECT_THAT(WriteFailure("write it", EDQUOT), HasSubstr("quota"));
  EXPECT_THAT(WriteFailure("write it", EIO), HasSubstr("save to another"));
}

}  // namespace
}  // namespace poselift
