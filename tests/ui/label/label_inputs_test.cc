// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample pictures, in a folder of their own.
#include "ui/label/label_inputs.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "src/input_error.h"
#include "tests/support/reader_tables.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

class LabelInputsTest : public ::testing::Test {
 protected:
  LabelInputsTest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void AddSample(const std::string& name, const std::string& as) const {
    fs::copy_file(testing::SourcePath("samples/photo/" + name), folder_ / as);
  }
  std::vector<std::string> ImagesAfterAdding(const std::string& input) const {
    LabelProject project(File());
    AddNewPictures({input}, &project);
    std::vector<std::string> images;
    for (const FrameLabels& frame : project.labels().frames) images.push_back(frame.image);
    return images;
  }
  fs::path File() const { return FindLabelsFile({folder_.string()}, "", "body15"); }

  const fs::path folder_ = testing::ScratchDir() / "pictures";
};

TEST_F(LabelInputsTest, NewPicturesOfAFolderComeBehindTheOthersAsOneStep) {
  AddSample("kick.jpg", "b.jpg");
  const std::string folder = folder_.string();
  EXPECT_EQ(ImagesAfterAdding(folder), (std::vector<std::string>{"b.jpg"}));
  AddSample("reach.jpg", "a.jpg");
  AddSample("throw.jpg", "c.jpg");
  const std::vector<std::string> all = {"b.jpg", "a.jpg", "c.jpg"};
  EXPECT_EQ(ImagesAfterAdding(folder), all);
  LabelProject again(File());
  EXPECT_EQ(again.labels().frames.size(), 3U);
  EXPECT_GT(again.labels().frames[2].width_px, 0);
  AddNewPictures({folder}, &again);
  EXPECT_EQ(again.history().NumSteps(), 1U);
  EXPECT_TRUE(again.Undo());
  EXPECT_EQ(again.labels().frames.size(), 1U);
}

TEST_F(LabelInputsTest, APictureThatWasMovedIsNoNewOne) {
  AddSample("kick.jpg", "kick.jpg");
  File();
  fs::create_directories(folder_ / "there");
  fs::rename(folder_ / "kick.jpg", folder_ / "there" / "kick.jpg");
  const std::string moved = (folder_ / "there" / "kick.jpg").string();
  LabelProject project(folder_ / "labels.json");
  AddNewPictures({moved}, &project);
  EXPECT_EQ(project.labels().frames.size(), 1U);
}

TEST_F(LabelInputsTest, WhatCannotBeReadIsLeftOutAndTold) {
  AddSample("kick.jpg", "kick.jpg");
  File();
  testing::WriteBytes(folder_ / "a.jpg", "no picture");
  AddSample("reach.jpg", "b.jpg");
  LabelProject project(File());
  AddNewPictures({folder_.string()}, &project);
  ASSERT_EQ(project.labels().frames.size(), 2U);
  EXPECT_EQ(project.labels().frames[1].image, "b.jpg");
  ASSERT_EQ(project.messages().size(), 1U);
  EXPECT_NE(project.messages()[0].find("a.jpg"), std::string::npos);
}

TEST_F(LabelInputsTest, WhatIsOnlyLookedAtIsNotTouched) {
  AddSample("kick.jpg", "kick.jpg");
  const fs::path file = File();
  const auto num_files = [&] {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  };
  const auto before = num_files();
  LabelProject project(file, {.read_only = true});
  EXPECT_TRUE(project.read_only());
  EXPECT_TRUE(project.messages().empty());
  LabelEdit edit{.name = "add", .people = {{0, {{.id = 0}}}}};
  EXPECT_THROW(project.Apply(edit), InputError);
  EXPECT_THROW(project.Save(), InputError);
  EXPECT_EQ(num_files(), before);
}

}  // namespace
}  // namespace poselift
