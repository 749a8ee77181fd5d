// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace poselift {

// A picture as 8-bit BGR, turned upright by its EXIF orientation; deeper or
// grey ones are converted, transparency is dropped. JPEG, PNG, BMP, TIFF, WebP
// and PBM/PGM/PPM, told by their first bytes, whatever the file's name.
// Throws InputError for what is no such file, is damaged, or has more than
// kMaxImagePixels: the size is read before anything of that size is allocated.
// stderr is silent for the moment of decoding (see quiet_stderr.h).
inline constexpr double kMaxImagePixels = 200e6;
cv::Mat ReadImage(const std::filesystem::path& path);

// Atomically (see atomic_file.h); throws InputError when it cannot be written.
// picture: 8-bit grey, BGR or BGRA, not empty.
void WritePng(const std::filesystem::path& path, const cv::Mat& picture);

}  // namespace poselift
