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

struct ModelNames {
  const char* what;
  const char* variable;
  const char* file;
  const char* way_out;  // how else to have one
};

const ModelNames& NamesOf(DefaultModel model) {
  static constexpr ModelNames kDictionary = {
      "default dictionary", "POSELIFT_DICTIONARY", "default.pldict",
      "name one with POSELIFT_DICTIONARY or --dictionary, or train one with `poselift train`"};
  static constexpr ModelNames kMotion = {
      "default motion model", "POSELIFT_MOTION_MODEL", "default.plmotion",
      "name one with POSELIFT_MOTION_MODEL, or train one with `poselift train --motion`"};
  return model == DefaultModel::kDictionary ? kDictionary : kMotion;
}

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

fs::path DefaultModelPath(DefaultModel model) {
  const char* const variable = NamesOf(model).variable;
  const char* const named = std::getenv(variable);
  if (named == nullptr || *named == '\0')
    return FirstModelOf(model, DefaultModelPlaces(model, RunningProgram()));
  if (!IsFile(named))
    throw InputError(named, std::string("no such file, and the environment variable ") + variable +
                                " names it; correct or unset it");
  return named;
}

}  // namespace

fs::path DefaultDictionaryPath() { return DefaultModelPath(DefaultModel::kDictionary); }

fs::path DefaultMotionModelPath() { return DefaultModelPath(DefaultModel::kMotion); }

std::vector<fs::path> DefaultModelPlaces(DefaultModel model, const fs::path& program) {
  const char* const file = NamesOf(model).file;
  std::vector<fs::path> places;
  if (!program.empty()) {
    const fs::path data_dir = program.parent_path() / POSELIFT_DATA_FROM_PROGRAM;
    places.push_back(data_dir.lexically_normal() / "poselift" / file);
  }
  std::error_code ignored;
  if (IsInside(program, fs::weakly_canonical(POSELIFT_BUILD_DIR, ignored)))
    places.push_back(fs::path(POSELIFT_SOURCE_DATA_DIR) / file);
  places.push_back(fs::path(POSELIFT_INSTALLED_DATA_DIR) / "poselift" / file);
  return places;
}

fs::path FirstModelOf(DefaultModel model, const std::vector<fs::path>& places) {
  const auto found = std::find_if(places.begin(), places.end(), IsFile);
  if (found != places.end()) return *found;
  const ModelNames& names = NamesOf(model);
  std::string message = std::string("found no ") + names.what + "; looked for";
  for (const fs::path& place : places) message += "\n  " + place.string();
  throw InputError(message + "\ninstall one there, " + names.way_out);
}

}  // namespace poselift
