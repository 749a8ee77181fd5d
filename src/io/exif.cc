// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/exif.h"

#include <libexif/exif-data.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace poselift {
namespace {

using Exif = std::unique_ptr<ExifData, decltype(&exif_data_unref)>;

// The first value of a tag; 0 where it is missing or of another kind, as EXIF says "unknown".
double ValueOf(const Exif& exif, ExifTag tag) {
  const ExifEntry* const entry = exif_content_get_entry(exif->ifd[EXIF_IFD_EXIF], tag);
  if (!entry || !entry->data || entry->components < 1) return 0.0;
  if (entry->size < exif_format_get_size(entry->format)) return 0.0;
  const ExifByteOrder order = exif_data_get_byte_order(exif.get());
  switch (entry->format) {
    case EXIF_FORMAT_SHORT:
      return exif_get_short(entry->data, order);
    case EXIF_FORMAT_LONG:
      return exif_get_long(entry->data, order);
    case EXIF_FORMAT_RATIONAL: {
      const ExifRational value = exif_get_rational(entry->data, order);
      return value.denominator == 0 ? 0.0
                                    : static_cast<double>(value.numerator) / value.denominator;
    }
    default:
      return 0.0;
  }
}

// Of the sensor; 0 where nobody says.
double PixelsPerMm(const Exif& exif) {
  constexpr double kInches = 2.0, kCentimetres = 3.0;
  const double resolution = ValueOf(exif, EXIF_TAG_FOCAL_PLANE_X_RESOLUTION);
  const double unit = ValueOf(exif, EXIF_TAG_FOCAL_PLANE_RESOLUTION_UNIT);
  if (unit == kCentimetres) return resolution / 10.0;
  return unit == kInches || unit == 0.0 ? resolution / 25.4 : 0.0;
}

}  // namespace

std::optional<double> ExifFocalLength_px(const std::filesystem::path& path, int width_px,
                                         int height_px) {
  const Exif exif(exif_data_new_from_file(path.c_str()), &exif_data_unref);
  if (!exif) return std::nullopt;
  double focal_px = ValueOf(exif, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM) *
                    std::hypot(width_px, height_px) / std::hypot(36.0, 24.0);
  if (!(focal_px > 0.0)) {
    const double taken_px = std::max(ValueOf(exif, EXIF_TAG_PIXEL_X_DIMENSION),
                                     ValueOf(exif, EXIF_TAG_PIXEL_Y_DIMENSION));
    const double per_mm = PixelsPerMm(exif);
    if (taken_px > 0.0)
      focal_px =
          ValueOf(exif, EXIF_TAG_FOCAL_LENGTH) * per_mm * std::max(width_px, height_px) / taken_px;
  }
  if (!(focal_px > 0.0) || !std::isfinite(focal_px)) return std::nullopt;
  return focal_px;
}

}  // namespace poselift
