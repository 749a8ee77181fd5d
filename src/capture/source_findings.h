// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "src/capture/source_facts.h"

namespace poselift {

// What could be better, the gravest first.
struct Finding {
  enum class Weight { kProblem, kAdvice, kNote };
  Weight weight = Weight::kNote;
  std::string what;   // "gives 14.9 pictures a second, 30 were stated"
  std::string why;    // why it matters
  std::string to_do;  // empty where nothing is to be done
};

// Of what a camera offers, without looking at its pictures.
std::vector<Finding> JudgeFormats(const std::vector<CameraFormat>& formats,
                                  const CameraMode& wanted);

// Of a source that was watched; those of its formats are among them.
std::vector<Finding> JudgeSource(const SourceFacts& facts);

}  // namespace poselift
