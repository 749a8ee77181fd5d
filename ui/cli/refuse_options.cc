// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/refuse_options.h"

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>

namespace poselift::cli {

void RefuseOptions(const CLI::App& command, std::initializer_list<const char*> names,
                   const std::string& why) {
  for (const char* const name : names)
    if (command.count(name) > 0) throw CLI::ValidationError(name, "says nothing here: " + why);
}

}  // namespace poselift::cli
