// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/frame_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/input_error.h"
#include "src/io/image.h"

namespace poselift {

cv::Mat FramePictures::Read(const FrameLabels& frame, const ProgressFn& progress) {
  if (frame.image.empty()) return {};
  const std::filesystem::path path = dir_ / frame.image;
  if (!frame.frame || !IsVideoFile(path)) return ReadImage(path);
  return ReadFrame(frame.image, *frame.frame, progress);
}

void FramePictures::WaitForTimes() {
  if (times_) times_->WaitUntilRead();
}

void FramePictures::Open(const std::string& image) {
  video_.emplace(dir_ / image);
  next_ = 0;
  is_sought_ = false;
  if (image == image_ && times_) return;
  kept_.clear();
  const auto known = known_times_.find(image);
  times_ = known != known_times_.end() ? std::make_unique<FrameTimes>(known->second)
                                       : std::make_unique<FrameTimes>(dir_ / image);
  image_ = image;
}

// So that the video gives the frame, or one before it.
void FramePictures::GoTo(int index) {
  if (index >= next_ && index < next_ + kNear) return;
  if (index >= kNear) {
    if (const auto time_s = times_->Of_s(index)) {
      is_sought_ = true;
      next_ = index;
      bool is_there = false;
      try {
        is_there = video_->GoTo(index, *time_s);
      } catch (const InputError&) {  // told when it is met again on the long way
      }
      num_seeks_ += is_there ? 1 : 0;
      if (is_there) return;
      Open(image_);
    }
  }
  if (index < next_) Open(image_);
}

void FramePictures::Keep(int index, const cv::Mat& bgr) {
  kept_.emplace_back(index, bgr);
  while (kept_.size() > 1 && kept_.size() * bgr.total() * 3 > kKept_bytes) kept_.pop_front();
}

// Keeps the frames from the first to the last; false when the video ends before.
bool FramePictures::Decode(int first, int last, const ProgressFn& progress) {
  const int from = next_;
  const auto so_far = [&] {
    if (progress) progress(static_cast<double>(next_ - from) / (last - from + 1));
  };
  for (; next_ < first && video_->Skip_s(); so_far()) ++next_;
  for (; next_ >= first && next_ <= last; so_far()) {
    const auto frame = video_->Next();
    if (!frame) return false;
    Keep(next_++, frame->bgr);
  }
  return next_ > last;
}

cv::Mat FramePictures::ReadFrame(const std::string& image, int index, const ProgressFn& progress) {
  if (image != image_ || !video_) Open(image);
  const int before = std::exchange(last_, index);
  const auto kept = std::ranges::find(kept_, index, &std::pair<int, cv::Mat>::first);
  if (kept != kept_.end()) return kept->second;
  // Who goes back a little goes on so: those before are kept on the way.
  const auto area = static_cast<size_t>(video_->size_px().area());
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): Open gave a size
  const auto room = static_cast<int>(kKept_bytes / 3 / area);
  const int back = std::clamp(room - 1, 0, kBack);
  const bool is_going_back = index < before && index > before - kBack;
  const int first = is_going_back ? std::max(0, index - back) : index;
  GoTo(first);
  if (Decode(first, index, progress)) return kept_.back().second;
  // OpenCV counts frames by their times after a jump, and may take an earlier one for the last.
  if (is_sought_) {
    Open(image_);
    if (Decode(index, index, progress)) return kept_.back().second;
  }
  throw InputError(dir_ / image, fmt::format("has {} frames, wanted frame {}", next_, index));
}

}  // namespace poselift
