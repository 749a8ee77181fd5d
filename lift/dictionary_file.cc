// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/dictionary_file.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "lift/array_file.h"
#include "lift/dictionary_check.h"
#include "lift/dictionary_header.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr ArrayFileKind kKind = {.magic = "PLDICT\r\n",
                                 .version = 1,
                                 .what = "dictionary",
                                 .ending = ".pldict",
                                 .command = "poselift train"};
constexpr Eigen::Index kRows = 3 * kNumJoints;

}  // namespace

void WriteDictionary(const Dictionary& dictionary, const std::filesystem::path& path) {
  if (const std::string flaw = DictionaryFlaw(dictionary); !flaw.empty())
    throw std::invalid_argument("WriteDictionary: " + flaw);
  std::vector<NamedArray> arrays = {{"atoms", dictionary.atoms}};
  if (!dictionary.prior.Empty()) {
    arrays.emplace_back("prior_mean_m", dictionary.prior.mean_m);
    arrays.emplace_back("prior_whitening", dictionary.prior.whitening);
  }
  WriteArrayFile(kKind, DictionaryHeader(dictionary), arrays, path);
}

Dictionary ReadDictionary(const std::filesystem::path& path) {
  const ArrayFile file(kKind, path);
  Dictionary dictionary;
  ReadDictionaryHeader(file.Header(), &dictionary);
  dictionary.atoms = file.Read<double>("atoms", kRows, 0);
  if (file.Has("prior_mean_m") || file.Has("prior_whitening")) {
    dictionary.prior.mean_m = file.Read<double>("prior_mean_m", kRows, 1);
    dictionary.prior.whitening = file.Read<double>("prior_whitening", kRows, kRows);
  }
  if (const std::string flaw = DictionaryFlaw(dictionary); !flaw.empty())
    throw InputError(path, flaw);
  return dictionary;
}

}  // namespace poselift
