// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/dictionary_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "lift/dictionary_check.h"
#include "lift/dictionary_header.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/mapped_file.h"

namespace poselift {
namespace {

// The line break shows what a transfer as text does to a file.
constexpr std::string_view kMagic = "PLDICT\r\n";
constexpr size_t kMagicWord = 6;
constexpr std::uint32_t kVersion = 1;
constexpr size_t kHeaderBytesAt = kMagic.size() + sizeof(std::uint32_t);
constexpr size_t kFileBytesAt = kHeaderBytesAt + sizeof(std::uint64_t);
constexpr size_t kPrefixBytes = kFileBytesAt + sizeof(std::uint64_t);
constexpr size_t kChecksumBytes = sizeof(std::uint32_t);
constexpr size_t kAlignment = 64;
// Bounds the memory that the header of a hostile file takes.
constexpr size_t kLongestHeader = size_t{4} << 20;
constexpr Eigen::Index kRows = 3 * kNumJoints;

struct NamedMatrix {
  const char* name;
  Eigen::Map<const Eigen::MatrixXd> values;
};

std::vector<NamedMatrix> MatricesOf(const Dictionary& dictionary) {
  const auto named = [](const char* name, const auto& matrix) {
    return NamedMatrix{name, {matrix.data(), matrix.rows(), matrix.cols()}};
  };
  std::vector<NamedMatrix> matrices = {named("atoms", dictionary.atoms)};
  if (dictionary.prior.Empty()) return matrices;
  matrices.push_back(named("prior_mean_m", dictionary.prior.mean_m));
  matrices.push_back(named("prior_whitening", dictionary.prior.whitening));
  return matrices;
}

size_t Aligned(size_t offset) { return (offset + kAlignment - 1) / kAlignment * kAlignment; }

size_t NumBytes(Eigen::Index num_values) {
  return static_cast<size_t>(num_values) * sizeof(double);
}

std::uint32_t Checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

template <typename T>
void Append(const T& value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
T ValueAt(std::string_view bytes, size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

void RequireLittleEndianHost(const std::filesystem::path& path) {
  if constexpr (std::endian::native != std::endian::little)
    throw InputError(path,
                     "dictionary files are little-endian and this machine is big-endian: "
                     "neither reading nor writing them is supported here");
}

std::string DictionaryBytes(const Dictionary& dictionary, const std::string& file) {
  const std::vector<NamedMatrix> matrices = MatricesOf(dictionary);
  std::vector<StoredArray> table;
  size_t end = 0;
  for (const NamedMatrix& matrix : matrices) {
    const size_t offset = Aligned(end);
    table.push_back({matrix.name, matrix.values.rows(), matrix.values.cols(), offset});
    end = offset + NumBytes(matrix.values.size());
  }
  const std::string header = DictionaryHeaderText(dictionary, table);
  if (header.size() > kLongestHeader)
    throw InputError(file, fmt::format("the header would have {} bytes, wanted at most {}: the "
                                       "training record names too much",
                                       header.size(), kLongestHeader));
  const size_t arrays_begin = Aligned(kPrefixBytes + header.size());
  std::string bytes(kMagic);
  bytes.reserve(arrays_begin + end + kChecksumBytes);
  Append(kVersion, &bytes);
  Append(std::uint64_t{header.size()}, &bytes);
  Append(std::uint64_t{arrays_begin + end + kChecksumBytes}, &bytes);
  bytes += header;
  for (size_t i = 0; i < matrices.size(); ++i) {
    bytes.resize(arrays_begin + table[i].offset);
    bytes.append(reinterpret_cast<const char*>(matrices[i].values.data()),
                 NumBytes(matrices[i].values.size()));
  }
  Append(Checksum(bytes), &bytes);
  return bytes;
}

void CheckKind(std::string_view bytes, const std::string& file) {
  const std::string_view magic = bytes.substr(0, kMagic.size());
  if (magic.starts_with(kMagic.substr(0, kMagicWord)) && !kMagic.starts_with(magic))
    throw InputError(file,
                     "is damaged: its line breaks were changed by a transfer as text; copy "
                     "it again as binary");
  if (!kMagic.starts_with(magic))
    throw InputError(file, "is no dictionary; wanted a .pldict file, as `poselift train` writes");
  if (bytes.size() < kPrefixBytes + kChecksumBytes)
    throw InputError(
        file, fmt::format("is cut short: found {} bytes; copy or train it again", bytes.size()));
  const auto version = ValueAt<std::uint32_t>(bytes, kMagic.size());
  if (version > kVersion)
    throw InputError(file, fmt::format("has format version {}, wanted {}: it was written by a "
                                       "newer poselift; update this one",
                                       version, kVersion));
  if (version != kVersion)
    throw InputError(file, fmt::format("has format version {}, wanted {}", version, kVersion));
}

void CheckWhole(std::string_view bytes, const std::string& file) {
  const auto wanted = ValueAt<std::uint64_t>(bytes, kFileBytesAt);
  if (bytes.size() != wanted)
    throw InputError(file, fmt::format("{}: found {} bytes, wanted {}; copy or train it again",
                                       bytes.size() < wanted ? "is cut short" : "is altered",
                                       bytes.size(), wanted));
  const size_t end = bytes.size() - kChecksumBytes;
  if (Checksum(bytes.substr(0, end)) != ValueAt<std::uint32_t>(bytes, end))
    throw InputError(file, "is altered: its checksum differs; copy or train it again");
}

struct Sections {
  std::string_view header;
  std::string_view arrays;
};

Sections Split(std::string_view bytes, const std::string& file) {
  const std::string_view content = bytes.substr(0, bytes.size() - kChecksumBytes);
  const auto header_bytes = ValueAt<std::uint64_t>(bytes, kHeaderBytesAt);
  const size_t most = std::min(kLongestHeader, content.size() - kPrefixBytes);
  if (header_bytes > most)
    throw InputError(
        file, fmt::format("has a header of {} bytes, wanted at most {}", header_bytes, most));
  const size_t arrays_begin = std::min(Aligned(kPrefixBytes + header_bytes), content.size());
  return {content.substr(kPrefixBytes, header_bytes), content.substr(arrays_begin)};
}

class ArrayReader {
 public:
  ArrayReader(std::string_view bytes, std::vector<StoredArray> table, const std::string& file)
      : bytes_(bytes), table_(std::move(table)), file_(file) {}

  bool Has(std::string_view name) const { return Find(name) != table_.end(); }

  // cols: 0 for any number from 1.
  Eigen::MatrixXd Read(std::string_view name, Eigen::Index rows, Eigen::Index cols) const {
    const auto array = Find(name);
    if (array == table_.end()) throw InputError(file_, fmt::format("has no array {}", name));
    if (array->rows != rows || array->cols == 0 || (cols != 0 && array->cols != cols))
      throw InputError(file_,
                       fmt::format("has an array {} of {} x {}, wanted {} x {}", name, array->rows,
                                   array->cols, rows, cols == 0 ? "any" : std::to_string(cols)));
    const size_t size = NumBytes(array->rows * array->cols);
    if (array->offset % kAlignment != 0 || size > bytes_.size() ||
        array->offset > bytes_.size() - size)
      throw InputError(file_, fmt::format("has an array {} at byte {}, wanted a multiple of {} "
                                          "that leaves room for {} bytes within {}",
                                          name, array->offset, kAlignment, size, bytes_.size()));
    Eigen::MatrixXd values(array->rows, array->cols);
    std::memcpy(values.data(), bytes_.data() + array->offset, size);
    return values;
  }

 private:
  std::vector<StoredArray>::const_iterator Find(std::string_view name) const {
    return std::find_if(table_.begin(), table_.end(),
                        [&](const StoredArray& array) { return array.name == name; });
  }

  std::string_view bytes_;
  std::vector<StoredArray> table_;
  const std::string& file_;
};

}  // namespace

void WriteDictionary(const Dictionary& dictionary, const std::filesystem::path& path) {
  RequireLittleEndianHost(path);
  if (const std::string flaw = DictionaryFlaw(dictionary); !flaw.empty())
    throw std::invalid_argument("WriteDictionary: " + flaw);
  WriteFileAtomically(path, DictionaryBytes(dictionary, path));
}

Dictionary ReadDictionary(const std::filesystem::path& path) {
  RequireLittleEndianHost(path);
  const std::string file = path;
  const MappedFile mapped(path);
  CheckKind(mapped.Bytes(), file);
  CheckWhole(mapped.Bytes(), file);
  const Sections sections = Split(mapped.Bytes(), file);
  Dictionary dictionary;
  const ArrayReader arrays(sections.arrays,
                           ParseDictionaryHeader(sections.header, file + " (header)", &dictionary),
                           file);
  dictionary.atoms = arrays.Read("atoms", kRows, 0);
  if (arrays.Has("prior_mean_m") || arrays.Has("prior_whitening")) {
    dictionary.prior.mean_m = arrays.Read("prior_mean_m", kRows, 1);
    dictionary.prior.whitening = arrays.Read("prior_whitening", kRows, kRows);
  }
  if (const std::string flaw = DictionaryFlaw(dictionary); !flaw.empty())
    throw InputError(file, flaw);
  return dictionary;
}

}  // namespace poselift
