// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/frame_decoder.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <cstdio>
#include <cstring>
#include <new>
#include <opencv2/imgproc.hpp>

#include "src/capture/fourcc.h"
#include "src/io/image.h"

namespace poselift {
namespace {

bool IsJpeg(uint32_t fourcc) { return fourcc == kFourccMjpg || fourcc == kFourccJpeg; }

// Whether a JPEG ends as it should, and its restart markers stand in their order. Only this
// tells a webcam's habit of bytes too many from a piece that is missing.
bool HasAllMarkers(const cv::Mat& bytes) {
  const uchar* at = bytes.data;
  const uchar* const end = at + bytes.total();
  int next_restart = 0;
  while (at + 1 < end) {
    at = static_cast<const uchar*>(std::memchr(at, 0xff, static_cast<size_t>(end - at - 1)));
    if (!at) return false;
    const uchar marker = *++at;
    if (marker == 0xd9) return true;
    if (marker < 0xd0 || marker > 0xd7) continue;
    if (marker - 0xd0 != next_restart) return false;
    next_restart = (next_restart + 1) % 8;
  }
  return false;
}

// "Corrupt JPEG data: 2 extraneous bytes before marker 0xd6": Logitech's webcams write these
// into every other frame (libjpeg-turbo#157, opencv#9477).
bool IsHarmless(const char* warning, const cv::Mat& bytes) {
  constexpr unsigned kMostIdleBytes = 32;
  unsigned num_bytes = 0;
  unsigned marker = 0;
  const int num_read = std::sscanf(
      warning, "Corrupt JPEG data: %u extraneous bytes before marker 0x%x", &num_bytes, &marker);
  return num_read == 2 && num_bytes <= kMostIdleBytes && marker >= 0xd0 && marker <= 0xd9 &&
         HasAllMarkers(bytes);
}

std::unique_ptr<void, int (*)(void*)> NewJpegDecoder() {
  std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), tjDestroy);
  if (!decoder) throw std::bad_alloc();
  return decoder;
}

struct Layout {
  int bytes_per_line = 0;
  int rows = 0;  // of all planes
};

std::string CheckRaw(const RawFormat& format, const cv::Mat& bytes, Layout* layout) {
  const auto [width_px, height_px] = std::pair(format.size_px.width, format.size_px.height);
  const bool is_yuyv = format.fourcc == kFourccYuyv;
  const bool is_nv12 = format.fourcc == kFourccNv12;
  if ((is_yuyv || is_nv12) && width_px % 2 != 0) return "an odd width";
  if (is_nv12 && height_px % 2 != 0) return "an odd height";
  const int packed = is_yuyv ? 2 * width_px : width_px;
  layout->bytes_per_line = format.bytes_per_line == 0 ? packed : format.bytes_per_line;
  layout->rows = is_nv12 ? height_px / 2 * 3 : height_px;
  if (layout->bytes_per_line < packed) return "lines that are shorter than the picture is wide";
  // Nothing need follow the last line's pixels.
  const size_t wanted =
      static_cast<size_t>(layout->bytes_per_line) * (static_cast<size_t>(layout->rows) - 1) +
      static_cast<size_t>(packed);
  constexpr size_t kMostBytes = 1'000'000'000;
  if (bytes.total() < wanted || wanted > kMostBytes)
    return fmt::format("{} bytes of {}", bytes.total(), wanted);
  return "";
}

std::string CheckSize(const RawFormat& format, const cv::Mat& bytes) {
  if (bytes.type() != CV_8UC1 || bytes.rows != 1) return "no bytes";
  const cv::Size size_px = format.size_px;
  if (size_px.width <= 0 || size_px.height <= 0 ||
      static_cast<double>(size_px.width) * size_px.height > kMaxImagePixels)
    return fmt::format("a size of {} x {}", size_px.width, size_px.height);
  return IsDecodable(format.fourcc) ? "" : FourccText(format.fourcc) + ", which is not decoded";
}

// A plane among the bytes; shares them.
cv::Mat Plane(const cv::Mat& bytes, const Layout& layout, int first_row, int rows, int cols) {
  const int begin = layout.bytes_per_line * first_row;
  const int length = layout.bytes_per_line * rows;
  if (begin + length <= bytes.cols)
    return bytes.colRange(begin, begin + length).reshape(1, rows).colRange(0, cols);
  // The last line has no padding.
  cv::Mat padded = cv::Mat::zeros(1, length, CV_8UC1);
  bytes.colRange(begin, bytes.cols).copyTo(padded.colRange(0, bytes.cols - begin));
  return padded.reshape(1, rows).colRange(0, cols);
}

