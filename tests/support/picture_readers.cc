// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/reader_tables.h"

#include <array>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "src/capture/fourcc.h"
#include "src/capture/frame_decoder.h"
#include "src/input_error.h"
#include "src/io/image.h"
#include "src/io/jpeg_frame.h"
#include "src/io/video.h"
#include "tests/support/fake_camera.h"
#include "tests/support/made_up_video.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

cv::Mat SomePicture(int seed = 1) {
  std::mt19937_64 rng(static_cast<unsigned>(seed));
  return Texture({24, 16}, &rng);
}

auto Picture(const std::string& ending) {
  return [ending](const fs::path&) {
    std::vector<uchar> bytes;
    cv::imencode(ending, SomePicture(), bytes);
    return std::string(bytes.begin(), bytes.end());
  };
}

std::string ReadsImage(const fs::path& path) {
  const cv::Mat image = ReadImage(path);
  return image.type() == CV_8UC3 && !image.empty() ? "" : "no picture";
}

auto Video(const std::string& file) {
  return Written(file, [](const fs::path& path) {
    WriteVideo(path, {SomePicture(1), SomePicture(2), SomePicture(3)}, 30.0);
  });
}

std::string ReadsVideo(const fs::path& path) {
  VideoFile video(path);
  double last_s = -1.0;
  while (const auto frame = video.Next()) {
    if (frame->bgr.size() != video.size_px() || frame->bgr.type() != CV_8UC3) return "no picture";
    if (!(frame->time_s > last_s)) return "times that do not grow";
    last_s = frame->time_s;
  }
  return "";
}

// The format of a frame, in front of its bytes.
struct FrameHead {
  uint16_t format, width_px, height_px, bytes_per_line;
};
constexpr std::array kFormats = {kFourccMjpg, kFourccYuyv, kFourccNv12, kFourccGrey};

auto Frame(uint16_t format, std::string (*encode)(const cv::Mat& grey)) {
  return [=](const fs::path&) {
    const FrameHead head{format, 24, 16, 0};
    const cv::Mat grey = GreyRamp({head.width_px, head.height_px});
    return std::string(reinterpret_cast<const char*>(&head), sizeof head) + encode(grey);
  };
}

std::string BytesOf(const cv::Mat& grey) { return {grey.ptr<char>(), grey.total()}; }

// A frame as JPEG is refused or a picture between its two marks.
bool IsRefusedAsJpeg(const RawFormat& format, std::vector<uint8_t> frame, std::string* flaw) {
  std::vector<uint8_t> jpeg;
  try {
    if (!JpegEncoder(format).Encode(frame, &jpeg)) return true;
  } catch (const std::invalid_argument&) {
    return true;
  }
  const size_t end = jpeg.size();
  if (end < 4 || jpeg[0] != 0xff || jpeg[1] != 0xd8 || jpeg[end - 2] != 0xff ||
      jpeg[end - 1] != 0xd9)
    *flaw = "a JPEG without its marks";
  return false;
}

std::string ReadsFrame(const fs::path& path) {
  const std::string bytes = FileText(path);
  FrameHead head;
  if (bytes.size() < sizeof head) throw InputError(path, "no frame");
  std::memcpy(&head, bytes.data(), sizeof head);
  const RawFormat format{kFormats[head.format % kFormats.size()],
                         {head.width_px % 512, head.height_px % 512},
                         head.bytes_per_line};
  // Exactly as many on the heap, so that a sanitizer sees what is read behind them.
  const std::vector<uint8_t> frame(bytes.begin() + sizeof head, bytes.end());
  const cv::Mat row(1, static_cast<int>(frame.size()), CV_8UC1, const_cast<uint8_t*>(frame.data()));
  FrameDecoder decoder;
  cv::Mat grey, bgr;
  const std::string no_grey = decoder.ToGrey(format, row, &grey);
  const std::string no_bgr = decoder.ToBgr(format, row, &bgr);
  std::string flaw;
  if (no_grey.empty() && (grey.size() != format.size_px || grey.type() != CV_8UC1))
    flaw = "no grey";
  if (no_bgr.empty() && (bgr.size() != format.size_px || bgr.type() != CV_8UC3))
    flaw = "no colours";
  const bool no_jpeg = IsRefusedAsJpeg(format, frame, &flaw);
  if (flaw.empty() && !no_grey.empty() && !no_bgr.empty() && no_jpeg)
    throw InputError(path, no_grey);
  return flaw;
}

}  // namespace

std::vector<Reader> PictureReaders() {
  return {
      {"image_jpeg", "a.jpg", Picture(".jpg"), ReadsImage},
      {"image_png", "a.png", Picture(".png"), ReadsImage},
      {"image_bmp", "a.bmp", Picture(".bmp"), ReadsImage},
      {"image_tiff", "a.tiff", Picture(".tiff"), ReadsImage},
      {"image_webp", "a.webp", Picture(".webp"), ReadsImage},
      {"image_pnm", "a.ppm", Picture(".ppm"), ReadsImage},
      {"video_avi", "a.avi", Video("whole.avi"), ReadsVideo},
      {"video_mp4", "a.mp4", Video("whole.mp4"), ReadsVideo},
      {"video_mkv", "a.mkv", Video("whole.mkv"), ReadsVideo},
      {"frame_mjpg", "mjpg", Frame(0, [](const cv::Mat& grey) { return AsJpeg(grey, 2); }),
       ReadsFrame},
      {"frame_yuyv", "yuyv", Frame(1, [](const cv::Mat& grey) { return AsYuyv(grey); }),
       ReadsFrame},
      {"frame_nv12", "nv12", Frame(2, [](const cv::Mat& grey) { return AsNv12(grey); }),
       ReadsFrame},
      {"frame_grey", "grey", Frame(3, BytesOf), ReadsFrame},
  };
}

}  // namespace poselift::testing
