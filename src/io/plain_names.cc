// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/plain_names.h"

#include <string_view>
#include <unordered_set>

#include "src/io/text_scanner.h"

namespace poselift {
namespace {

bool IsLetterOrUnderscore(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool IsPlain(char c) {
  return IsLetterOrUnderscore(c) || (c >= '0' && c <= '9') ||
         std::string_view("-.:").find(c) != std::string_view::npos;
}

std::string Plain(std::string_view name) {
  std::string plain;
  for (const char c : name) plain += IsPlain(c) ? c : '_';
  const bool is_keyword = EqualsIgnoringCase(plain, "begin") || EqualsIgnoringCase(plain, "end");
  const bool needs_prefix = plain.empty() || !IsLetterOrUnderscore(plain[0]) || is_keyword;
  return needs_prefix ? std::string(1, '_').append(plain) : plain;
}

std::string Lower(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

}  // namespace

std::vector<std::string> PlainNames(const Skeleton& skeleton, const std::string& root_name) {
  std::vector<std::string> names;
  std::unordered_set<std::string> taken;
  for (const Bone& bone : skeleton.bones) {
    const std::string plain = names.empty() && !root_name.empty() ? root_name : Plain(bone.name);
    std::string name = plain;
    for (int n = 2; !taken.insert(Lower(name)).second; ++n) name = plain + "_" + std::to_string(n);
    names.push_back(name);
  }
  return names;
}

}  // namespace poselift
