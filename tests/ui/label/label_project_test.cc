// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: projects in files, locks, full and read-only places. Made up: the labels. Properties: what
// was done is there after opening again, with every step back; a file that somebody else changed is
// taken, and nothing is overwritten; what cannot be written is said before and goes in later.
#include "ui/label/label_project.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "src/input_error.h"
#include "src/io/labels.h"
#include "tests/support/mutation.h"
#include "tests/support/random_labels.h"
#include "tests/support/size_limit.h"
#include "tests/support/support.h"
#include "ui/label/label_edits.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ExactText;
using testing::FileText;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ScratchDir;
using testing::SomeLabels;

// A labels file by itself in a new folder.
fs::path NewFile() {
  const fs::path dir = ScratchDir() / "project";
  fs::remove_all(dir);
  fs::create_directories(dir);
  CreateLabelsFile(dir / "walk.json", SomeLabels());
  return dir / "walk.json";
}

fs::path JournalOf(const fs::path& file) {
  return file.parent_path() / ("." + file.filename().string() + ".journal");
}

void Write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

LabelEdit Place(const LabelProject& project, const char* landmark) {
  return PlaceLandmark(project.labels(), {0, 0}, landmark, {3.25, 4.5});
}

std::string OnlyMessage(const LabelProject& project) {
  EXPECT_EQ(project.messages().size(), 1u);
  return project.messages().empty() ? "" : project.messages()[0];
}

TEST(LabelProject, ComesBackWithEveryStepSavedOrNot) {
  EXPECT_TRUE(rc::check([] {
    const auto seeds = *rc::gen::resize(8, rc::gen::container<std::vector<std::uint32_t>>(
                                               rc::gen::inRange<std::uint32_t>(0, 1 << 30)));
    const fs::path file = NewFile();
    std::string expected = ExactText(LabelHistory(SomeLabels()));
    for (const std::uint32_t seed : seeds) {
      LabelProject project(file);
      RC_ASSERT(ExactText(project.history()) == expected);
      testing::TakeRandomStep(seed, &project);
      testing::TakeRandomStep(seed / 3, &project);
      if (seed % 3 == 0) project.Save();
      if (seed % 5 == 0) testing::TakeRandomStep(seed / 5, &project);
      RC_ASSERT(project.unsaved_reason().empty());
      expected = ExactText(project.history());
    }
    LabelProject project(file);
    while (project.Undo()) {
    }
    RC_ASSERT(ExactText(project.labels()) == ExactText(SomeLabels()));
  }));
}

TEST(LabelProject, KnowsWhetherItIsSavedAlsoLater) {
  const fs::path file = NewFile();
  {
    LabelProject project(file);
    EXPECT_TRUE(project.IsSaved());
    EXPECT_THAT(project.messages(), IsEmpty());
    project.Apply(Place(project, "left_knee"));
    project.Save();
    EXPECT_TRUE(project.IsSaved());
    EXPECT_EQ(FileText(file), LabelsText(project.labels()));
  }
  {
    LabelProject project(file);
    EXPECT_TRUE(project.IsSaved());
    EXPECT_EQ(project.history().UndoName(), "place left knee");
    project.Undo();
    EXPECT_FALSE(project.IsSaved());
  }
  LabelProject project(file);
  EXPECT_THAT(OnlyMessage(project), HasSubstr("not saved to the file are back"));
  EXPECT_FALSE(project.IsSaved());
  project.Redo();
  EXPECT_TRUE(project.IsSaved());
}

