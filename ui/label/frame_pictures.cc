// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/frame_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/input_error.h"
#include "src/io/image.h"

namespace poselift {

cv::Mat FramePictures::Read(const FrameLabels& frame) {
  if (frame.image.empty()) return {};
  const std::filesystem::path path = dir_ / frame.image;
  return frame.frame && IsVideoFile(path) ? ReadFrame(path, *frame.frame) : ReadImage(path);
}

cv::Mat FramePictures::ReadFrame(const std::filesystem::path& path, int index) {
  if (path != path_) {
    kept_.clear();
    video_.reset();
    path_ = path;
  }
  const auto kept = std::ranges::find(kept_, index, &std::pair<int, cv::Mat>::first);
  if (kept != kept_.end()) return kept->second;
  if (!video_ || index < next_) {
    video_.emplace(path);
    next_ = 0;
  }
  for (; next_ < index && video_->Skip_s(); ++next_) {
  }
  const auto frame = next_ == index ? video_->Next() : std::nullopt;
  if (!frame) throw InputError(path, fmt::format("has {} frames, wanted frame {}", next_, index));
  ++next_;
  kept_.emplace_back(index, frame->bgr);
  while (kept_.size() > 1 && kept_.size() * frame->bgr.total() * 3 > kKept_bytes) kept_.pop_front();
  return frame->bgr;
}

}  // namespace poselift
