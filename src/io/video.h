// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string_view>
#include <vector>

#include "src/io/frame_source.h"
#include "src/progress.h"

namespace poselift {

// A video file, read forwards, whatever FFmpeg decodes.
//
// Times are the presentation times of the stream, from its first frame on, so
// frames may lie unevenly; no frame rate is assumed. Frames are turned upright
// by the rotation the file states. Packets that cannot be decoded are passed
// over, so after damage fewer frames come, at their right times.
//
// Throws InputError, here and while it is read: no such file, empty, no video,
// cut short (told by the container, or by less than half of the frames it states),
// more than kMaxImagePixels (image.h), a size that changes, times that do not
// grow. stderr is silent meanwhile (see quiet_stderr.h).
class VideoFile : public FrameSource {
 public:
  explicit VideoFile(const std::filesystem::path& path, Pictures pictures = Pictures::kBgr);

  cv::Size size_px() const override { return size_px_; }
  std::optional<VideoFrame> Next() override;
  std::optional<double> Skip_s() override;
  // So that Next gives the frame of this number, of which Skip_s, read from the beginning, once
  // said time_s. It is decoded from a frame that stands by itself, well before it. False when the
  // file does not lead there for certain; what Next gives then is not known: open it anew.
  bool GoTo(int index, double time_s);
  // By the container, often an estimate; 0 when it states none.
  int64_t stated_frames() const;

 private:
  bool Grab();
  bool Advance();
  bool AdvanceOn();
  bool SeekBefore(double time_s);
  void CheckEnd() const;

  std::filesystem::path path_;
  Pictures pictures_;
  cv::VideoCapture capture_;
  cv::Size size_px_;  // upright
  int turn_clockwise_deg_ = 0;
  double stated_frames_ = 0.0;  // by the container, often an estimate
  bool grabbed_ = false;        // the frame `index_` waits in capture_
  int index_ = 0;
  double time_s_ = 0.0;         // of that frame
  double step_s_ = 1.0 / 30.0;  // to it from the frame before
};

// The time of each frame of a video file, in order: decodes it once.
std::vector<double> ReadFrameTimes(const std::filesystem::path& path,
                                   const ProgressFn& progress = {});

// Whether a file with these first bytes (some hundreds) is a video: MP4 and
// QuickTime, AVI, Matroska and WebM, MPEG, FLV, ASF, Ogg.
bool IsVideo(std::string_view head);
// The same of a file, or by its name's ending where it is too damaged to say.
bool IsVideoFile(const std::filesystem::path& path);

}  // namespace poselift
