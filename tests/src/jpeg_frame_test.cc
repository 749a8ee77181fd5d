// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Raw frames are painted here byte by byte and must come back, through JPEG and OpenCV's
// decoder, as the picture that cv::cvtColor makes of them. MJPG frames are OpenCV's JPEGs, from
// which the parts are cut that webcams leave away; damaged ones must be refused.
#include "src/io/jpeg_frame.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Bytes = std::vector<uint8_t>;

const cv::Size kSize_px(64, 48);

// Bytes of a frame whose levels are those of video and change slowly.
Bytes SmoothFrame(size_t length) {
  Bytes frame(length);
  for (size_t i = 0; i < length; ++i)
    frame[i] = static_cast<uint8_t>(i % 2 == 0 ? 20 + i * 200 / length : 100 + i * 50 / length);
  return frame;
}

struct RawKind {
  uint32_t fourcc;
  int rows_of_mat, type, to_bgr;
  const char* name;
};

class RawFrame : public ::testing::TestWithParam<RawKind> {
 protected:
  RawFormat Format() const { return {GetParam().fourcc, kSize_px}; }
  int Rows() const { return GetParam().rows_of_mat; }
  int RowBytes() const { return kSize_px.width * static_cast<int>(CV_ELEM_SIZE(GetParam().type)); }
  Bytes Frame() const { return SmoothFrame(static_cast<size_t>(Rows() * RowBytes())); }
};

TEST_P(RawFrame, HasTheColoursOfCvtColor) {
  Bytes frame = Frame();
  cv::Mat wanted;
  cv::cvtColor(cv::Mat(Rows(), kSize_px.width, GetParam().type, frame.data()), wanted,
               GetParam().to_bgr);
  JpegEncoder encoder(Format(), 98);
  Bytes jpeg;
  ASSERT_TRUE(encoder.Encode(frame, &jpeg));
  const cv::Mat found = cv::imdecode(jpeg, cv::IMREAD_COLOR);
  ASSERT_EQ(found.size(), kSize_px);
  EXPECT_LT(cv::norm(found, wanted, cv::NORM_L1) / static_cast<double>(wanted.total() * 3), 2.0);
  EXPECT_GT(cv::norm(wanted, cv::NORM_INF), 150.0);
}

TEST_P(RawFrame, IsReadInItsStride) {
  const Bytes tight = Frame();
  const int stride = RowBytes() + 13;
  Bytes wide(static_cast<size_t>(Rows() * stride), 77);
  for (int row = 0; row < Rows(); ++row)
    std::copy_n(tight.begin() + row * RowBytes(), RowBytes(), wide.begin() + row * stride);
  Bytes jpeg, jpeg_of_wide;
  ASSERT_TRUE(JpegEncoder(Format()).Encode(tight, &jpeg));
  ASSERT_TRUE(JpegEncoder({GetParam().fourcc, kSize_px, stride}).Encode(wide, &jpeg_of_wide));
  EXPECT_EQ(jpeg, jpeg_of_wide);
}

TEST_P(RawFrame, IsRefusedWhenShort) {
  JpegEncoder encoder(Format());
  Bytes frame = Frame(), jpeg;
  frame.resize(frame.size() + 100);  // more than wanted is padding
  EXPECT_TRUE(encoder.Encode(frame, &jpeg));
  frame.resize(Frame().size() - 1);
  EXPECT_FALSE(encoder.Encode(frame, &jpeg));
  EXPECT_TRUE(jpeg.empty());
  EXPECT_FALSE(encoder.Encode({}, &jpeg));
}

