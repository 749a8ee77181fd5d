// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/evaluate.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <memory>

namespace poselift::cli {

CLI::App* AddEvaluate(CLI::App* app, Run* run) {
  struct Table {
    CLI::App* command;
    Run run;
  };
  auto tables = std::make_shared<std::array<Table, 4>>();
  CLI::App* command = app->add_subcommand("evaluate", "Make a table of docs/RESULTS.md");
  command->require_subcommand(1);
  (*tables)[0].command = AddEvaluateLift(command, &(*tables)[0].run);
  (*tables)[1].command = AddEvaluateMotion(command, &(*tables)[1].run);
  (*tables)[2].command = AddEvaluateSequence(command, &(*tables)[2].run);
  (*tables)[3].command = AddEvaluateTrack(command, &(*tables)[3].run);
  *run = [tables] {
    for (const Table& table : *tables)
      if (table.command->parsed()) return table.run();
    return kWrongUsage;
  };
  return command;
}

}  // namespace poselift::cli
