// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// `poselift label` where there is no window to start: a copy of the program, alone in a folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

TEST(LabelProgram, SaysWhatToInstallWhereThereIsNoWindow) {
  const fs::path folder = testing::ScratchDir();
  fs::copy_file(POSELIFT_PROGRAM, folder / "poselift", fs::copy_options::overwrite_existing);
  const std::string command =
      "cd '" + folder.string() + "' && PATH=/nowhere ./poselift label a.jpg 2>err";
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c): our own words
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(testing::FileText(folder / "err"), ::testing::HasSubstr("apt install qt6-base-dev"));
}

// A script in the window's place writes down what it is given.
TEST(LabelProgram, PassesDevicesAndOptionsThrough) {
  const fs::path folder = testing::ScratchDir();
  fs::copy_file(POSELIFT_PROGRAM, folder / "poselift", fs::copy_options::overwrite_existing);
  testing::WriteScratch("poselift-label", "#!/bin/sh\nprintf '%s|' \"$@\"\n");
  fs::permissions(folder / "poselift-label", fs::perms::owner_all);
  const std::string command =
      "cd '" + folder.string() +
      "' && ./poselift label /dev/video0 --camera 'my cam.yaml' --tags tags.toml >out";
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c): our own words
  EXPECT_EQ(testing::FileText(folder / "out"),
            "/dev/video0|--camera|my cam.yaml|--tags|tags.toml|");
}

}  // namespace
}  // namespace poselift
