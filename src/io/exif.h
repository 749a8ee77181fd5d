// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>

namespace poselift {

// The focal length that a camera wrote into its picture (EXIF 2.32), pixels of a picture of that
// size. By the length that shows as much on film of 36 x 24 mm (FocalLengthIn35mmFilm; along the
// diagonal, CIPA DCG-001)
//   f_px = f_35 hypot(width, height) / hypot(36, 24)
// else by the lens and the sensor's pixels (FocalPlaneXResolution)
//   f_px = f_mm pixels_per_mm max(width, height) / max(PixelXDimension, PixelYDimension)
// A few per cent off; wrong for pictures that were cropped. Nothing where the file says neither.
std::optional<double> ExifFocalLength_px(const std::filesystem::path& path, int width_px,
                                         int height_px);

}  // namespace poselift
