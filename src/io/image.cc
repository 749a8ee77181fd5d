// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/image.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "src/capture/fourcc.h"
#include "src/capture/frame_decoder.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/image_size.h"
#include "src/io/quiet_stderr.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kMaxFileBytes = 2'000'000'000;  // 200 megapixels of 16-bit BGR, and more

std::string ReadBytes(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path, "no such file; wanted a picture");
  if (!fs::is_regular_file(status))
    throw InputError(path, fs::is_directory(status) ? "is a folder; wanted a picture file"
                                                    : "is no ordinary file; wanted a picture");
  const uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(path, "cannot be read: " + error.message());
  if (size == 0) throw InputError(path, "is empty; wanted a picture");
  if (size > kMaxFileBytes)
    throw InputError(path, fmt::format("has {} bytes, wanted at most {}", size, kMaxFileBytes));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, std::string("cannot be opened: ") + std::strerror(errno));
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) throw InputError(path, "cannot be read to its end");
  return bytes;
}

StoredImageSize CheckedHead(const fs::path& path, std::string_view bytes) {
  const auto stored = FindImageSize(bytes);
  if (!stored) throw InputError(path, "is no picture; wanted JPEG, PNG, BMP, TIFF, WebP or PNM");
  const auto [format, width_px, height_px] = *stored;
  if (width_px <= 0 || height_px <= 0)
    throw InputError(path, fmt::format("is a damaged {} file: found no size in its head", format));
  if (static_cast<double>(width_px) * static_cast<double>(height_px) > kMaxImagePixels)
    throw InputError(path, fmt::format("has {} x {} pixels, wanted at most {:.0f} million; "
                                       "make it smaller",
                                       width_px, height_px, kMaxImagePixels / 1e6));
  return *stored;
}

// OpenCV fills up with grey what a JPEG lacks, and says nothing.
void CheckJpeg(const fs::path& path, const std::string& bytes, const StoredImageSize& stored) {
  if (stored.format != "JPEG") return;
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  cv::Mat grey;
  const std::string flaw = FrameDecoder().ToGrey(
      {kFourccJpeg, {static_cast<int>(stored.width_px), static_cast<int>(stored.height_px)}},
      buffer, &grey);
  // Others are of kinds that are no camera's.
  if (flaw.find("Premature end") != std::string::npos ||
      flaw.find("Corrupt JPEG data") != std::string::npos)
    throw InputError(path, fmt::format("is a damaged picture: {}; take or copy it again", flaw));
}

cv::Mat Decoded(const std::string& bytes) {
  const QuietStderr quiet;  // a damaged picture is told by our own error
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U,
                       const_cast<char*>(bytes.data()));  // only read
  try {
    return cv::imdecode(buffer, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

cv::Mat ReadImage(const fs::path& path) {
  const std::string bytes = ReadBytes(path);
  CheckJpeg(path, bytes, CheckedHead(path, bytes));
  cv::Mat image = Decoded(bytes);
  if (image.empty())
    throw InputError(path,
                     "is a damaged picture, or of a kind that cannot be decoded; "
                     "save it again as PNG or JPEG");
  return image;
}

void WritePng(const fs::path& path, const cv::Mat& picture) {
  if (picture.empty() || picture.depth() != CV_8U)
    throw std::invalid_argument("WritePng: wanted an 8-bit picture that is not empty");
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  WriteFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace poselift
