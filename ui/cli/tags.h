// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "ui/cli/command.h"

namespace poselift::cli {

// Commands of `tags`, one file each.
CLI::App* AddTagsPrint(CLI::App* tags, Run* run);
CLI::App* AddTagsFind(CLI::App* tags, Run* run);
CLI::App* AddTagsFit(CLI::App* tags, Run* run);

}  // namespace poselift::cli
