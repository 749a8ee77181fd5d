// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <functional>

namespace CLI {  // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace poselift::cli {

// Exit codes that scripts rely on.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kUnreadableInput = 3;

// A command adds its subcommand and options to the app and returns what runs
// it: parse, read, call one function of the library, write; returns an exit
// code. InputError is caught in main.
using Run = std::function<int()>;

// One file a command.
CLI::App* AddCalibrate(CLI::App* app, Run* run);
CLI::App* AddConvert(CLI::App* app, Run* run);
CLI::App* AddInfo(CLI::App* app, Run* run);
CLI::App* AddLabel(CLI::App* app, Run* run);
CLI::App* AddLift(CLI::App* app, Run* run);
CLI::App* AddPlot(CLI::App* app, Run* run);
CLI::App* AddSmooth(CLI::App* app, Run* run);
CLI::App* AddTags(CLI::App* app, Run* run);
CLI::App* AddTrain(CLI::App* app, Run* run);
CLI::App* AddEvaluate(CLI::App* app, Run* run);
CLI::App* AddTrack(CLI::App* app, Run* run);
CLI::App* AddDoctor(CLI::App* app, Run* run);

}  // namespace poselift::cli