TEST_P(RawFrame, IsNotOfSuchSizeOrQuality) {
  const uint32_t fourcc = GetParam().fourcc;
  EXPECT_THROW(JpegEncoder({fourcc, {0, 48}}), std::invalid_argument);
  EXPECT_THROW(JpegEncoder(Format(), 0), std::invalid_argument);
  EXPECT_THROW(JpegEncoder({fourcc, kSize_px, 63}), std::invalid_argument);
  EXPECT_THROW(JpegEncoder({V4L2_PIX_FMT_RGB24, kSize_px}), std::invalid_argument);
  if (fourcc != V4L2_PIX_FMT_GREY) {
    EXPECT_THROW(JpegEncoder({fourcc, {63, 48}}), std::invalid_argument);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RawFrame,
                         ::testing::Values(RawKind{V4L2_PIX_FMT_YUYV, kSize_px.height, CV_8UC2,
                                                   cv::COLOR_YUV2BGR_YUYV, "Yuyv"},
                                           RawKind{V4L2_PIX_FMT_NV12, kSize_px.height * 3 / 2,
                                                   CV_8UC1, cv::COLOR_YUV2BGR_NV12, "Nv12"},
                                           RawKind{V4L2_PIX_FMT_GREY, kSize_px.height, CV_8UC1,
                                                   cv::COLOR_GRAY2BGR, "Grey"}),
                         [](const auto& kind) { return kind.param.name; });

Bytes Jpeg() {
  auto rng = testing::TestRng();
  Bytes jpeg;
  cv::imencode(".jpg", testing::Texture(kSize_px, &rng), jpeg);
  return jpeg;
}

// The segments of Huffman tables, taken out of a JPEG; they lie one behind the other in it.
Bytes CutTables(Bytes* jpeg) {
  Bytes tables;
  for (size_t at = 2; at + 4 < jpeg->size() && (*jpeg)[at + 1] != 0xda;) {
    const size_t length = 2 + static_cast<size_t>((*jpeg)[at + 2] << 8 | (*jpeg)[at + 3]);
    const auto begin = jpeg->begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = begin + static_cast<std::ptrdiff_t>(length);
    if ((*jpeg)[at + 1] == 0xc4) {
      tables.insert(tables.end(), begin, end);
      jpeg->erase(begin, end);
    } else {
      at += length;
    }
  }
  return tables;
}

// Of what Encode makes of it; empty when it refuses.
Bytes Encoded(const Bytes& frame, cv::Size size_px = kSize_px) {
  Bytes jpeg;
  const bool whole = JpegEncoder({V4L2_PIX_FMT_MJPEG, size_px}).Encode(frame, &jpeg);
  EXPECT_EQ(whole, !jpeg.empty());
  return jpeg;
}

TEST(MjpgFrame, StaysAsItCame) { EXPECT_EQ(Encoded(Jpeg()), Jpeg()); }

TEST(MjpgFrame, GetsTheStandardTablesItLacks) {
  Bytes bare = Jpeg();
  const Bytes tables = CutTables(&bare);
  ASSERT_EQ(tables.size(), 432u);  // ITU T.81 K.3: 2 x 12 and 2 x 162 codes
  Bytes whole = Encoded(bare);
  EXPECT_EQ(CutTables(&whole), tables);
  EXPECT_EQ(whole, bare);
}

TEST(MjpgFrame, LosesItsPaddingAndGetsItsEnd) {
  Bytes padded = Jpeg();
  padded.resize(padded.size() + 300, 0);
  EXPECT_EQ(Encoded(padded), Jpeg());
  Bytes endless = Jpeg();
  endless.resize(endless.size() - 2);
  EXPECT_EQ(Encoded(endless), Jpeg());
}

TEST(MjpgFrame, IsRefusedWhereItsHeadEnds) {
  const Bytes whole = Jpeg();
  constexpr uint8_t kScan[] = {0xff, 0xda};
  const auto scan = std::search(whole.begin(), whole.end(), std::begin(kScan), std::end(kScan));
  const size_t head = static_cast<size_t>(scan - whole.begin()) + 14;  // with that of the scan
  for (size_t length = 0; length < head; ++length)
    EXPECT_TRUE(
        Encoded({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}).empty())
        << length;
  EXPECT_FALSE(
      Encoded({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(head + 40)}).empty());
}

TEST(MjpgFrame, IsRefusedInAnotherSizeAndOfAnotherKind) {
  EXPECT_TRUE(Encoded(Jpeg(), {48, 64}).empty());
  EXPECT_TRUE(Encoded(Bytes(5000, 0)).empty());
  EXPECT_TRUE(Encoded(Bytes(5000, 0xff)).empty());
}

// Whatever the damage: refused, or a picture between its two marks.
TEST(MjpgFrame, SurvivesDamage) {
  const Bytes whole = Jpeg();
  auto rng = testing::TestRng();
  const auto copies = testing::DamagedCopies({whole.begin(), whole.end()}, 2000, &rng);
  int accepted = 0;
  for (const std::string& copy : copies) {
    const Bytes jpeg = Encoded({copy.begin(), copy.end()});
    if (jpeg.empty()) continue;
    ++accepted;
    ASSERT_GE(jpeg.size(), 4u);
    EXPECT_EQ(jpeg[0] << 8 | jpeg[1], 0xffd8);
    EXPECT_EQ(jpeg[jpeg.size() - 2] << 8 | jpeg.back(), 0xffd9);
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, static_cast<int>(copies.size()) - 100);
}

}  // namespace
}  // namespace poselift
