// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/in_words.h"

#include <algorithm>

#include "src/joint_relation.h"
#include "src/translated.h"

namespace poselift {

std::string InWords(std::string_view name) {
  std::string words = Translated(std::string(name));
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string InWords(const LabelHint& hint) {
  const HintWords words = WordsOf(hint);
  const std::string first = InWords(words.first), second = InWords(words.second);
  return TranslatedFormat(words.english, fmt::make_format_args(first, second));
}

}  // namespace poselift