TEST(LabelProject, LeavesNothingBesideAFileThatWasOnlyLookedAt) {
  const fs::path file = NewFile();
  { const LabelProject project(file); }
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

TEST(LabelProject, TheSecondWindowLooksOnly) {
  const fs::path file = NewFile();
  const fs::path link = file.parent_path() / "link.json";
  fs::create_symlink("walk.json", link);
  {
    LabelProject first(file);
    first.Apply(Place(first, "left_knee"));
    LabelProject second(link);
    EXPECT_TRUE(second.read_only());
    EXPECT_FALSE(first.read_only());
    EXPECT_THAT(second.messages().back(), HasSubstr(std::to_string(::getpid())));
    EXPECT_EQ(ExactText(second.labels()), ExactText(first.labels()));
    EXPECT_THROW(second.Apply(Place(second, "left_hip")), InputError);
    EXPECT_THROW(second.Undo(), InputError);
    EXPECT_THROW(second.Save(), InputError);
    EXPECT_EQ(ExactText(second.labels()), ExactText(first.labels()));
    first.Apply(Place(first, "right_knee"));
    EXPECT_EQ(first.unsaved_reason(), "");
  }
  LabelProject third(file);
  EXPECT_FALSE(third.read_only());
  EXPECT_EQ(third.history().NumSteps(), 2u);
}

TEST(LabelProject, TakesAFileThatSomebodyChangedAndKeepsTheJournal) {
  const fs::path file = NewFile();
  Labels other = SomeLabels();
  other.frames.pop_back();
  for (int i = 1; i <= 12; ++i) {
    {
      LabelProject project(file);
      project.Apply(Place(project, i % 2 == 0 ? "left_knee" : "right_knee"));
    }
    const std::string journal = FileText(JournalOf(file));
    other.frames[0].image = std::to_string(i);
    WriteLabels(other, file);
    const std::string text = FileText(file);
    LabelProject project(file);
    EXPECT_EQ(ExactText(project.labels()), ExactText(other));
    EXPECT_FALSE(project.history().CanUndo());
    EXPECT_TRUE(project.IsSaved());
    EXPECT_THAT(project.messages()[0], HasSubstr("continues another version of the file"));
    EXPECT_EQ(FileText(file), text);
    // Ten are kept; then the oldest makes room.
    if (i <= 10) {
      EXPECT_EQ(FileText(JournalOf(file).string() + "." + std::to_string(i)), journal);
    }
    EXPECT_THAT(project.messages()[1], HasSubstr("was kept as " + JournalOf(file).string() + "."));
  }
  EXPECT_FALSE(fs::exists(JournalOf(file).string() + ".11"));
}

TEST(LabelProject, SavingKeepsAVersionThatSomebodyWroteMeanwhile) {
  const fs::path file = NewFile();
  LabelProject project(file);
  project.Apply(Place(project, "left_knee"));
  Write(file, "theirs");
  Write(file.string() + ".1", "older");
  project.Save();
  EXPECT_EQ(FileText(file.string() + ".2"), "theirs");
  EXPECT_EQ(FileText(file.string() + ".1"), "older");
  EXPECT_EQ(FileText(file), LabelsText(project.labels()));
  EXPECT_THAT(OnlyMessage(project), HasSubstr("changed by another program"));
}

TEST(LabelProject, OpensWhereASaveWasCutShort) {
  const fs::path file = NewFile();
  std::string before_save, text;
  {
    LabelProject project(file);
    project.Apply(Place(project, "left_knee"));
    before_save = FileText(JournalOf(file));
    text = LabelsText(project.labels());
  }
  for (const bool was_renamed : {false, true}) {
    Write(JournalOf(file), before_save + SavingLine(StampOf(text)));
    if (was_renamed) Write(file, text);
    LabelProject project(file);
    EXPECT_EQ(project.history().UndoName(), "place left knee");
    EXPECT_EQ(project.IsSaved(), was_renamed);
  }
}

TEST(LabelProject, ADamagedJournalCountsUpToTheDamageAndIsKept) {
  const fs::path file = NewFile();
  {
    LabelProject project(file);
    project.Apply(Place(project, "left_knee"));
  }
  const std::string whole = FileText(JournalOf(file));
  Write(JournalOf(file), whole + "?\n" + UndoLine());
  LabelProject project(file);
  EXPECT_EQ(project.history().UndoName(), "place left knee");
  EXPECT_THAT(project.messages()[1], HasSubstr(".journal:3: no valid JSON"));
  EXPECT_EQ(FileText(JournalOf(file)), whole);
  EXPECT_EQ(FileText(JournalOf(file).string() + ".1"), whole + "?\n" + UndoLine());
}

TEST(LabelProject, SurvivesJournalsOfAnyKind) {
  std::mt19937_64 rng = testing::TestRng();
  const fs::path file = NewFile();
  {
    LabelProject project(file);
    for (std::uint32_t seed = 1; seed < 6; ++seed) testing::TakeRandomStep(seed, &project);
    project.Save();
    testing::TakeRandomStep(9, &project);
  }
  const std::string whole = FileText(JournalOf(file)), text = FileText(file);
  for (const std::string& damaged : testing::DamagedCopies(whole, 20, &rng)) {
    Write(JournalOf(file), damaged);
    LabelProject project(file);
    EXPECT_EQ(project.unsaved_reason(), "");
    EXPECT_EQ(FileText(file), text);
    project.Apply(AddPerson(project.labels(), {0, 77}));
    EXPECT_EQ(project.unsaved_reason(), "");
  }
}

TEST(LabelProject, AFolderInTheJournalsPlaceMakesRoom) {
  const fs::path file = NewFile();
  fs::create_directories(JournalOf(file) / "full");
  LabelProject project(file);
  project.Apply(Place(project, "left_knee"));
  EXPECT_EQ(project.unsaved_reason(), "");
  EXPECT_TRUE(fs::exists(JournalOf(file).string() + ".1/full"));
}

TEST(LabelProject, ARemovedJournalIsSaidAndSavingMakesANewOne) {
  const fs::path file = NewFile();
  {
    LabelProject project(file);
    project.Apply(Place(project, "left_knee"));
    fs::remove(JournalOf(file));
    project.Apply(Place(project, "right_knee"));
    EXPECT_THAT(project.unsaved_reason(), HasSubstr("removed or cut"));
    project.Save();
    EXPECT_EQ(project.unsaved_reason(), "");
    project.Apply(Place(project, "left_hip"));
  }
  LabelProject project(file);
  EXPECT_EQ(project.history().NumSteps(), 3u);
}

TEST(LabelProject, AFullDiskIsSaidAndItsStepsGoInLater) {
  const fs::path file = NewFile();
  std::string expected;
  {
    LabelProject project(file);
    project.Apply(Place(project, "left_knee"));
    {
      const testing::SizeLimit limit(fs::file_size(JournalOf(file)) + 20);
      project.Apply(Place(project, "right_knee"));
      EXPECT_THAT(project.unsaved_reason(), HasSubstr("cannot write it"));
      EXPECT_THAT(project.unsaved_reason(), HasSubstr("in memory only"));
      project.Undo();
      project.Redo();
      EXPECT_EQ(project.history().NumSteps(), 2u);
      EXPECT_EQ(LabelProject(file).history().NumSteps(), 1u);  // whole, without them
    }
    project.Apply(Place(project, "left_hip"));
    EXPECT_EQ(project.unsaved_reason(), "");
    expected = ExactText(project.history());
  }
  EXPECT_EQ(ExactText(LabelProject(file).history()), expected);
}

TEST(LabelProject, AFailedSaveLosesNothing) {
  const fs::path file = NewFile();
  const std::string old_text = FileText(file);
  {
    LabelProject project(file);
    project.Apply(Place(project, "left_knee"));
    {
      const testing::SizeLimit limit(100);
      EXPECT_THROW(project.Save(), InputError);
    }
    EXPECT_FALSE(project.IsSaved());
    EXPECT_EQ(FileText(file), old_text);
  }
  LabelProject project(file);
  EXPECT_EQ(project.history().UndoName(), "place left knee");
  project.Save();
  EXPECT_EQ(FileText(file), LabelsText(project.labels()));
}

TEST(LabelProject, ARealFullDiskToo) {
  const fs::path disk = ScratchDir() / "disk";
  fs::create_directories(disk);
  if (::mount("none", disk.c_str(), "tmpfs", 0, "size=256k") != 0)
    GTEST_SKIP() << "cannot mount a small disk here";
  {
    CreateLabelsFile(disk / "walk.json", SomeLabels());
    LabelProject project(disk / "walk.json");
    project.Apply(Place(project, "left_knee"));
    std::ofstream filler(disk / "filler", std::ios::binary);
    while (filler.put('x').flush()) {
    }
    for (int i = 0; i < 40; ++i) project.Apply(Place(project, "right_knee"));
    EXPECT_THAT(project.unsaved_reason(), HasSubstr("make room on the disk"));
    EXPECT_THROW(project.Save(), InputError);
    fs::remove(disk / "filler");
    filler.close();
    project.Undo();
    EXPECT_EQ(project.unsaved_reason(), "");
  }
  EXPECT_EQ(LabelProject(disk / "walk.json").history().NumSteps(), 40u);
  EXPECT_EQ(::umount(disk.c_str()), 0);
}

TEST(LabelProject, AReadOnlyFolderIsSaidAtOnce) {
  const fs::path file = NewFile();
  fs::permissions(file.parent_path(), fs::perms(0555));
  fs::permissions(file, fs::perms(0444));
  const bool was_root = ::geteuid() == 0;
  if (was_root) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const bool can_look = ::access(file.c_str(), R_OK) == 0;
  {
    std::optional<LabelProject> project;
    if (std::ifstream(file).good()) project.emplace(file);
    if (project) {
      EXPECT_THAT(project->unsaved_reason(), HasSubstr("make the folder writable"));
      EXPECT_FALSE(project->read_only());
      project->Apply(Place(*project, "left_knee"));
      EXPECT_THROW(project->Save(), InputError);
      EXPECT_EQ(project->history().NumSteps(), 1u);
    }
    if (was_root) {
      ASSERT_EQ(::seteuid(0), 0);
    }
    fs::permissions(file.parent_path(), fs::perms(0755));
    fs::permissions(file, fs::perms(0644));
    if (!project) GTEST_SKIP() << "another user cannot look here: " << can_look;
    project->Sync();
    EXPECT_EQ(project->unsaved_reason(), "");
  }
  EXPECT_EQ(LabelProject(file).history().UndoName(), "place left knee");
}

// It is nowhere but in the file when no step is left that says it.
TEST(LabelProject, WhatIsAbsentKeepsItsPlaceBeyondTheJournal) {
  const fs::path file = NewFile();
  LabelProject::Options options;
  options.longest_journal = 1;
  {
    LabelProject project(file, options);
    project.Apply(Place(project, "left_knee"));
    project.Apply(SetLandmarkState(project.labels(), {0, 0}, "left_knee", LabelState::kAbsent));
    project.Save();
  }
  LabelProject project(file, options);
  EXPECT_EQ(project.history().NumSteps(), 0u);
  project.Apply(CycleLandmarkState(project.labels(), {0, 0}, "left_knee"));
  const LandmarkLabel* knee = FindLandmark(project.labels(), {0, 0}, "left_knee");
  EXPECT_EQ(knee->state, LabelState::kVisible);
  EXPECT_FALSE(knee->x_px.isZero());
}

TEST(LabelProject, ALongJournalIsShortenedOnSaving) {
  const fs::path file = NewFile();
  LabelProject::Options options;
  options.longest_journal = 8000;
  std::string expected;
  {
    LabelProject project(file, options);
    for (std::uint32_t seed = 1; seed < 200; ++seed) {
      testing::TakeRandomStep(seed, &project);
      if (seed % 10 != 0) continue;
      project.Save();
      EXPECT_LT(fs::file_size(JournalOf(file)), 8200u);
    }
    while (project.Redo()) {
    }
    expected = ExactText(project.labels());
    EXPECT_EQ(project.unsaved_reason(), "");
  }
  LabelProject project(file, options);
  EXPECT_EQ(ExactText(project.labels()), expected);
  EXPECT_TRUE(project.history().CanUndo());
}

TEST(LabelProject, NeverCreatesOverAFile) {
  const fs::path file = NewFile();
  const std::string text = FileText(file);
  EXPECT_THROW(CreateLabelsFile(file, SomeLabels()), InputError);
  EXPECT_EQ(FileText(file), text);
  Labels unknown = SomeLabels();
  unknown.layout = "octopus";
  EXPECT_THROW(CreateLabelsFile(file.parent_path() / "new.json", unknown), InputError);
  EXPECT_FALSE(fs::exists(file.parent_path() / "new.json"));
}

TEST(LabelProject, RefusesWhatIsNoLabelsFileAndLeavesNothing) {
  const fs::path dir = ScratchDir() / "other";
  fs::create_directories(dir);
  Write(dir / "empty.json", "");
  Write(dir / "coco.json", R"({"images": [], "annotations": [], "categories": []})");
  for (const char* name : {"empty.json", "coco.json", "absent.json", "."})
    EXPECT_THROW(LabelProject{dir / name}, InputError) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), {}), 2);
}

