// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/reader_tables.h"

#include <zlib.h>
#include <cstring>

#include "lift/dictionary_check.h"
#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "tests/support/random_codebook.h"
#include "tests/support/random_dictionary.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

// With the size and the checksum of what is there now.
void Seal(const fs::path& path) {
  constexpr size_t kFileBytesAt = 20, kSize = sizeof(uint64_t), kChecksum = sizeof(uint32_t);
  std::string bytes = FileText(path);
  if (bytes.size() < kFileBytesAt + kSize + kChecksum) return;
  const uint64_t num_bytes = bytes.size();
  std::memcpy(bytes.data() + kFileBytesAt, &num_bytes, kSize);
  bytes.resize(bytes.size() - kChecksum);
  const auto checksum =
      static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  bytes.append(reinterpret_cast<const char*>(&checksum), kChecksum);
  WriteBytes(path, bytes);
}

std::string ReadsDictionary(const fs::path& path) {
  Seal(path);
  return DictionaryFlaw(ReadDictionary(path));
}

std::string ReadsCodebook(const fs::path& path) {
  Seal(path);
  const MotionCodebook codebook = ReadMotionCodebook(path);
  const AccelerationModels& models = codebook.accelerations;
  const bool finite = codebook.segments.allFinite() && codebook.rates.allFinite() &&
                      codebook.deviations.allFinite() && models.means.allFinite() &&
                      models.directions.allFinite() && models.responses.allFinite() &&
                      models.deviations.allFinite();
  return finite ? "" : "numbers that are not finite";
}

}  // namespace

std::vector<Reader> ModelReaders() {
  return {
      {"dictionary", "a.pldict",
       Written("whole.pldict",
               [](const fs::path& path) {
                 std::mt19937_64 rng(1);
                 WriteDictionary(RandomDictionary(2, &rng), path);
               }),
       ReadsDictionary},
      {"codebook", "a.plmotion",
       Written("whole.plmotion",
               [](const fs::path& path) {
                 WriteMotionCodebook(RandomCodebook(1, std::mt19937_64(1)), path);
               }),
       ReadsCodebook},
  };
}

}  // namespace poselift::testing
