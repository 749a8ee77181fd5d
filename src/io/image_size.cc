// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/image_size.h"

#include <array>
#include <cctype>
#include <cstdlib>

namespace poselift {
namespace {

using namespace std::string_view_literals;

// Unsigned numbers in the file's byte order; zero beyond its end.
struct Bytes {
  std::string_view text;
  bool is_little_endian;

  uint64_t At(size_t offset, size_t count) const {
    if (offset > text.size() || count > text.size() - offset) return 0;
    uint64_t value = 0;
    for (size_t i = 0; i < count; ++i) {
      const size_t k = is_little_endian ? count - 1 - i : i;
      value = value << 8 | static_cast<uint8_t>(text[offset + k]);
    }
    return value;
  }
  int64_t Signed(size_t offset, size_t count) const {
    return static_cast<int64_t>(At(offset, count));
  }
};

// Walks the segments to the start of a frame (SOF): 8 bits precision, height, width.
StoredImageSize JpegSize(std::string_view text) {
  const Bytes bytes{text, false};
  for (size_t at = 2; at + 4 <= text.size();) {
    if (bytes.At(at, 1) != 0xFF) break;
    const uint64_t marker = bytes.At(at + 1, 1);
    if (marker == 0xFF) {  // a fill byte
      ++at;
      continue;
    }
    const bool is_table = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    if (marker >= 0xC0 && marker <= 0xCF && !is_table)
      return {"JPEG", bytes.Signed(at + 7, 2), bytes.Signed(at + 5, 2)};
    const uint64_t length = bytes.At(at + 2, 2);
    if (length < 2) break;
    at += 2 + length;
  }
  return {"JPEG"};
}

StoredImageSize BmpSize(std::string_view text) {
  const Bytes bytes{text, true};
  if (bytes.At(14, 4) == 12) return {"BMP", bytes.Signed(18, 2), bytes.Signed(20, 2)};
  const auto width = static_cast<int32_t>(bytes.At(18, 4));
  const auto height = static_cast<int32_t>(bytes.At(22, 4));
  return {"BMP", width, std::abs(static_cast<int64_t>(height))};  // negative: top row first
}

// The first directory's tags 256 (width) and 257 (height), 16 or 32 bits.
StoredImageSize TiffSize(std::string_view text) {
  const Bytes bytes{text, text[0] == 'I'};
  StoredImageSize size = {"TIFF"};
  const size_t directory = bytes.At(4, 4);
  const size_t entries = bytes.At(directory, 2);
  for (size_t i = 0; i < entries; ++i) {
    const size_t entry = directory + 2 + 12 * i;
    const size_t width_bytes = bytes.At(entry + 2, 2) == 3 ? 2 : 4;
    const uint64_t tag = bytes.At(entry, 2);
    if (tag == 256) size.width_px = bytes.Signed(entry + 8, width_bytes);
    if (tag == 257) size.height_px = bytes.Signed(entry + 8, width_bytes);
  }
  return size;
}

StoredImageSize WebpSize(std::string_view text) {
  const Bytes bytes{text, true};
  const std::string_view chunk = text.substr(12, 4);
  if (chunk == "VP8X") return {"WebP", bytes.Signed(24, 3) + 1, bytes.Signed(27, 3) + 1};
  if (chunk == "VP8L")
    return {"WebP", (bytes.Signed(21, 4) & 0x3FFF) + 1, (bytes.Signed(21, 4) >> 14 & 0x3FFF) + 1};
  if (chunk == "VP8 ") return {"WebP", bytes.Signed(26, 2) & 0x3FFF, bytes.Signed(28, 2) & 0x3FFF};
  return {"WebP"};
}

// "P6 # comment\n 640 480 255": numbers between white space and comments.
StoredImageSize PnmSize(std::string_view text) {
  std::array<int64_t, 2> numbers = {};
  size_t at = 2;
  for (int64_t& number : numbers) {
    while (at < text.size() && (std::isspace(static_cast<uint8_t>(text[at])) || text[at] == '#')) {
      if (text[at] == '#')
        while (at < text.size() && text[at] != '\n') ++at;
      else
        ++at;
    }
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && number < 1'000'000'000; ++at)
      number = 10 * number + (text[at] - '0');
  }
  return {"PNM", numbers[0], numbers[1]};
}

}  // namespace

std::optional<StoredImageSize> FindImageSize(std::string_view bytes) {
  const Bytes big_endian{bytes, false};
  if (bytes.starts_with("\xFF\xD8\xFF"sv)) return JpegSize(bytes);
  if (bytes.starts_with("\x89PNG\r\n\x1A\n"sv))
    return StoredImageSize{"PNG", big_endian.Signed(16, 4), big_endian.Signed(20, 4)};
  if (bytes.starts_with("BM"sv)) return BmpSize(bytes);
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return TiffSize(bytes);
  if (bytes.starts_with("RIFF"sv) && bytes.size() >= 30 && bytes.substr(8, 4) == "WEBP"sv)
    return WebpSize(bytes);
  const bool is_pnm = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
                      std::isspace(static_cast<uint8_t>(bytes[2]));
  if (is_pnm) return PnmSize(bytes);
  return std::nullopt;
}

}  // namespace poselift
