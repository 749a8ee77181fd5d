// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/readers.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "src/input_error.h"
#include "tests/support/reader_tables.h"
#include "ui/cli/recognisers.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

void Describe(const fs::path& path, std::string_view head) {
  for (const cli::Recogniser& recogniser : cli::Recognisers())
    if (recogniser.is_it(path, head)) {
      using Json = nlohmann::ordered_json;
      recogniser.describe(path).dump(-1, ' ', false, Json::error_handler_t::replace);
      return;
    }
}

std::vector<Reader> AllReaders() {
  std::vector<Reader> all;
  for (const auto& some : {MotionReaders(), LabelReaders(), CameraAndTagReaders(), ModelReaders(),
                           PictureReaders(), WindowReaders()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

const std::vector<Reader>& Readers() {
  static const std::vector<Reader> kReaders = AllReaders();
  return kReaders;
}

std::string FlawOf(const Reader& reader, std::string_view bytes, const fs::path& dir) {
  const fs::path path = dir / reader.file;
  WriteBytes(path, bytes);
  std::string flaw = reader.read(path);
  try {
    Describe(path, bytes.substr(0, 4096));
  } catch (const InputError&) {  // what this reader reads may be none of info's
  }
  return flaw;
}

}  // namespace poselift::testing
