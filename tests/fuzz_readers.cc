// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// One reader under libFuzzer, which damages what it reads and keeps what reaches new code:
//   POSELIFT_READER=bvh poselift_fuzz -max_total_time=60 CORPUS
// A folder CORPUS gets a file to start from. Whatever the bytes, the reader refuses them by
// InputError or keeps its header's promises. Without a reader named: the names of all.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "src/input_error.h"
#include "tests/support/readers.h"

namespace {

namespace fs = std::filesystem;
using poselift::testing::Reader;
using poselift::testing::Readers;

const Reader* Wanted() {
  const char* const name = std::getenv("POSELIFT_READER");
  for (const Reader& reader : Readers())
    if (name && reader.name == name) return &reader;
  return nullptr;
}

const fs::path& Folder() {
  static const fs::path dir = [] {
    const fs::path made = fs::temp_directory_path() / ("poselift_fuzz." + Wanted()->name);
    fs::create_directories(made);
    return made;
  }();
  return dir;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* num_arguments, char*** arguments) {
  if (!Wanted()) {
    for (const Reader& reader : Readers()) std::printf("%s\n", reader.name.c_str());
    std::exit(0);
  }
  const fs::path corpus = (*arguments)[*num_arguments - 1];
  if (fs::is_directory(corpus))
    std::ofstream(corpus / "whole", std::ios::binary) << Wanted()->whole(Folder());
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const Reader& reader = *Wanted();
  try {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::string flaw = poselift::testing::FlawOf(reader, bytes, Folder());
    if (flaw.empty()) return 0;
    std::fprintf(stderr, "%s: %s\n", reader.name.c_str(), flaw.c_str());
  } catch (const poselift::InputError&) {
    return 0;
  }
  std::abort();
}
