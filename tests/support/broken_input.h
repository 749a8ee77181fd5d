// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace poselift::testing {

// A file that the program must refuse.
struct BrokenFile {
  std::string what;  // "truncated"
  std::string content;
  std::string mention;  // what the message says behind the file's name: ":3", "empty"
};

// What is wrong with any file, whatever its kind: empty, binary, UTF-16, a
// picture's bytes. `mention` is empty.
const std::vector<BrokenFile>& BrokenInEveryFormat();

// Runs the program, and expects one refusal as a user should see it: exit code 3, exactly one line
// on stderr that begins with "poselift: " and has `mention`, nothing on stdout,
// no signal, not much memory, and no file in the folder that was not there.
void ExpectRefusal(const std::string& arguments, const std::string& mention,
                   RunAs user = RunAs::kMe);

// For each command: it succeeds on `whole`, and refuses each broken content, what
// is broken in every format, a directory and no file at all. {} in a command is
// the name `file`, under which all of them stand in the scratch folder.
void ExpectRefusals(const std::string& file, const std::string& whole,
                    const std::vector<std::string>& commands, std::vector<BrokenFile> broken);

// `whole` with the first `old` replaced; fails the running test when there is none.
std::string Replaced(std::string whole, const std::string& old, const std::string& with);

}  // namespace poselift::testing
