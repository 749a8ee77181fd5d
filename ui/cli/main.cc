// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "lift/quiet_solver.h"
#include "src/input_error.h"
#include "src/nearest_names.h"
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
    AddCommand{poselift::cli::AddTags},      AddCommand{poselift::cli::AddLabel},
};

// Of words that stand where a command is wanted and are none: the nearest there is.
std::string UnknownCommand(const CLI::App& app, int argc, char** argv) {
  const CLI::App* at = &app;
  std::string command = "poselift";
  for (int i = 1; i < argc; ++i) {
    const auto commands = at->get_subcommands([](const CLI::App*) { return true; });
    const std::string word = argv[i];
    if (commands.empty() || word.starts_with('-')) return "";
    std::vector<std::string> names;
    const CLI::App* next = nullptr;
    for (const CLI::App* other : commands) {
      names.push_back(other->get_name());
      if (names.back() == word) next = other;
    }
    if (!next)
      return "poselift: found no command \"" + word + "\", wanted perhaps: " + command + " " +
             poselift::NearestNames(word, names, 1).front() + "; all of them: " + command +
             " --help\n";
    at = next;
    command += " " + word;
  }
  return "";
}

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
  poselift::QuietSolver();
  CLI::App app{"poselift: from labelled pictures of a body to its 3D skeleton"};
  app.set_version_flag("--version", POSELIFT_VERSION);
  app.require_subcommand(1);
  std::array<Run, kCommands.size()> runs;
  std::array<CLI::App*, kCommands.size()> commands{};
  for (size_t i = 0; i < kCommands.size(); ++i) commands[i] = kCommands[i](&app, &runs[i]);
  if (const std::string flaw = UnknownCommand(app, argc, argv); !flaw.empty()) {
    std::fputs(flaw.c_str(), stderr);
    return poselift::cli::kWrongUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? poselift::cli::kDone : poselift::cli::kWrongUsage;
  }
  for (size_t i = 0; i < kCommands.size(); ++i)
    if (commands[i]->parsed()) return RunGuarded(runs[i]);
  return poselift::cli::kWrongUsage;
}
