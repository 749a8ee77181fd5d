// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "src/io/frame_source.h"

namespace poselift {

// The pictures of a folder as frames (those that ReadImage reads, by the ending of their
// names), in natural order: img2.png before img10.png. Hidden files and folders are passed
// over. The name of a single picture makes it the only frame.
//
// The time of frame i is i / rate_hz. Throws InputError, here and while it is read, for a
// folder that is none or has no picture, a damaged picture, and one of another size than the
// first, all named.
class ImageFolder : public FrameSource {
 public:
  explicit ImageFolder(const std::filesystem::path& folder, double rate_hz = 1.0,
                       Pictures pictures = Pictures::kBgr);

  cv::Size size_px() const override { return size_px_; }
  std::optional<VideoFrame> Next() override;
  std::optional<double> Skip_s() override;

  // Of frame i: files()[i].
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::vector<std::filesystem::path> files_;
  double rate_hz_;
  Pictures pictures_;
  cv::Mat first_;  // read for its size, until it is given
  cv::Size size_px_;
  size_t next_ = 0;
};

// The files alone, unread. Throws InputError for a folder that is none or has no picture.
std::vector<std::filesystem::path> ListPictures(const std::filesystem::path& folder);

// Whether a name stands before another, figures by their value: "img2" before "img10".
bool IsNaturallyBefore(std::string_view a, std::string_view b);

// By the ending of its name: .jpg, .png, ...
bool HasImageEnding(const std::filesystem::path& path);

}  // namespace poselift
