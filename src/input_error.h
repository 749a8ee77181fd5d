// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <stdexcept>
#include <string>

namespace poselift {

// What is wrong with something the user gave: a file, a device, an option.
// The text says where, what was found, what was wanted and what to do:
//   walk.amc:17: found "lfemur 1 2", wanted 3 values (rx ry rz); ...
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const std::string& file, const std::string& message)
      : std::runtime_error(file + ": " + message) {}
  // line counts from 1.
  InputError(const std::string& file, int line, const std::string& message)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + message) {}
};

}  // namespace poselift
