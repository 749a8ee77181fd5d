// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <initializer_list>
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the name of CLI11
class App;
}

namespace poselift::cli {

// For callbacks of commands: options that say nothing beside what else was said are wrong usage,
// not passed over. Throws CLI::ValidationError, "--family: why", for the first that was given.
void RefuseOptions(const CLI::App& command, std::initializer_list<const char*> names,
                   const std::string& why);

}  // namespace poselift::cli
