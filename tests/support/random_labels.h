// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "src/labels.h"
#include "ui/label/label_history.h"

namespace poselift::testing {

// Six frames of the layout body15; people with landmarks of every state in some.
Labels SomeLabels();

// Any of the edits that the labelling window makes, of these labels.
LabelEdit RandomEdit(const Labels& labels, std::mt19937* rng);

// All there is to labels, to the last bit, places of absent landmarks too.
std::string ExactText(const Labels& labels);
// All there is to a history: labels, steps, how many are in force.
std::string ExactText(const LabelHistory& history);

// An edit, an undo or a redo, as the seed has it.
template <typename HistoryOrProject>
void TakeRandomStep(std::uint32_t seed, HistoryOrProject* target) {
  std::mt19937 rng(seed);
  switch (rng() % 8) {
    case 0:
    case 1:
      target->Undo();
      return;
    case 2:
      target->Redo();
      return;
    default:
      target->Apply(RandomEdit(target->labels(), &rng));
  }
}

}  // namespace poselift::testing
