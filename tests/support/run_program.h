// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

namespace poselift::testing {

struct ProgramRun {
  int code = -1;   // exit code; -1 when a signal ended it
  int signal = 0;  // the signal that did
  std::string out;
  std::string err;
  double peak_memory_mib = 0.0;
};

enum class RunAs { kMe, kNobody };

// Runs the built poselift in the scratch folder, as a user would there, without
// input. arguments: words between blanks. A program that hangs is killed after
// a minute: signal 9. Nothing but what the program writes is left in the folder.
ProgramRun RunProgram(const std::string& arguments, RunAs user = RunAs::kMe);

// Whether RunAs::kNobody works: only root can change the user, and that user
// must be able to start the program.
bool CanRunAsNobody();

}  // namespace poselift::testing
