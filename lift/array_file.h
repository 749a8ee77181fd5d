// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "src/io/json_value.h"
#include "src/io/mapped_file.h"

namespace poselift {

// What the files of learned models are, little-endian; docs/FORMATS.md has it all:
//
//   8 bytes of magic  u32 version  u64 header bytes  u64 file bytes
//   JSON header, with a table of the arrays
//   arrays, each at a multiple of 64 bytes, column by column
//   u32 CRC-32 of all bytes before it
//
// What is read is, to the last bit, what was written (strings: when they are
// UTF-8). The same input gives the same bytes.
struct ArrayFileKind {
  std::string_view magic;  // ends in a line break, to show what a transfer as text does to it
  std::uint32_t version;
  // For messages: "dictionary", ".pldict", "poselift train".
  std::string_view what;
  std::string_view ending;
  std::string_view command;
};

enum class NumberType { kFloat32, kFloat64 };

// A matrix to write; it must outlive this.
struct NamedArray {
  template <typename Scalar, int Rows, int Cols>
  NamedArray(const char* array_name, const Eigen::Matrix<Scalar, Rows, Cols>& matrix)
      : name(array_name),
        type(std::is_same_v<Scalar, float> ? NumberType::kFloat32 : NumberType::kFloat64),
        rows(matrix.rows()),
        cols(matrix.cols()),
        bytes(reinterpret_cast<const char*>(matrix.data()),
              static_cast<size_t>(matrix.size()) * sizeof(Scalar)) {
    static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>);
  }

  const char* name;
  NumberType type;
  Eigen::Index rows;
  Eigen::Index cols;
  std::string_view bytes;
};

// header: an object; "arrays" is put behind what it has. Written as
// WriteFileAtomically does. Throws InputError when the file cannot be written.
void WriteArrayFile(const ArrayFileKind& kind, nlohmann::ordered_json header,
                    const std::vector<NamedArray>& arrays, const std::filesystem::path& path);

// A file that was mapped and found whole. Throws InputError that says what is
// wrong: of another kind, of a newer version, cut short, altered, with a header
// that is no JSON or has no table of arrays.
class ArrayFile {
 public:
  ArrayFile(const ArrayFileKind& kind, const std::filesystem::path& path);

  const JsonValue& Header() const { return header_.root(); }
  bool Has(std::string_view name) const { return Find(name) != nullptr; }

  // Throws InputError when the array is not there, of another type or size, or
  // beyond the end of the file. cols: 0 for any number from 1.
  template <typename Scalar>
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> Read(std::string_view name,
                                                             Eigen::Index rows,
                                                             Eigen::Index cols) const;

 private:
  struct Entry {
    std::string name;
    NumberType type = NumberType::kFloat64;
    Eigen::Index rows = 0;
    Eigen::Index cols = 0;
    std::uint64_t offset = 0;  // bytes from the first array's place
  };

  void ReadTable();
  const Entry* Find(std::string_view name) const;
  const Entry& Checked(std::string_view name, NumberType type, Eigen::Index rows,
                       Eigen::Index cols) const;

  std::string file_;
  MappedFile mapped_;
  std::string_view arrays_;
  JsonDocument header_;
  std::vector<Entry> table_;
};

}  // namespace poselift
