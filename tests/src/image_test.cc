// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real files of made-up pictures, whole, cut off, altered and turned by EXIF
// bytes written here by hand.
#include "src/io/image.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "src/input_error.h"
#include "src/io/image_size.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::ScratchDir;
using ::testing::ThrowsMessage;
using testing::WriteScratch;

// 48 x 32, blue; its upper left quarter is red.
cv::Mat Flag() {
  cv::Mat flag(32, 48, CV_8UC3, cv::Scalar(255, 0, 0));
  flag(cv::Rect(0, 0, 24, 16)) = cv::Scalar(0, 0, 255);
  return flag;
}

std::string Encoded(const std::string& ending, const cv::Mat& picture) {
  std::vector<uchar> bytes;
  cv::imencode(ending, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

// A JPEG with an APP1 segment that holds one EXIF tag: 0x0112, orientation.
std::string JpegWithOrientation(char orientation) {
  using namespace std::string_literals;
  const std::string tiff = "II*\0\x08\0\0\0"s + "\x01\0"s + "\x12\x01\x03\0\x01\0\0\0"s +
                           std::string(1, orientation) + "\0\0\0"s + "\0\0\0\0"s;
  const std::string payload = "Exif\0\0"s + tiff;
  const auto length = static_cast<char>(payload.size() + 2);
  const std::string jpeg = Encoded(".jpg", Flag());
  return jpeg.substr(0, 2) + "\xFF\xE1\0"s + length + payload + jpeg.substr(2);
}

bool IsRed(const cv::Mat& image, int x, int y) {
  const auto& bgr = image.at<cv::Vec3b>(y, x);
  return bgr[2] > 180 && bgr[0] < 80;
}

TEST(Image, ExifOrientationTurnsThePicture) {
  struct Case {
    char orientation;
    cv::Size size;
    cv::Point red;  // in the middle of the red quarter
  };
  const Case cases[] = {{1, {48, 32}, {12, 8}},  {2, {48, 32}, {36, 8}}, {3, {48, 32}, {36, 24}},
                        {4, {48, 32}, {12, 24}}, {5, {32, 48}, {8, 12}}, {6, {32, 48}, {24, 12}},
                        {7, {32, 48}, {24, 36}}, {8, {32, 48}, {8, 36}}, {9, {48, 32}, {12, 8}},
                        {0, {48, 32}, {12, 8}}};
  for (const Case& c : cases) {
    const std::string path = WriteScratch("turned.jpg", JpegWithOrientation(c.orientation));
    const cv::Mat image = ReadImage(path);
    ASSERT_EQ(image.size(), c.size) << int(c.orientation);
    int red_quarters = 0;
    for (const int x : {image.cols / 4, 3 * image.cols / 4})
      for (const int y : {image.rows / 4, 3 * image.rows / 4}) red_quarters += IsRed(image, x, y);
    EXPECT_EQ(red_quarters, 1) << int(c.orientation);
    EXPECT_TRUE(IsRed(image, c.red.x, c.red.y)) << int(c.orientation);
  }
}

TEST(Image, EveryFormatIsReadAsBgrWhateverItsName) {
  for (const std::string ending : {".jpg", ".png", ".bmp", ".tiff", ".webp", ".ppm"}) {
    const std::string bytes = Encoded(ending, Flag());
    const auto size = FindImageSize(bytes);
    ASSERT_TRUE(size) << ending;
    EXPECT_EQ(size->width_px, 48) << ending;
    EXPECT_EQ(size->height_px, 32) << ending;
    const cv::Mat image = ReadImage(WriteScratch("picture.dat", bytes));
    EXPECT_EQ(image.type(), CV_8UC3) << ending;
    EXPECT_TRUE(IsRed(image, 12, 8)) << ending;
    EXPECT_FALSE(IsRed(image, 36, 8)) << ending;
  }
}

TEST(Image, DeepGreyAndTransparentPicturesBecomeBgr) {
  const cv::Mat pictures[] = {cv::Mat(20, 30, CV_8UC1, cv::Scalar(128)),
                              cv::Mat(20, 30, CV_16UC3, cv::Scalar::all(32896)),
                              cv::Mat(20, 30, CV_16UC1, cv::Scalar(32896)),
                              cv::Mat(20, 30, CV_8UC4, cv::Scalar(128, 128, 128, 0))};
  for (const cv::Mat& picture : pictures) {
    const cv::Mat image = ReadImage(WriteScratch("picture.png", Encoded(".png", picture)));
    ASSERT_EQ(image.type(), CV_8UC3);
    EXPECT_EQ(image.at<cv::Vec3b>(10, 10), cv::Vec3b(128, 128, 128));
  }
}

TEST(Image, ErrorsNameTheFileAndWhatItIs) {
  const fs::path dir = ScratchDir();
  const auto read = [](const fs::path& path) { return [path] { ReadImage(path); }; };
  EXPECT_THAT(read(dir / "none.png"), ThrowsMessage<InputError>(HasSubstr("none.png: no such")));
  EXPECT_THAT(read(dir), ThrowsMessage<InputError>(HasSubstr("is a folder")));
  EXPECT_THAT(read(WriteScratch("empty.png", "")), ThrowsMessage<InputError>(HasSubstr("empty")));
  EXPECT_THAT(read(WriteScratch("text.png", "hello")),
              ThrowsMessage<InputError>(HasSubstr("is no picture; wanted JPEG")));
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(read(dir / "pipe"), ThrowsMessage<InputError>(HasSubstr("no ordinary file")));
}

TEST(Image, GiganticPictureIsRefusedByItsHead) {
  std::string png = Encoded(".png", Flag());
  png[17] = '\x01';  // 65584 x 65568
  png[21] = '\x01';
  EXPECT_THAT([&] { ReadImage(WriteScratch("huge.png", png)); },
              ThrowsMessage<InputError>(HasSubstr("65584 x 65568 pixels")));
  EXPECT_THAT([&] { ReadImage(WriteScratch("huge.ppm", "P6\n999999999 999999999\n255\n")); },
              ThrowsMessage<InputError>(HasSubstr("at most 200 million")));
}

TEST(Image, CutOffFilesAreRefusedOrKeepTheirSize) {
  for (const std::string ending : {".jpg", ".png", ".bmp", ".tiff", ".webp", ".ppm"}) {
    const std::string bytes = Encoded(ending, Flag());
    int refused = 0;
    for (size_t size = 1; size < bytes.size(); size += 1 + bytes.size() / 60) {
      try {
        const cv::Mat image = ReadImage(WriteScratch("cut", bytes.substr(0, size)));
        EXPECT_EQ(image.size(), Flag().size()) << ending;
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 3) << ending;
  }
}

TEST(Image, AlteredFilesThrowInputErrorOrGiveAPicture) {
  auto rng = testing::TestRng();
  for (const std::string ending : {".jpg", ".png", ".bmp", ".tiff", ".webp", ".ppm"}) {
    const std::string whole = Encoded(ending, Flag());
    for (int trial = 0; trial < 60; ++trial) {
      std::string bytes = whole;
      for (int k = 0; k < 3; ++k)
        bytes[rng() % std::min<size_t>(bytes.size(), 200)] = static_cast<char>(rng());
      try {
        const cv::Mat image = ReadImage(WriteScratch("altered", bytes));
        EXPECT_FALSE(image.empty());
        EXPECT_EQ(image.type(), CV_8UC3);
        EXPECT_LE(1.0 * image.cols * image.rows, kMaxImagePixels);
      } catch (const InputError&) {
      }
    }
  }
}

TEST(Image, DamagedPicturePrintsNothingAndStderrComesBack) {
  const std::string png = Encoded(".png", Flag());
  const std::string path = WriteScratch("cut.png", png.substr(0, png.size() / 2));
  ::testing::internal::CaptureStderr();
  EXPECT_THROW(ReadImage(path), InputError);
  std::cerr << "after";
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "after");
}

TEST(Image, SizeOfAnyHeadIsFoundWithoutReadingPastIt) {
  using namespace std::string_literals;
  for (const std::string& head :
       {"\xFF\xD8\xFF"s, "\x89PNG\r\n\x1A\n"s, "BM"s, "II*\0"s, "MM\0*"s, "P6\n"s, "P5 #"s,
        "RIFF\0\0\0\0WEBP"s, "\xFF\xD8\xFF\xC0\0"s, "II*\0\xFF\xFF\xFF\xFF\xFF\xFF"s}) {
    const auto size = FindImageSize(head);
    EXPECT_TRUE(!size || size->width_px == 0 || size->height_px == 0) << head;
  }
  EXPECT_FALSE(FindImageSize(""));
  EXPECT_FALSE(FindImageSize("P7\n"));
}

TEST(Image, PngThatIsWrittenReadsBackTheSame) {
  const fs::path path = ScratchDir() / "flag.png";
  std::ofstream(path) << "what stood there before";
  WritePng(path, Flag());
  EXPECT_EQ(cv::norm(ReadImage(path), Flag(), cv::NORM_INF), 0.0);
  for (const auto& entry : fs::directory_iterator(ScratchDir()))
    EXPECT_EQ(entry.path(), path);  // no temporary file stays
}

TEST(Image, PngIntoAMissingFolderIsAnInputErrorAndNoPictureIsABug) {
  EXPECT_THROW(WritePng(ScratchDir() / "none" / "flag.png", Flag()), InputError);
  EXPECT_THROW(WritePng(ScratchDir() / "flag.png", cv::Mat()), std::invalid_argument);
  EXPECT_THROW(WritePng(ScratchDir() / "flag.png", cv::Mat(2, 2, CV_32F)), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
