// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string_view>

namespace poselift {

// The whole of a TOML file. wanted: what it should be, for the error. Throws InputError with
// file:line for what is no TOML and for more than 48 dots in a line that is no comment.
toml::table ReadToml(const std::filesystem::path& path, std::string_view wanted);

}  // namespace poselift
