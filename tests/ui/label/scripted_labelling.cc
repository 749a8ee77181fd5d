// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Labels by a script until it is killed, for the test that nothing is lost then:
//   poselift_scripted_labelling FILE LONGEST_JOURNAL SEED...
// Each seed is a step (TakeRandomStep), 0 saves. After each, when it is acknowledged, its number,
// from 0, is written to stdout as four bytes.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/support/random_labels.h"
#include "ui/label/label_project.h"

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  try {
    poselift::LabelProject::Options options;
    options.longest_journal = std::strtoull(argv[2], nullptr, 10);
    poselift::LabelProject project(argv[1], options);
    for (std::uint32_t i = 0; static_cast<int>(i) + 3 < argc; ++i) {
      const auto seed = static_cast<std::uint32_t>(std::strtoul(argv[i + 3], nullptr, 10));
      if (seed == 0)
        project.Save();
      else
        poselift::testing::TakeRandomStep(seed, &project);
      if (!project.unsaved_reason().empty()) return 1;
      if (::write(STDOUT_FILENO, &i, sizeof i) != sizeof i) return 1;
    }
    ::pause();  // the last of the steps is no reason to end well
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
