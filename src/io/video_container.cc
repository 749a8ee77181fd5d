// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/video_container.h"

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <string_view>

namespace poselift {
namespace {

constexpr int kMostBoxes = 100000;  // of one file, on its outermost level

class Bytes {
 public:
  explicit Bytes(const std::filesystem::path& path) : file_(path, std::ios::binary) {
    size_ = std::filesystem::file_size(path);
  }
  uint64_t size() const { return size_; }

  // 16 bytes from there, zeros behind the end.
  std::array<unsigned char, 16> At(uint64_t offset) {
    std::array<unsigned char, 16> bytes{};
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    return bytes;
  }

 private:
  std::ifstream file_;
  uint64_t size_ = 0;
};

uint64_t BigEndian(const unsigned char* bytes, int count) {
  uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

uint64_t LittleEndian(const unsigned char* bytes, int count) {
  uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i) value = value << 8 | bytes[i];
  return value;
}

bool Has(const unsigned char* bytes, std::string_view text) {
  return std::memcmp(bytes, text.data(), text.size()) == 0;
}

uint64_t Beyond(uint64_t begin, uint64_t size, uint64_t file_size) {
  const uint64_t left = file_size - begin;
  return size > left ? size - left : 0;
}

// Boxes: u32 size, type; size 1: u64 behind the type; size 0: to the end.
uint64_t MissingOfMp4(Bytes* file) {
  uint64_t begin = 0;
  for (int i = 0; i < kMostBoxes && begin + 8 <= file->size(); ++i) {
    const auto head = file->At(begin);
    uint64_t size = BigEndian(head.data(), 4);
    if (size == 1) size = BigEndian(head.data() + 8, 8);
    if (size < 8) return 0;
    if (const uint64_t missing = Beyond(begin, size, file->size())) return missing;
    begin += size;
  }
  return 0;
}

// Chunks "RIFF", u32 size of what follows; 0 while it is being recorded.
uint64_t MissingOfAvi(Bytes* file) {
  uint64_t begin = 0;
  for (int i = 0; i < kMostBoxes && begin + 12 <= file->size(); ++i) {
    const auto head = file->At(begin);
    const uint64_t size = LittleEndian(head.data() + 4, 4);
    if (!Has(head.data(), "RIFF") || size == 0) return 0;
    if (const uint64_t missing = Beyond(begin, size + 8, file->size())) return missing;
    begin += 8 + size + size % 2;
  }
  return 0;
}

struct ElementSize {
  uint64_t value = 0;
  int length = 1;
  bool known = false;  // all ones: until the next one of its level
};

// 1 to 8 bytes; as many zero bits lead as there are further bytes.
ElementSize ReadElementSize(const unsigned char* bytes) {
  const int length = std::countl_zero(bytes[0]) + 1;
  if (length > 8) return {};
  const uint64_t all_ones = (uint64_t{1} << 7 * length) - 1;
  const uint64_t value = BigEndian(bytes, length) & all_ones;
  return {value, length, value != all_ones};
}

// Two elements on the outermost level: the EBML head and the segment.
uint64_t MissingOfMatroska(Bytes* file) {
  const ElementSize ebml = ReadElementSize(file->At(4).data());
  const uint64_t segment = 4 + static_cast<uint64_t>(ebml.length) + ebml.value;
  if (!ebml.known || segment >= file->size()) return 0;
  const auto head = file->At(segment);
  const ElementSize size = ReadElementSize(head.data() + 4);
  if (!Has(head.data(), "\x18\x53\x80\x67") || !size.known) return 0;
  const uint64_t body = segment + 4 + static_cast<uint64_t>(size.length);
  return body > file->size() ? size.value : Beyond(body, size.value, file->size());
}

}  // namespace

uint64_t MissingBytes(const std::filesystem::path& path) {
  Bytes file(path);
  const auto head = file.At(0);
  constexpr std::string_view kFirstBoxes[] = {"ftyp", "moov", "mdat", "wide", "free", "skip"};
  for (const std::string_view type : kFirstBoxes)
    if (Has(head.data() + 4, type)) return MissingOfMp4(&file);
  if (Has(head.data(), "RIFF") && Has(head.data() + 8, "AVI ")) return MissingOfAvi(&file);
  if (Has(head.data(), "\x1a\x45\xdf\xa3")) return MissingOfMatroska(&file);
  return 0;
}

}  // namespace poselift
