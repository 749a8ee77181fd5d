// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: key files by hand. Checked: what they change and what is refused.
#include "ui/label/key_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "src/input_error.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::WriteScratch;

TEST(KeyMap, EachActionHasADescriptionAndKeysOfItsOwn) {
  const KeyMap map;
  std::set<std::pair<std::string, bool>> keys;
  for (const ActionInfo& info : Actions()) {
    EXPECT_EQ(&InfoOf(info.action), &info) << info.name;
    EXPECT_STRNE(info.description, "") << info.name;
    EXPECT_FALSE(map.Keys(info.action).empty()) << info.name;
    for (const std::string& key : map.Keys(info.action))
      EXPECT_TRUE(keys.emplace(key, info.is_live).second) << key;
  }
}

TEST(KeyMap, AFileChangesWhatItNames) {
  const KeyMap map = KeyMap::Read(WriteScratch(
      "keys.toml", "swap_sides = 'R'\ncycle_state = ['O', 'W']\nhelp = []\nfreeze = 'S'\n"));
  EXPECT_THAT(map.Keys(Action::kSwapSides), ElementsAre("R"));
  EXPECT_THAT(map.Keys(Action::kCycleState), ElementsAre("O", "W"));
  EXPECT_THAT(map.Keys(Action::kHelp), IsEmpty());
  EXPECT_THAT(map.Keys(Action::kFreeze), ElementsAre("S"));
  EXPECT_THAT(map.Keys(Action::kSave), ElementsAre("Ctrl+S"));
}

TEST(KeyMap, DefaultsGiveWay) {
  const KeyMap map = KeyMap::Read(WriteScratch("keys.toml", "swap_sides = 'O'\nfreeze = 'R'\n"));
  EXPECT_THAT(map.Keys(Action::kSwapSides), ElementsAre("O"));
  EXPECT_THAT(map.Keys(Action::kCycleState), IsEmpty());
  EXPECT_THAT(map.Keys(Action::kRecord), IsEmpty());
  EXPECT_THAT(map.Keys(Action::kNextFrame), ElementsAre("Right", "D"));
}

TEST(KeyMap, WhatIsWrongIsRefusedByItsLine) {
  for (const auto& [text, wanted] :
       {std::pair{"\nfly = 'F'\n", "keys.toml:2: found 'fly'"},
        {"save = 3\n", "keys.toml:1: found no text"},
        {"save = 'O'\nundo = 'O'\n", "found 'O' for save and undo"},
        {"freeze = 'R'\nrecord = 'R'\n", "found 'R' for freeze and record"}}) {
    try {
      KeyMap::Read(WriteScratch("keys.toml", text));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace poselift
