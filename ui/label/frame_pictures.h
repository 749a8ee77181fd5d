// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>

#include "src/io/video.h"
#include "src/labels.h"

namespace poselift {

// The pictures of frames, in any order: picture files, and frames of videos. A video is decoded
// forwards; frames of late are kept, and what is farther back is decoded anew from the beginning.
class FramePictures {
 public:
  // dir: of image paths.
  explicit FramePictures(std::filesystem::path dir) : dir_(std::move(dir)) {}

  // BGR, upright; empty for a frame without a picture. Throws InputError for what cannot be read,
  // and for a frame that the video does not have.
  cv::Mat Read(const FrameLabels& frame);

 private:
  static constexpr size_t kKept_bytes = 100 << 20;

  cv::Mat ReadFrame(const std::filesystem::path& path, int index);

  std::filesystem::path dir_;
  std::filesystem::path path_;  // of the video that is open
  std::optional<VideoFile> video_;
  int next_ = 0;  // that it gives
  std::deque<std::pair<int, cv::Mat>> kept_;
};

}  // namespace poselift
