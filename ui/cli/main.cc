// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "src/input_error.h"
#include "ui/cli/command.h"

namespace {

using poselift::cli::Run;
using AddCommand = CLI::App* (*)(CLI::App*, Run*);

constexpr std::array kCommands = {
    AddCommand{poselift::cli::AddConvert},   AddCommand{poselift::cli::AddInfo},
    AddCommand{poselift::cli::AddLift},      AddCommand{poselift::cli::AddTrain},
    AddCommand{poselift::cli::AddEvaluate},  AddCommand{poselift::cli::AddSmooth},
    AddCommand{poselift::cli::AddPlot},      AddCommand{poselift::cli::AddDoctor},
    AddCommand{poselift::cli::AddCalibrate}, AddCommand{poselift::cli::AddTrack},
    AddCommand{poselift::cli::AddTags},
};

int RunGuarded(const Run& run) {
  try {
    return run();
  } catch (const poselift::InputError& error) {
    std::fprintf(stderr, "poselift: %s\n", error.what());
    return poselift::cli::kUnreadableInput;
  } catch (const std::filesystem::filesystem_error& error) {
    // A folder without permission, or a file where a folder is wanted.
    std::fprintf(stderr, "poselift: %s: %s\n", error.path1().c_str(),
                 error.code().message().c_str());
    return poselift::cli::kUnreadableInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "poselift: %s\n", error.what());
    return poselift::cli::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"poselift: from labelled pictures of a body to its 3D skeleton"};
  app.set_version_flag("--version", POSELIFT_VERSION);
  app.require_subcommand(1);
  std::array<Run, kCommands.size()> runs;
  std::array<CLI::App*, kCommands.size()> commands{};
  for (size_t i = 0; i < kCommands.size(); ++i) commands[i] = kCommands[i](&app, &runs[i]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? poselift::cli::kDone : poselift::cli::kWrongUsage;
  }
  for (size_t i = 0; i < kCommands.size(); ++i)
    if (commands[i]->parsed()) return RunGuarded(runs[i]);
  return poselift::cli::kWrongUsage;
}
