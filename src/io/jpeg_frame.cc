// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/jpeg_frame.h"

#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "src/capture/fourcc.h"

namespace poselift {
namespace {

using Bytes = std::span<const uint8_t>;

// Markers of JPEG, behind a byte of 0xff.
enum Marker : uint8_t { kTables = 0xc4, kStart = 0xd8, kEnd = 0xd9, kScan = 0xda };

struct JpegHead {
  cv::Size size_px;
  bool has_tables = false;  // of Huffman
  size_t scan = 0;          // where its marker stands
};

bool IsFrameMarker(uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != kTables && marker != 0xc8 && marker != 0xcc;
}

bool StandsAlone(uint8_t marker) { return marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7); }

// Calls visit(marker, begin, end) for each segment up to the scan, from its 0xff on. False where
// they do not lead there.
template <typename Visit>
bool VisitSegments(Bytes jpeg, Visit visit) {
  if (jpeg.size() < 4 || jpeg[0] != 0xff || jpeg[1] != kStart) return false;
  size_t at = 2;
  while (at + 4 <= jpeg.size()) {
    if (jpeg[at] != 0xff) return false;
    const uint8_t marker = jpeg[at + 1];
    if (marker == 0xff || StandsAlone(marker)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    const size_t length = static_cast<size_t>(jpeg[at + 2] << 8 | jpeg[at + 3]);
    const size_t end = at + 2 + length;
    if (length < 2 || end > jpeg.size() || marker == kStart || marker == kEnd) return false;
    visit(marker, at, end);
    if (marker == kScan) return true;
    at = end;
  }
  return false;
}

std::optional<JpegHead> ReadHead(Bytes jpeg) {
  JpegHead head;
  const bool whole = VisitSegments(jpeg, [&](uint8_t marker, size_t begin, size_t end) {
    if (marker == kTables) head.has_tables = true;
    if (marker == kScan) head.scan = begin;
    if (IsFrameMarker(marker) && end - begin >= 9)
      head.size_px = {jpeg[begin + 7] << 8 | jpeg[begin + 8],
                      jpeg[begin + 5] << 8 | jpeg[begin + 6]};
  });
  if (!whole) return std::nullopt;
  return head;
}

int Subsampling(uint32_t fourcc) {
  return fourcc == kFourccYuyv ? TJSAMP_422 : fourcc == kFourccNv12 ? TJSAMP_420 : TJSAMP_GRAY;
}

// The four standard tables, as TurboJPEG writes them into any picture.
std::vector<uint8_t> StandardTables() {
  JpegEncoder encoder({kFourccYuyv, {16, 16}});
  std::vector<uint8_t> jpeg;
  encoder.Encode(std::vector<uint8_t>(16 * 16 * 2, 128), &jpeg);
  std::vector<uint8_t> tables;
  VisitSegments(jpeg, [&](uint8_t marker, size_t begin, size_t end) {
    if (marker == kTables) tables.insert(tables.end(), jpeg.data() + begin, jpeg.data() + end);
  });
  return tables;
}

// One past the last end marker behind the scan's; the whole length without one.
size_t EndOfPicture(Bytes jpeg, size_t scan) {
  for (size_t end = jpeg.size(); end >= scan + 4; --end)
    if (jpeg[end - 2] == 0xff && jpeg[end - 1] == kEnd) return end;
  return jpeg.size();
}

bool MakeWhole(Bytes frame, cv::Size size_px, std::vector<uint8_t>* jpeg) {
  const auto head = ReadHead(frame);
  if (!head || head->size_px != size_px) return false;
  const size_t end = EndOfPicture(frame, head->scan);
  const auto scan = frame.begin() + static_cast<std::ptrdiff_t>(head->scan);
  jpeg->assign(frame.begin(), scan);
  if (!head->has_tables) {
    static const std::vector<uint8_t> tables = StandardTables();
    jpeg->insert(jpeg->end(), tables.begin(), tables.end());
  }
  jpeg->insert(jpeg->end(), scan, frame.begin() + static_cast<std::ptrdiff_t>(end));
  if ((*jpeg)[jpeg->size() - 2] != 0xff || jpeg->back() != kEnd)
    jpeg->insert(jpeg->end(), {0xff, kEnd});
  return true;
}

// Levels of video, `range` of them from or about `from`, as all of 0 to 255.
using Levels = std::array<uint8_t, 256>;
constexpr Levels Stretched(double from, double to, double range) {
  Levels levels{};
  for (int i = 0; i < 256; ++i)
    levels[static_cast<size_t>(i)] =
        static_cast<uint8_t>(std::clamp((i - from) * 255.0 / range + to + 0.5, 0.0, 255.0));
  return levels;
}
constexpr Levels kLuma = Stretched(16.0, 0.0, 219.0);
constexpr Levels kChroma = Stretched(128.0, 128.0, 224.0);

}  // namespace

JpegEncoder::JpegEncoder(const RawFormat& format, int quality)
    : format_(format), quality_(quality), turbo_(nullptr, tjDestroy) {
  const auto [width, height] = format.size_px;
  const bool pairs_of_columns = format.fourcc == kFourccYuyv || format.fourcc == kFourccNv12;
  if (!IsDecodable(format.fourcc) || width <= 0 || height <= 0 ||
      (pairs_of_columns && width % 2 != 0) || (format.fourcc == kFourccNv12 && height % 2 != 0))
    throw std::invalid_argument("JpegEncoder: no such format, or not in this size");
  if (quality < 1 || quality > 100)
    throw std::invalid_argument("JpegEncoder: quality must be 1 to 100");
  if (!IsRaw()) return;

  const int row_bytes = width * (format.fourcc == kFourccYuyv ? 2 : 1);
  if (format_.bytes_per_line == 0) format_.bytes_per_line = row_bytes;
  if (format_.bytes_per_line < row_bytes)
    throw std::invalid_argument("JpegEncoder: lines are shorter than a row of pixels");
  const int rows = format.fourcc == kFourccNv12 ? height * 3 / 2 : height;
  // The padding behind the last row need not be there.
  wanted_bytes_ = static_cast<size_t>(format_.bytes_per_line) * static_cast<size_t>(rows - 1) +
                  static_cast<size_t>(row_bytes);

  const int samples = Subsampling(format.fourcc);
  for (int i = 0; i < (format.fourcc == kFourccGrey ? 1 : 3); ++i)
    planes_[i].resize(tjPlaneSizeYUV(i, width, 0, height, samples));
  compressed_.resize(tjBufSize(width, height, samples));
  turbo_.reset(tjInitCompress());
  if (!turbo_) throw std::runtime_error("JpegEncoder: TurboJPEG does not start");
}

bool JpegEncoder::IsRaw() const {
  return format_.fourcc != kFourccMjpg && format_.fourcc != kFourccJpeg;
}

bool JpegEncoder::Encode(Bytes frame, std::vector<uint8_t>* jpeg) {
  jpeg->clear();
  if (!IsRaw()) return MakeWhole(frame, format_.size_px, jpeg);
  if (frame.size() < wanted_bytes_) return false;
  FillPlanes(frame.data());
  return Compress(jpeg);
}

void JpegEncoder::FillPlanes(const uint8_t* frame) {
  const auto stride = static_cast<size_t>(format_.bytes_per_line);
  const auto width = static_cast<size_t>(format_.size_px.width);
  const auto height = static_cast<size_t>(format_.size_px.height);
  uint8_t* y = planes_[0].data();
  uint8_t* u = planes_[1].data();
  uint8_t* v = planes_[2].data();
  for (size_t row = 0; row < height; ++row) {
    const uint8_t* from = frame + row * stride;
    if (format_.fourcc == kFourccGrey) {
      y = std::copy_n(from, width, y);
    } else if (format_.fourcc == kFourccNv12) {
      y = std::transform(from, from + width, y, [](uint8_t level) { return kLuma[level]; });
    } else {
      for (size_t i = 0; i < width; i += 2, from += 4) {
        *y++ = kLuma[from[0]];
        *u++ = kChroma[from[1]];
        *y++ = kLuma[from[2]];
        *v++ = kChroma[from[3]];
      }
    }
  }
  if (format_.fourcc != kFourccNv12) return;
  for (size_t row = 0; row < height / 2; ++row) {
    const uint8_t* from = frame + (height + row) * stride;
    for (size_t i = 0; i < width; i += 2) {
      *u++ = kChroma[from[i]];
      *v++ = kChroma[from[i + 1]];
    }
  }
}

bool JpegEncoder::Compress(std::vector<uint8_t>* jpeg) {
  const unsigned char* planes[] = {planes_[0].data(), planes_[1].data(), planes_[2].data()};
  unsigned char* to = compressed_.data();
  unsigned long length = compressed_.size();
  if (tjCompressFromYUVPlanes(turbo_.get(), planes, format_.size_px.width, nullptr,
                              format_.size_px.height, Subsampling(format_.fourcc), &to, &length,
                              quality_, TJFLAG_NOREALLOC) != 0)
    throw std::runtime_error(std::string("JpegEncoder: ") + tjGetErrorStr2(turbo_.get()));
  jpeg->assign(to, to + length);
  return true;
}

}  // namespace poselift
