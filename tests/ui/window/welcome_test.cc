// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/welcome.h"

#include <gtest/gtest.h>

#include <QPushButton>
#include <QStandardPaths>
#include <QTest>

#include "src/input_error.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::FileText;

TEST(Welcome, ThereIsASampleToTry) {
  ASSERT_FALSE(SamplePicture().empty());
  Welcome welcome(SamplePicture());
  EXPECT_NE(welcome.findChild<QPushButton*>("try_sample"), nullptr);
  EXPECT_EQ(Welcome(fs::path()).findChild<QPushButton*>("try_sample"), nullptr);
}

TEST(Welcome, TheSampleIsCopiedOnceAndItsCopyKept) {
  const fs::path folder = testing::ScratchDir() / "new" / "samples";
  fs::remove_all(folder);
  const fs::path copy = CopyOfSample(SamplePicture(), folder);
  EXPECT_EQ(FileText(copy), FileText(SamplePicture()));
  testing::WriteScratch("new/samples/kick.jpg", "mine");
  EXPECT_EQ(CopyOfSample(SamplePicture(), folder), copy);
  EXPECT_EQ(FileText(copy), "mine");
  EXPECT_THROW(CopyOfSample(SamplePicture(), "/dev/null/x"), InputError);
}

TEST(Welcome, TheButtonGivesACopy) {
  QStandardPaths::setTestModeEnabled(true);
  qputenv("HOME", testing::ScratchDir().string().c_str());
  Welcome welcome(SamplePicture());
  QTest::mouseClick(welcome.findChild<QPushButton*>("try_sample"), Qt::LeftButton);
  ASSERT_EQ(welcome.inputs().size(), 1U);
  EXPECT_EQ(fs::path(welcome.inputs()[0]).filename(), "kick.jpg");
  EXPECT_TRUE(fs::exists(welcome.inputs()[0]));
}

}  // namespace
}  // namespace poselift