TEST(LabelProject, FindsPicturesThatMovedAsOneStep) {
  const fs::path file = NewFile();
  const fs::path moved = ScratchDir() / "moved";
  fs::create_directories(moved / "pictures");
  for (const char* name : {"pictures/0.jpg", "3.jpg"}) Write(moved / name, "");
  std::string relinked;
  {
    LabelProject project(file);
    EXPECT_EQ(FramesWithoutImage(project.labels(), project.dir()).size(), 6u);
    EXPECT_EQ(project.Relink(moved), 2u);
    EXPECT_EQ(FramesWithoutImage(project.labels(), project.dir()).size(), 4u);
    EXPECT_EQ(project.labels().frames[0].image, "../moved/pictures/0.jpg");
    EXPECT_EQ(project.labels().frames[3].image, "../moved/3.jpg");
    EXPECT_EQ(project.history().UndoName(), "look for pictures in moved");
    EXPECT_EQ(project.Relink(moved), 0u);
    EXPECT_EQ(project.history().NumSteps(), 1u);
    relinked = ExactText(project.labels());
  }
  LabelProject project(file);
  EXPECT_EQ(ExactText(project.labels()), relinked);
  project.Undo();
  EXPECT_EQ(ExactText(project.labels()), ExactText(SomeLabels()));
}

TEST(LabelRelink, TwoPicturesNeverBecomeOne) {
  const fs::path dir = ScratchDir();
  Write(dir / "1.jpg", "");
  Labels labels{"body15", {FrameLabels(), FrameLabels(), FrameLabels()}};
  labels.frames[0].image = "left/1.jpg";
  labels.frames[1].image = "right/1.jpg";
  EXPECT_TRUE(RelinkImages(labels, dir / "away", dir).ChangesNothing());
  labels.frames[1].image = "left/1.jpg";  // a video: its frames share it
  EXPECT_EQ(RelinkImages(labels, dir / "away", dir).images.size(), 2u);
}

TEST(LabelRelink, PathsFollowTheLabelsFileToAnotherFolder) {
  Labels labels{"body15", {FrameLabels(), FrameLabels(), FrameLabels()}};
  labels.frames[0].image = "a.jpg";
  labels.frames[1].image = "/x/b.jpg";
  labels = WithImagesFrom(labels, "/p/q", "/p/r");
  EXPECT_EQ(labels.frames[0].image, "../q/a.jpg");
  EXPECT_EQ(labels.frames[1].image, "/x/b.jpg");
  EXPECT_EQ(labels.frames[2].image, "");
}

}  // namespace
}  // namespace poselift