cv::Mat PairPlane(const cv::Mat& bytes, const Layout& layout, cv::Size size_px) {
  const cv::Mat plane = Plane(bytes, layout, 0, size_px.height, 2 * size_px.width);
  return plane.reshape(2);
}

}  // namespace

bool IsDecodable(uint32_t fourcc) {
  return IsJpeg(fourcc) || fourcc == kFourccYuyv || fourcc == kFourccNv12 || fourcc == kFourccGrey;
}

std::string DecodableFormats() { return "MJPG, YUYV, NV12 or GREY"; }

FrameDecoder::FrameDecoder() : jpeg_(NewJpegDecoder()) {}

// libjpeg-turbo 2.1.5 may refuse every frame that follows one it could not read: a decoder that
// failed is not used again.
std::string FrameDecoder::DecodeJpeg(const RawFormat& format, const cv::Mat& bytes, int type,
                                     cv::Mat* picture) {
  std::string flaw = TryJpeg(format, bytes, type, picture);
  if (!flaw.empty()) jpeg_ = NewJpegDecoder();
  return flaw;
}

std::string FrameDecoder::TryJpeg(const RawFormat& format, const cv::Mat& bytes, int type,
                                  cv::Mat* picture) {
  const auto num_bytes = static_cast<unsigned long>(bytes.total());
  int width_px = 0, height_px = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(jpeg_.get(), bytes.data, num_bytes, &width_px, &height_px, &subsampling,
                          &colours) != 0 &&
      tjGetErrorCode(jpeg_.get()) == TJERR_FATAL)
    return tjGetErrorStr2(jpeg_.get());
  if (cv::Size(width_px, height_px) != format.size_px)
    return fmt::format("a JPEG of {} x {}, wanted {} x {}", width_px, height_px,
                       format.size_px.width, format.size_px.height);
  picture->create(format.size_px, type);
  const int pixels = type == CV_8UC1 ? TJPF_GRAY : TJPF_BGR;
  if (tjDecompress2(jpeg_.get(), bytes.data, num_bytes, picture->data, width_px,
                    static_cast<int>(picture->step), height_px, pixels, TJFLAG_LIMITSCANS) == 0)
    return "";
  const char* what = tjGetErrorStr2(jpeg_.get());
  if (tjGetErrorCode(jpeg_.get()) == TJERR_WARNING && IsHarmless(what, bytes)) return "";
  return what;
}

std::string FrameDecoder::ToGrey(const RawFormat& format, const cv::Mat& bytes, cv::Mat* grey) {
  if (std::string flaw = CheckSize(format, bytes); !flaw.empty()) return flaw;
  if (IsJpeg(format.fourcc)) return DecodeJpeg(format, bytes, CV_8UC1, grey);
  Layout layout;
  if (std::string flaw = CheckRaw(format, bytes, &layout); !flaw.empty()) return flaw;
  if (format.fourcc == kFourccYuyv)
    cv::extractChannel(PairPlane(bytes, layout, format.size_px), *grey, 0);
  else
    *grey = Plane(bytes, layout, 0, format.size_px.height, format.size_px.width);
  return "";
}

std::string FrameDecoder::ToBgr(const RawFormat& format, const cv::Mat& bytes, cv::Mat* bgr) {
  if (std::string flaw = CheckSize(format, bytes); !flaw.empty()) return flaw;
  if (IsJpeg(format.fourcc)) return DecodeJpeg(format, bytes, CV_8UC3, bgr);
  Layout layout;
  if (std::string flaw = CheckRaw(format, bytes, &layout); !flaw.empty()) return flaw;
  const cv::Size size_px = format.size_px;
  if (format.fourcc == kFourccYuyv) {
    cv::cvtColor(PairPlane(bytes, layout, size_px), *bgr, cv::COLOR_YUV2BGR_YUYV);
    return "";
  }
  const cv::Mat y = Plane(bytes, layout, 0, size_px.height, size_px.width);
  if (format.fourcc == kFourccGrey) {
    cv::cvtColor(y, *bgr, cv::COLOR_GRAY2BGR);
    return "";
  }
  const cv::Mat uv = Plane(bytes, layout, size_px.height, size_px.height / 2, size_px.width);
  cv::cvtColorTwoPlane(y, uv.reshape(2), *bgr, cv::COLOR_YUV2BGR_NV12);
  return "";
}

}  // namespace poselift
