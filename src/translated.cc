// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/translated.h"

#include <utility>

namespace poselift {
namespace {

TranslateFn& Translation() {
  static TranslateFn translation;
  return translation;
}

}  // namespace

void TranslateBy(TranslateFn translate) { Translation() = std::move(translate); }

std::string Translated(const std::string& english) {
  return Translation() ? Translation()(english.c_str()) : english;
}

std::string TranslatedFormat(fmt::string_view english, fmt::format_args values) {
  try {
    return fmt::vformat(Translated(std::string(english.data(), english.size())), values);
  } catch (const fmt::format_error&) {
    return fmt::vformat(english, values);
  }
}

}  // namespace poselift
