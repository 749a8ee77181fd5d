// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "src/input_error.h"
#include "src/io/image.h"
#include "src/io/quiet_stderr.h"
#include "src/io/text_scanner.h"
#include "src/io/video_container.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

// OpenCV gives up at each packet that the decoder refuses; the next may be good.
constexpr int kMostBadPackets = 32;

void CheckFile(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path, "no such file; wanted a video");
  if (!fs::is_regular_file(status))
    throw InputError(path, fs::is_directory(status) ? "is a folder; wanted a video file"
                                                    : "is no ordinary file; wanted a video");
  if (fs::file_size(path) == 0) throw InputError(path, "is empty; wanted a video");
  if (!std::ifstream(path, std::ios::binary)) throw InputError(path, "cannot be opened");
}

InputError CutShort(const fs::path& path) {
  const uint64_t missing = MissingBytes(path);
  if (missing == 0)
    return {path, "is no video, or of a kind that cannot be decoded; save it as MP4 (H.264)"};
  return {path, fmt::format("is cut short: found {} bytes, wanted {} more; copy it again",
                            fs::file_size(path), missing)};
}

// FFmpeg's threads complain of damage at any time, also while QuietStderr is not
// there. Who sets the variable wants to hear them.
void QuietDecoders() {
  static const int kIsSet = ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  static_cast<void>(kIsSet);
}

// Matroska and WebM state how long they are; OpenCV multiplies that by a guessed rate.
bool StatesFrames(const fs::path& path) {
  std::array<char, 4> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  return std::string_view(head.data(), head.size()) != "\x1a\x45\xdf\xa3"sv;
}

// By how much a frame is to be turned clockwise to stand upright. OpenCV 4.6 has
// the sign wrong and turns such frames upside down (opencv/opencv#22088).
int TurnClockwise_deg(const cv::VideoCapture& capture) {
  // Of a damaged file it is any number.
  const int stated_deg =
      static_cast<int>(std::fmod(capture.get(cv::CAP_PROP_ORIENTATION_META), 360.0));
  constexpr bool kAnticlockwise = CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR == 6;
  return (kAnticlockwise ? 360 - stated_deg : 360 + stated_deg) % 360;
}

void TurnUpright(int clockwise_deg, cv::Mat* picture) {
  if (clockwise_deg == 90) cv::rotate(*picture, *picture, cv::ROTATE_90_CLOCKWISE);
  if (clockwise_deg == 180) cv::rotate(*picture, *picture, cv::ROTATE_180);
  if (clockwise_deg == 270) cv::rotate(*picture, *picture, cv::ROTATE_90_COUNTERCLOCKWISE);
}

}  // namespace

VideoFile::VideoFile(const fs::path& path, Pictures pictures) : path_(path), pictures_(pictures) {
  CheckFile(path);
  if (MissingBytes(path) > 0) throw CutShort(path);
  QuietDecoders();
  const QuietStderr quiet;
  // Absolute, for FFmpeg takes "a:b.mp4" for a protocol.
  const bool open = capture_.open(fs::absolute(path).string(), cv::CAP_FFMPEG);
  size_px_ = {static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_WIDTH)),
              static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_HEIGHT))};
  // Only now, for it swaps the sides of the size that is stated.
  capture_.set(cv::CAP_PROP_ORIENTATION_AUTO, 0.0);
  turn_clockwise_deg_ = TurnClockwise_deg(capture_);
  if (static_cast<double>(size_px_.width) * size_px_.height > kMaxImagePixels)
    throw InputError(path, fmt::format("has {} x {} pixels, wanted at most {:.0f} million",
                                       size_px_.width, size_px_.height, kMaxImagePixels / 1e6));
  if (const double rate_hz = capture_.get(cv::CAP_PROP_FPS); rate_hz > 0.0) step_s_ = 1.0 / rate_hz;
  if (StatesFrames(path)) stated_frames_ = capture_.get(cv::CAP_PROP_FRAME_COUNT);
  if (!open || !Advance()) throw CutShort(path);
}

bool VideoFile::Grab() {
  const QuietStderr quiet;
  try {
    for (int i = 0; i < kMostBadPackets; ++i)
      if (capture_.grab()) return true;
  } catch (const cv::Exception& error) {
    throw InputError(path_, fmt::format("cannot be decoded after frame {}: {}", index_, error.err));
  }
  return false;
}

// The time of the frame that was grabbed; before a grab OpenCV has the one before.
bool VideoFile::Advance() {
  grabbed_ = Grab();
  if (grabbed_) time_s_ = capture_.get(cv::CAP_PROP_POS_MSEC) / 1000.0;
  return grabbed_;
}

// To a frame that is not the first.
bool VideoFile::AdvanceOn() {
  const double before_s = std::max(time_s_, 0.0);
  if (!Advance()) return false;
  // OpenCV 4.6 has 0 of the frames that the decoder still held when the file was at its end, as
  // it does where there are B-frames (opencv/opencv#22141): they go on as evenly as those before.
  if (time_s_ == 0.0) time_s_ = before_s + step_s_;
  return true;
}

// To some frame at or before that time.
bool VideoFile::SeekBefore(double time_s) {
  const double rate_hz = capture_.get(cv::CAP_PROP_FPS);
  for (const double back_s : {0.0, 2.0, 10.0, 60.0}) {
    const double from_s = std::max(0.0, time_s - back_s);
    {
      const QuietStderr quiet;
      try {
        // OpenCV goes to a key frame 16 frames before at least, and reads on to about this one.
        if (!capture_.set(cv::CAP_PROP_POS_FRAMES, std::floor(from_s * rate_hz))) return false;
      } catch (const cv::Exception&) {
        return false;
      }
    }
    if (!Advance()) return false;
    // 0 is the first frame, or one at the end that OpenCV has no time of.
    if (time_s_ > 0.0 && time_s_ <= time_s) return true;
    if (from_s == 0.0) return false;
  }
  return false;
}

