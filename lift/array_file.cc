// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/array_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "lift/model_header.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"

namespace poselift {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMagicBytes = 8;
constexpr size_t kMagicWord = 6;
constexpr size_t kHeaderBytesAt = kMagicBytes + sizeof(std::uint32_t);
constexpr size_t kFileBytesAt = kHeaderBytesAt + sizeof(std::uint64_t);
constexpr size_t kPrefixBytes = kFileBytesAt + sizeof(std::uint64_t);
constexpr size_t kChecksumBytes = sizeof(std::uint32_t);
constexpr size_t kAlignment = 64;
// Bounds the memory that the header of a hostile file takes.
constexpr size_t kLongestHeader = size_t{4} << 20;

std::string_view NameOf(NumberType type) {
  return type == NumberType::kFloat32 ? "float32" : "float64";
}

NumberType ReadNumberType(const JsonValue& value) {
  for (const NumberType type : {NumberType::kFloat32, NumberType::kFloat64})
    if (value.String() == NameOf(type)) return type;
  throw value.Unwanted("float32 or float64");
}

size_t BytesOf(NumberType type) {
  return type == NumberType::kFloat32 ? sizeof(float) : sizeof(double);
}

size_t Aligned(size_t offset) { return (offset + kAlignment - 1) / kAlignment * kAlignment; }

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
                     "files of learned models are little-endian and this machine is big-endian: "
                     "neither reading nor writing them is supported here");
}

void CheckKind(const ArrayFileKind& kind, std::string_view bytes, const std::string& file) {
  const std::string_view magic = bytes.substr(0, kMagicBytes);
  if (magic.starts_with(kind.magic.substr(0, kMagicWord)) && !kind.magic.starts_with(magic))
    throw InputError(file,
                     "is damaged: its line breaks were changed by a transfer as text; copy "
                     "it again as binary");
  if (!kind.magic.starts_with(magic))
    throw InputError(file, fmt::format("is no {}; wanted a {} file, as `{}` writes", kind.what,
                                       kind.ending, kind.command));
  if (bytes.size() < kPrefixBytes + kChecksumBytes)
    throw InputError(
        file, fmt::format("is cut short: found {} bytes; copy or train it again", bytes.size()));
  const auto version = ValueAt<std::uint32_t>(bytes, kMagicBytes);
  if (version > kind.version)
    throw InputError(file, fmt::format("has format version {}, wanted {}: it was written by a "
                                       "newer poselift; update this one",
                                       version, kind.version));
  if (version != kind.version)
    throw InputError(file, fmt::format("has format version {}, wanted {}", version, kind.version));
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

std::string_view Whole(const ArrayFileKind& kind, std::string_view bytes, const std::string& file) {
  RequireLittleEndianHost(file);
  CheckKind(kind, bytes, file);
  CheckWhole(bytes, file);
  return bytes;
}

std::string FileBytes(const ArrayFileKind& kind, Json header, const std::vector<NamedArray>& arrays,
                      const std::string& file) {
  std::vector<size_t> offsets;
  size_t end = 0;
  header["arrays"] = Json::object();
  for (const NamedArray& array : arrays) {
    offsets.push_back(Aligned(end));
    end = offsets.back() + array.bytes.size();
    header["arrays"][array.name] = {{"type", NameOf(array.type)},
                                    {"rows", array.rows},
                                    {"cols", array.cols},
                                    {"offset", offsets.back()}};
  }
  const std::string text = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kLongestHeader)
    throw InputError(file, fmt::format("the header would have {} bytes, wanted at most {}: the "
                                       "training record names too much",
                                       text.size(), kLongestHeader));
  const size_t arrays_begin = Aligned(kPrefixBytes + text.size());
  std::string bytes(kind.magic);
  bytes.reserve(arrays_begin + end + kChecksumBytes);
  Append(kind.version, &bytes);
  Append(std::uint64_t{text.size()}, &bytes);
  Append(std::uint64_t{arrays_begin + end + kChecksumBytes}, &bytes);
  bytes += text;
  bytes.resize(arrays_begin);
  for (size_t i = 0; i < arrays.size(); ++i) {
    bytes.resize(arrays_begin + offsets[i]);
    bytes += arrays[i].bytes;
  }
  Append(Checksum(bytes), &bytes);
  return bytes;
}

}  // namespace

void WriteArrayFile(const ArrayFileKind& kind, Json header, const std::vector<NamedArray>& arrays,
                    const std::filesystem::path& path) {
  RequireLittleEndianHost(path);
  WriteFileAtomically(path, FileBytes(kind, std::move(header), arrays, path));
}

ArrayFile::ArrayFile(const ArrayFileKind& kind, const std::filesystem::path& path)
    : file_(path),
      mapped_(path),
      arrays_(Split(Whole(kind, mapped_.Bytes(), file_), file_).arrays),
      header_(Split(mapped_.Bytes(), file_).header, file_ + " (header)") {
  ReadTable();
}

void ArrayFile::ReadTable() {
  const JsonValue& table = Header().At("arrays");
  for (size_t i = 0; i < table.Members().size(); ++i) {
    const JsonValue& row = table.Members()[i];
    table_.push_back({table.Keys()[i], ReadNumberType(row.At("type")), ReadWhole(row.At("rows")),
                      ReadWhole(row.At("cols")),
                      static_cast<std::uint64_t>(ReadLargeWhole(row.At("offset")))});
  }
}

const ArrayFile::Entry* ArrayFile::Find(std::string_view name) const {
  const auto found = std::find_if(table_.begin(), table_.end(),
                                  [&](const Entry& entry) { return entry.name == name; });
  return found == table_.end() ? nullptr : &*found;
}

const ArrayFile::Entry& ArrayFile::Checked(std::string_view name, NumberType type,
                                           Eigen::Index rows, Eigen::Index cols) const {
  const Entry* const array = Find(name);
  if (array == nullptr) throw InputError(file_, fmt::format("has no array {}", name));
  if (array->type != type)
    throw InputError(file_, fmt::format("has an array {} of {}, wanted {}", name,
                                        NameOf(array->type), NameOf(type)));
  if (array->rows != rows || array->cols == 0 || (cols != 0 && array->cols != cols))
    throw InputError(file_,
                     fmt::format("has an array {} of {} x {}, wanted {} x {}", name, array->rows,
                                 array->cols, rows, cols == 0 ? "any" : std::to_string(cols)));
  const size_t size = static_cast<size_t>(array->rows * array->cols) * BytesOf(type);
  if (array->offset % kAlignment != 0 || size > arrays_.size() ||
      array->offset > arrays_.size() - size)
    throw InputError(file_, fmt::format("has an array {} at byte {}, wanted a multiple of {} "
                                        "that leaves room for {} bytes within {}",
                                        name, array->offset, kAlignment, size, arrays_.size()));
  return *array;
}

template <typename Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> ArrayFile::Read(std::string_view name,
                                                                      Eigen::Index rows,
                                                                      Eigen::Index cols) const {
  constexpr auto kType =
      std::is_same_v<Scalar, float> ? NumberType::kFloat32 : NumberType::kFloat64;
  const Entry& array = Checked(name, kType, rows, cols);
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> values(array.rows, array.cols);
  std::memcpy(values.data(), arrays_.data() + array.offset,
              static_cast<size_t>(values.size()) * sizeof(Scalar));
  return values;
}

template Eigen::MatrixXf ArrayFile::Read<float>(std::string_view, Eigen::Index, Eigen::Index) const;
template Eigen::MatrixXd ArrayFile::Read<double>(std::string_view, Eigen::Index,
                                                 Eigen::Index) const;

}  // namespace poselift
