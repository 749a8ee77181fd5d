// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <utility>

#include "src/io/video.h"
#include "src/labels.h"
#include "src/progress.h"
#include "ui/label/frame_times.h"

namespace poselift {

// The pictures of frames, in any order: picture files, and frames of videos, each exactly as it is
// when the video is decoded from its beginning. Frames of late are kept. Another one that is far is
// decoded from a key frame before it, once the times of the frames have been read that far; until
// then from where the video stands, or from its beginning.
class FramePictures {
 public:
  // dir: of image paths. times: of videos as they are now; the others are read in the background.
  explicit FramePictures(std::filesystem::path dir, VideoTimes times = {})
      : dir_(std::move(dir)), known_times_(std::move(times)) {}

  // BGR, upright; empty for a frame without a picture. Throws InputError for what cannot be read,
  // and for a frame that the video does not have; what progress throws comes through, and what was
  // decoded until then is not in vain.
  cv::Mat Read(const FrameLabels& frame, const ProgressFn& progress = {});
  // Until any frame of the video at hand is reached at once.
  void WaitForTimes();
  int num_seeks() const { return num_seeks_; }  // that led to their frame

 private:
  static constexpr size_t kKept_bytes = 100 << 20;
  static constexpr int kNear = 48;  // frames, that are sooner decoded than looked for
  static constexpr int kBack = 12;  // so many are kept when somebody goes back frame by frame

  cv::Mat ReadFrame(const std::string& image, int index, const ProgressFn& progress);
  void Open(const std::string& image);
  void GoTo(int index);
  bool Decode(int first, int last, const ProgressFn& progress);
  void Keep(int index, const cv::Mat& bgr);

  std::filesystem::path dir_;
  VideoTimes known_times_;
  std::string image_;  // the video that is open
  std::optional<VideoFile> video_;
  int next_ = 0;  // that it gives
  int last_ = 0;  // that was asked for
  int num_seeks_ = 0;
  bool is_sought_ = false;  // the video stands where a seek has led it
  std::deque<std::pair<int, cv::Mat>> kept_;
  std::unique_ptr<FrameTimes> times_;
};

}  // namespace poselift