bool VideoFile::GoTo(int index, double time_s) {
  constexpr double kSame_s = 1e-6;
  if (!SeekBefore(time_s + kSame_s)) return false;
  // Two frames are needed to know the step at which those without a time go on.
  for (bool has_step = false; time_s_ < time_s - kSame_s; has_step = true) {
    const double before_s = time_s_;
    if (!(has_step ? AdvanceOn() : Advance()) || time_s_ <= before_s) return false;
    step_s_ = time_s_ - before_s;
  }
  if (std::abs(time_s_ - time_s) > kSame_s) return false;
  index_ = index;
  return true;
}

void VideoFile::CheckEnd() const {
  if (2.0 * index_ < stated_frames_)
    throw InputError(path_, fmt::format("ends after {} of {} frames: it is damaged; copy it again",
                                        index_, stated_frames_));
}

std::optional<double> VideoFile::Skip_s() {
  if (!grabbed_) return std::nullopt;
  double time_s = time_s_;
  ++index_;
  const bool is_last = !AdvanceOn();
  // Of a first frame at 0 OpenCV gives the decoding time, which may lie anywhere.
  if (index_ == 1 && (is_last || time_s < 0.0 || time_s >= time_s_)) time_s = 0.0;
  if (is_last) {
    CheckEnd();
    return time_s;
  }
  if (time_s >= time_s_)
    throw InputError(path_, fmt::format("found frame {} at {:.6f} s behind one at {:.6f} s, wanted "
                                        "times that grow; write the file anew with its times set",
                                        index_, time_s_, time_s));
  step_s_ = time_s_ - time_s;
  return time_s;
}

std::optional<VideoFrame> VideoFile::Next() {
  if (!grabbed_) return std::nullopt;
  VideoFrame frame;
  frame.index = index_;
  {
    const QuietStderr quiet;
    try {
      capture_.retrieve(frame.bgr);
      TurnUpright(turn_clockwise_deg_, &frame.bgr);
    } catch (const cv::Exception&) {
      frame.bgr.release();
    }
  }
  if (frame.bgr.type() != CV_8UC3 || frame.bgr.size() != size_px_)
    throw InputError(
        path_,
        fmt::format("found {} x {} pixels in frame {}, wanted {} x {} as before", frame.bgr.cols,
                    frame.bgr.rows, index_, size_px_.width, size_px_.height));
  if (pictures_ != Pictures::kBgr) cv::cvtColor(frame.bgr, frame.grey, cv::COLOR_BGR2GRAY);
  if (pictures_ == Pictures::kGrey) frame.bgr.release();
  frame.time_s = *Skip_s();
  return frame;
}

int64_t VideoFile::stated_frames() const {
  return static_cast<int64_t>(std::clamp(stated_frames_, 0.0, 1e9));
}

std::vector<double> ReadFrameTimes(const fs::path& path, const ProgressFn& progress) {
  VideoFile video(path);
  const auto stated = static_cast<double>(video.stated_frames());
  std::vector<double> times_s;
  while (const auto time_s = video.Skip_s()) {
    times_s.push_back(*time_s);
    if (progress)
      progress(stated > 0.0 ? std::min(1.0, static_cast<double>(times_s.size()) / stated) : 0.0);
  }
  return times_s;
}

bool IsVideo(std::string_view head) {
  constexpr std::array kPictureBrands = {"avif"sv, "avis"sv, "heic"sv, "heix"sv, "mif1"sv};
  const auto has = [&](size_t at, std::string_view bytes) {
    return head.substr(std::min(at, head.size()), bytes.size()) == bytes;
  };
  if (has(4, "ftyp"))
    return std::none_of(kPictureBrands.begin(), kPictureBrands.end(),
                        [&](std::string_view brand) { return has(8, brand); });
  if (has(0, "RIFF")) return has(8, "AVI ");
  constexpr std::array kBoxes = {"moov"sv, "mdat"sv, "wide"sv};
  constexpr std::array kHeads = {"\x1a\x45\xdf\xa3"sv, "\0\0\1\xba"sv, "\0\0\1\xb3"sv, "FLV\1"sv,
                                 "\x30\x26\xb2\x75"sv, "OggS"sv};
  return std::any_of(kBoxes.begin(), kBoxes.end(), [&](auto type) { return has(4, type); }) ||
         std::any_of(kHeads.begin(), kHeads.end(), [&](auto bytes) { return has(0, bytes); }) ||
         (has(0, "G") && has(188, "G") && has(376, "G"));
}

bool IsVideoFile(const fs::path& path) {
  std::array<char, 512> head{};
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  if (IsVideo({head.data(), head.size()})) return true;
  constexpr std::array kEndings = {".mp4"sv,  ".mov"sv, ".m4v"sv,  ".avi"sv, ".mkv"sv,
                                   ".webm"sv, ".mpg"sv, ".mpeg"sv, ".wmv"sv, ".mts"sv};
  const std::string ending = path.extension().string();
  return std::any_of(kEndings.begin(), kEndings.end(),
                     [&](std::string_view known) { return EqualsIgnoringCase(ending, known); });
}

}  // namespace poselift
