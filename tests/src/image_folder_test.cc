// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Folders of pictures that are written here, each of a grey that tells its number; broken
// pictures, and ones of another size, must be named.
#include "src/io/image_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "src/input_error.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using testing::ScratchDir;

void WritePicture(const fs::path& path, int grey, cv::Size size_px = {32, 16}) {
  cv::imwrite(path, cv::Mat(size_px, CV_8UC3, cv::Scalar::all(grey)));
}

std::string NameOf(int i) { return "img" + std::to_string(i) + (i % 2 ? ".png" : ".BMP"); }

TEST(ImageFolder, GivesPicturesInNaturalOrder) {
  const fs::path folder = ScratchDir();
  for (const int i : {10, 2, 1, 100}) WritePicture(folder / NameOf(i), i);
  std::ofstream(folder / "notes.txt") << "no picture";
  std::ofstream(folder / ".hidden.png") << "no picture";
  fs::create_directory(folder / "deeper.png");
  ImageFolder source(folder, 10.0);
  EXPECT_EQ(source.size_px(), cv::Size(32, 16));
  int index = 0;
  for (const int i : {1, 2, 10, 100}) {
    const auto frame = source.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->bgr.at<cv::Vec3b>(3, 3)[0], i);
    EXPECT_EQ(frame->index, index);
    EXPECT_DOUBLE_EQ(frame->time_s, 0.1 * index);
    EXPECT_TRUE(frame->grey.empty());
    EXPECT_TRUE(std::isnan(frame->monotonic_s));
    EXPECT_EQ(source.files()[static_cast<size_t>(index)].filename(), NameOf(i));
    ++index;
  }
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Skip_s());
}

TEST(ImageFolder, SkipsWithoutReading) {
  const fs::path folder = ScratchDir();
  WritePicture(folder / "1.png", 1);
  std::ofstream(folder / "2.png") << "broken";
  WritePicture(folder / "3.png", 3);
  ImageFolder source(folder, 1.0, Pictures::kBoth);
  EXPECT_DOUBLE_EQ(source.Skip_s().value(), 0.0);
  EXPECT_DOUBLE_EQ(source.Skip_s().value(), 1.0);
  const auto frame = source.Next();
  EXPECT_DOUBLE_EQ(frame.value().time_s, 2.0);
  EXPECT_EQ(frame->grey.at<uchar>(3, 3), 3);
  EXPECT_EQ(frame->bgr.at<cv::Vec3b>(3, 3)[2], 3);
}

// A JPEG whose EXIF says that it is to be turned by a quarter.
std::string LyingJpeg() {
  std::vector<uchar> bytes;
  cv::imencode(".jpg", cv::Mat(16, 32, CV_8UC3, cv::Scalar::all(9)), bytes);
  const std::string exif(
      "\xff\xe1\0\x22"
      "Exif\0\0"
      "MM\0\x2a\0\0\0\x08"
      "\0\1"
      "\1\x12\0\3\0\0\0\1\0\6\0\0"
      "\0\0\0\0",
      36);
  const std::string jpeg(bytes.begin(), bytes.end());
  return jpeg.substr(0, 2) + exif + jpeg.substr(2);
}

TEST(ImageFolder, TurnsPicturesUpright) {
  const fs::path folder = ScratchDir();
  std::ofstream(folder / "a.jpg", std::ios::binary) << LyingJpeg();
  EXPECT_EQ(ImageFolder(folder).size_px(), cv::Size(16, 32));
}

TEST(ImageFolder, NamesThePictureThatIsWrong) {
  const auto complaint = [](const fs::path& folder, double rate_hz = 1.0) -> std::string {
    try {
      ImageFolder source(folder, rate_hz);
      while (source.Next()) {
      }
    } catch (const InputError& error) {
      return error.what();
    }
    return "(read without complaint)";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const fs::path folder = ScratchDir();
  EXPECT_TRUE(has(complaint(folder), "has no pictures"));
  EXPECT_TRUE(has(complaint(folder / "absent"), "is no folder"));
  WritePicture(folder / "1.png", 1);
  EXPECT_TRUE(has(complaint(folder), "without complaint"));
  EXPECT_TRUE(has(complaint(folder, 0.0), "a rate of 0 Hz"));
  WritePicture(folder / "2.png", 2, {16, 32});
  EXPECT_TRUE(has(complaint(folder), "2.png: found 16 x 32 pixels, wanted 32 x 16 as in 1.png"));
  std::ofstream(folder / "2.png") << "broken";
  EXPECT_TRUE(has(complaint(folder), "2.png: is no picture"));
}

TEST(NaturalOrder, IsAnOrder) {
  std::vector<std::string> names = {"img",
                                    "img1",
                                    "img01",
                                    "img2",
                                    "img10",
                                    "img10a",
                                    "img10b2",
                                    "img10b10",
                                    "Z",
                                    "1",
                                    "02",
                                    "2",
                                    "",
                                    "a1b",
                                    "a1",
                                    "99999999999999999999999999",
                                    "100000000000000000000000000"};
  auto rng = testing::TestRng();
  std::shuffle(names.begin(), names.end(), rng);
  for (const auto& a : names)
    for (const auto& b : names)
      EXPECT_EQ(a == b, !IsNaturallyBefore(a, b) && !IsNaturallyBefore(b, a));
  std::sort(names.begin(), names.end(), IsNaturallyBefore);
  EXPECT_EQ(names, (std::vector<std::string>{"", "1", "02", "2", "99999999999999999999999999",
                                             "100000000000000000000000000", "Z", "a1", "a1b", "img",
                                             "img01", "img1", "img2", "img10", "img10a", "img10b2",
                                             "img10b10"}));
}

}  // namespace
}  // namespace poselift
