// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/image_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "src/input_error.h"
#include "src/io/image.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

bool IsDigit(char letter) { return letter >= '0' && letter <= '9'; }

// Cuts the digits off that a name begins with; gives them without leading zeros.
std::string_view TakeDigits(std::string_view* name) {
  size_t length = 0;
  while (length < name->size() && IsDigit((*name)[length])) ++length;
  std::string_view digits = name->substr(0, length);
  name->remove_prefix(length);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

}  // namespace

bool IsNaturallyBefore(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (IsDigit(a.front()) && IsDigit(b.front())) {
      const std::string_view number_a = TakeDigits(&a);
      const std::string_view number_b = TakeDigits(&b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // they differ by leading zeros alone
}

std::vector<fs::path> ListPictures(const fs::path& folder) {
  std::error_code error;
  if (fs::is_regular_file(folder, error)) return {folder};
  if (!fs::is_directory(folder, error)) throw InputError(folder, "is no folder of pictures");
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename();
    std::error_code ignored;
    if (name.front() != '.' && HasImageEnding(name) && at->is_regular_file(ignored))
      files.push_back(at->path());
  }
  if (error) throw InputError(folder, "cannot be read: " + error.message());
  if (files.empty()) throw InputError(folder, "has no pictures; wanted .jpg, .png or the like");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return IsNaturallyBefore(a.filename().native(), b.filename().native());
  });
  return files;
}

bool HasImageEnding(const fs::path& path) {
  constexpr std::array kEndings = {".jpg",  ".jpeg", ".png", ".bmp", ".tif", ".tiff",
                                   ".webp", ".pbm",  ".pgm", ".ppm", ".pnm"};
  const std::string ending = path.extension();
  return std::any_of(kEndings.begin(), kEndings.end(),
                     [&](const char* known) { return EqualsIgnoringCase(ending, known); });
}

ImageFolder::ImageFolder(const fs::path& folder, double rate_hz, Pictures pictures)
    : files_(ListPictures(folder)),
      rate_hz_(rate_hz),
      pictures_(pictures),
      first_(ReadImage(files_.front())),
      size_px_(first_.size()) {
  if (!(rate_hz > 0.0))
    throw InputError(folder, fmt::format("found a rate of {} Hz, wanted above 0", rate_hz));
}

std::optional<VideoFrame> ImageFolder::Next() {
  if (next_ == files_.size()) return std::nullopt;
  const fs::path& file = files_[next_];
  VideoFrame frame;
  frame.index = static_cast<int>(next_);
  frame.bgr = next_ == 0 ? std::exchange(first_, {}) : ReadImage(file);
  if (frame.bgr.size() != size_px_)
    throw InputError(file, fmt::format("found {} x {} pixels, wanted {} x {} as in {}",
                                       frame.bgr.cols, frame.bgr.rows, size_px_.width,
                                       size_px_.height, files_.front().filename().string()));
  if (pictures_ != Pictures::kBgr) cv::cvtColor(frame.bgr, frame.grey, cv::COLOR_BGR2GRAY);
  if (pictures_ == Pictures::kGrey) frame.bgr.release();
  frame.time_s = *Skip_s();
  return frame;
}

std::optional<double> ImageFolder::Skip_s() {
  if (next_ == files_.size()) return std::nullopt;
  return static_cast<double>(next_++) / rate_hz_;
}

}  // namespace poselift
