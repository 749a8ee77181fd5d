// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/tags.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace poselift::cli {

CLI::App* AddTags(CLI::App* app, Run* run) {
  CLI::App* tags =
      app->add_subcommand("tags", "AprilTags: print them, find them, fit where they sit on a body");
  tags->require_subcommand(1);
  constexpr std::array kCommands = {AddTagsPrint, AddTagsFind, AddTagsFit};
  auto commands = std::make_shared<std::vector<std::pair<CLI::App*, Run>>>(kCommands.size());
  for (size_t i = 0; i < kCommands.size(); ++i)
    (*commands)[i].first = kCommands[i](tags, &(*commands)[i].second);
  *run = [commands] {
    for (const auto& [command, run_it] : *commands)
      if (command->parsed()) return run_it();
    return kWrongUsage;
  };
  return tags;
}

}  // namespace poselift::cli
