// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "ui/cli/command.h"

namespace poselift::cli {

// The tables of `poselift evaluate`.
CLI::App* AddEvaluateLift(CLI::App* evaluate, Run* run);
CLI::App* AddEvaluateMotion(CLI::App* evaluate, Run* run);
CLI::App* AddEvaluateSequence(CLI::App* evaluate, Run* run);
CLI::App* AddEvaluateTrack(CLI::App* evaluate, Run* run);

}  // namespace poselift::cli
