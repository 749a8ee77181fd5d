// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace poselift {

// What the head of a picture file says of itself, before any EXIF turn.
struct StoredImageSize {
  std::string_view format;  // "JPEG", "PNG", "BMP", "TIFF", "WebP", "PNM"
  int64_t width_px = 0;     // 0: the file is of this format but damaged
  int64_t height_px = 0;
};

// Reads no more than the head; nothing when the bytes are of no known format.
std::optional<StoredImageSize> FindImageSize(std::string_view bytes);

}  // namespace poselift
