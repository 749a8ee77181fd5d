// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "ui/cli/command.h"

namespace poselift::cli {
namespace {

// The window is a program of its own, for this one is to run without Qt: beside this one, or
// where the shell finds it. Returns only when there is none.
int StartWindow(std::vector<std::string> arguments) {
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  std::vector<char*> argv;
  std::string name = "poselift-label";
  argv.push_back(name.data());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv((self.parent_path() / name).c_str(), argv.data());
  ::execvp(name.c_str(), argv.data());
  std::fprintf(stderr,
               "poselift: found no poselift-label, wanted it beside poselift or in the PATH: "
               "apt install qt6-base-dev, then build poselift again\n");
  return kFailed;
}

}  // namespace

CLI::App* AddLabel(CLI::App* app, Run* run) {
  CLI::App* command = app->add_subcommand(
      "label",
      "Label joints in a window: the pose answers; a camera is watched, and frozen to be labelled");
  command->footer(
      "Examples:\n  poselift label skier.jpg\n  poselift label --pose hero.labels.json\n  poselift "
      "label /dev/video0 --camera cam.yaml --tags "
      "tags.toml");
  command->prefix_command();
  command->set_help_flag();
  *run = [command] { return StartWindow(command->remaining()); };
  return command;
}

}  // namespace poselift::cli
