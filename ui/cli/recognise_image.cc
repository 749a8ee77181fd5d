// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <opencv2/core/mat.hpp>

#include "src/io/image.h"
#include "src/io/image_size.h"
#include "src/io/mapped_file.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {

bool IsImage(const std::filesystem::path& path, std::string_view head) {
  static constexpr std::array<std::string_view, 11> kEndings = {
      ".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".webp", ".pbm", ".pgm", ".ppm", ".pnm"};
  return FindImageSize(head) || std::any_of(kEndings.begin(), kEndings.end(),
                                            [&](auto ending) { return HasEnding(path, ending); });
}

nlohmann::ordered_json DescribeImage(const std::filesystem::path& path) {
  const cv::Mat image = ReadImage(path);
  const MappedFile file(path);
  return {{"format", FindImageSize(file.Bytes()).value().format},
          {"width_px", image.cols},
          {"height_px", image.rows}};
}

}  // namespace poselift::cli
