// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/types.hpp>

#include "src/io/jpeg_frame.h"

struct AVFormatContext;

namespace poselift {

// Writes JPEG frames as they are into a Matroska file (Motion JPEG), each at its own time.
//
// A frame stands in the file when Add returns: a program that is killed then leaves a file
// with all of them, which VideoFile (video.h) and players read; only the index for seeking and
// the stated length are missing. A loss of power may take what the system had not written yet.
//
// Times start at 0 with the first frame and are rounded to the millisecond, Matroska's unit.
// Add waits for the disk: not for the thread that empties the camera's buffers.
class VideoRecorder {
 public:
  // Starts the file anew. Throws InputError when it cannot be written.
  VideoRecorder(const std::filesystem::path& path, cv::Size size_px);
  // Closes; says nothing of what fails then.
  ~VideoRecorder();
  VideoRecorder(const VideoRecorder&) = delete;
  VideoRecorder& operator=(const VideoRecorder&) = delete;

  // False, and nothing written, for a time that is not a millisecond behind the last one.
  // Throws InputError when the file cannot be written further (the disk is full): it is then
  // closed and ends with the frame before. frame.bytes: of JpegEncoder, in the file's size.
  bool Add(const JpegFrame& frame);

  // Writes the index and the length. Throws InputError; the frames are safe all the same.
  // Nothing can be added afterwards; a second Close does nothing.
  void Close();

  int num_frames() const { return num_frames_; }

 private:
  struct Release {
    void operator()(AVFormatContext* context) const;
  };
  void Flush();
  [[noreturn]] void GiveUp(int error);

  std::filesystem::path path_;
  std::unique_ptr<AVFormatContext, Release> context_;  // nothing: closed
  int num_frames_ = 0;
  double first_s_ = 0.0;
  int64_t last_ms_ = 0;
  int64_t good_bytes_ = 0;  // of the file, up to the last frame
};

}  // namespace poselift
