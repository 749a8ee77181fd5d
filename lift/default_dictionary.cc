// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/default_dictionary.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <system_error>

#include "src/input_error.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "POSELIFT_DICTIONARY";
constexpr const char* kFileName = "default.pldict";

bool IsFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool IsInside(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

fs::path RunningProgram() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored);
}

}  // namespace

std::vector<fs::path> DefaultDictionaryPlaces(const fs::path& program) {
  std::vector<fs::path> places;
  if (!program.empty()) {
    const fs::path data_dir = program.parent_path() / POSELIFT_DATA_FROM_PROGRAM;
    places.push_back(data_dir.lexically_normal() / "poselift" / kFileName);
  }
  std::error_code ignored;
  if (IsInside(program, fs::weakly_canonical(POSELIFT_BUILD_DIR, ignored)))
    places.push_back(fs::path(POSELIFT_SOURCE_DATA_DIR) / kFileName);
  places.push_back(fs::path(POSELIFT_INSTALLED_DATA_DIR) / "poselift" / kFileName);
  return places;
}

fs::path FirstDictionaryOf(const std::vector<fs::path>& places) {
  const auto found = std::find_if(places.begin(), places.end(), IsFile);
  if (found != places.end()) return *found;
  std::string message = "found no default dictionary; looked for";
  for (const fs::path& place : places) message += "\n  " + place.string();
  throw InputError(message + "\ninstall one there, name one with " + kVariable +
                   " or --dictionary, or train one with `poselift train`");
}

fs::path DefaultDictionaryPath() {
  const char* const named = std::getenv(kVariable);
  if (named == nullptr || *named == '\0')
    return FirstDictionaryOf(DefaultDictionaryPlaces(RunningProgram()));
  if (!IsFile(named))
    throw InputError(named, std::string("no such file, and the environment variable ") + kVariable +
                                " names it; correct or unset it");
  return named;
}

}  // namespace poselift
