// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: JPEG files that begin with EXIF and hold no picture.
#include "src/io/exif.h"

#include <gtest/gtest.h>
#include <libexif/exif-data.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>

#include "tests/support/reader_tables.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

class ExifTest : public ::testing::Test {
 protected:
  ExifTest() : exif_(exif_data_new(), &exif_data_unref) {
    exif_data_set_byte_order(exif_.get(), EXIF_BYTE_ORDER_INTEL);
  }
  ExifEntry* Add(ExifTag tag, ExifFormat format) {
    ExifEntry* const entry = exif_entry_new();
    exif_content_add_entry(exif_->ifd[EXIF_IFD_EXIF], entry);
    entry->tag = tag;
    entry->format = format;
    entry->components = 1;
    entry->size = exif_format_get_size(format);
    entry->data = static_cast<unsigned char*>(std::calloc(1, entry->size));
    exif_entry_unref(entry);
    return entry;
  }
  void AddShort(ExifTag tag, ExifShort value) {
    exif_set_short(Add(tag, EXIF_FORMAT_SHORT)->data, EXIF_BYTE_ORDER_INTEL, value);
  }
  void AddRational(ExifTag tag, ExifRational value) {
    exif_set_rational(Add(tag, EXIF_FORMAT_RATIONAL)->data, EXIF_BYTE_ORDER_INTEL, value);
  }
  std::string Jpeg() const {
    unsigned char* data = nullptr;
    unsigned int size = 0;
    exif_data_save_data(exif_.get(), &data, &size);
    const std::string payload(reinterpret_cast<char*>(data), size);
    std::free(data);
    const size_t length = payload.size() + 2;
    return std::string("\xFF\xD8\xFF\xE1") + static_cast<char>(length / 256) +
           static_cast<char>(length % 256) + payload + "\xFF\xD9";
  }
  static std::optional<double> Focal_px(const std::string& jpeg, int width_px, int height_px) {
    const auto path = testing::ScratchDir() / "picture.jpg";
    testing::WriteBytes(path, jpeg);
    return ExifFocalLength_px(path, width_px, height_px);
  }

  std::unique_ptr<ExifData, decltype(&exif_data_unref)> exif_;
};

// Along the diagonal: turned and scaled pictures see as much.
TEST_F(ExifTest, TheLengthOnFilmIsThatOfThePicturesDiagonal) {
  AddShort(EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM, 28);
  const double per_diagonal = 28.0 / std::hypot(36.0, 24.0);
  EXPECT_NEAR(*Focal_px(Jpeg(), 3600, 2400), 2800.0, 1e-6);
  EXPECT_NEAR(*Focal_px(Jpeg(), 3000, 4000), 5000.0 * per_diagonal, 1e-6);
  EXPECT_NEAR(*Focal_px(Jpeg(), 300, 400), 500.0 * per_diagonal, 1e-6);
}

TEST_F(ExifTest, ALensAndTheSensorsPixelsWillDo) {
  AddRational(EXIF_TAG_FOCAL_LENGTH, {50, 1});
  AddRational(EXIF_TAG_FOCAL_PLANE_X_RESOLUTION, {2540 * 2, 1});  // 200 a millimetre
  AddShort(EXIF_TAG_FOCAL_PLANE_RESOLUTION_UNIT, 2);
  EXPECT_FALSE(Focal_px(Jpeg(), 3000, 2000));  // of how many pixels nobody knows
  AddShort(EXIF_TAG_PIXEL_X_DIMENSION, 6000);
  AddShort(EXIF_TAG_PIXEL_Y_DIMENSION, 4000);
  EXPECT_NEAR(*Focal_px(Jpeg(), 6000, 4000), 10000.0, 1e-6);
  EXPECT_NEAR(*Focal_px(Jpeg(), 2000, 3000), 5000.0, 1e-6);
}

TEST_F(ExifTest, WhatIsNotSaidIsNotKnown) {
  EXPECT_FALSE(Focal_px(Jpeg(), 640, 480));
  EXPECT_FALSE(Focal_px("no picture", 640, 480));
  EXPECT_FALSE(ExifFocalLength_px(testing::ScratchDir() / "none.jpg", 640, 480));
  AddShort(EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM, 0);  // EXIF's word for unknown
  AddRational(EXIF_TAG_FOCAL_LENGTH, {50, 0});
  EXPECT_FALSE(Focal_px(Jpeg(), 640, 480));
}

TEST_F(ExifTest, DamageGivesNothingOrAFiniteLength) {
  AddShort(EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM, 28);
  AddRational(EXIF_TAG_FOCAL_LENGTH, {50, 1});
  const std::string whole = Jpeg();
  std::mt19937 rng(1);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) damaged[rng() % damaged.size()] = static_cast<char>(rng() % 256);
    damaged.resize(1 + rng() % damaged.size());
    const double focal_px = Focal_px(damaged, 640, 480).value_or(1.0);
    EXPECT_TRUE(std::isfinite(focal_px) && focal_px > 0.0);
  }
}

}  // namespace
}  // namespace poselift
