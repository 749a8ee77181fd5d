// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>

namespace poselift {

// How English texts for people become those of their language. Set once, before there are threads;
// until then they stay as they are.
using TranslateFn = std::function<std::string(const char* english)>;
void TranslateBy(TranslateFn translate);

std::string Translated(const std::string& english);  // a text without values

// Marks a text of a table, which is translated by Translated where it is shown.
constexpr const char* ToTranslate(const char* english) { return english; }
std::string TranslatedFormat(fmt::string_view english, fmt::format_args values);

// A text with values: translated is the format ("pose {} of {}", fmt's), not what it comes to. A
// translation that does not take the values gives the English text.
template <typename... Values>
std::string Translated(fmt::format_string<Values...> english,
                       Values&&... values) requires(sizeof...(Values) > 0) {
  return TranslatedFormat(english, fmt::make_format_args(values...));
}

}  // namespace poselift
