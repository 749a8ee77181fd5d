// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Pictures are put into the formats of cameras here, by plain loops, and must come back as
// they were. Bytes that are short, of another size, damaged or random must be refused or give
// a picture of the right size: no crash, nothing read outside (seen by the sanitizers).
#include "src/capture/frame_decoder.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "src/capture/fourcc.h"
#include "tests/support/fake_camera.h"
#include "tests/support/made_up_video.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::AsJpeg;
using testing::AsNv12;
using testing::AsYuyv;
using testing::GreyRamp;
using testing::TestRng;

const cv::Size kSize_px(64, 48);

// Exactly as many bytes on the heap, so that a sanitizer sees what is read behind them.
cv::Mat Bytes(const std::string& text) {
  return cv::Mat(1, static_cast<int>(text.size()), CV_8UC1, const_cast<char*>(text.data())).clone();
}

double MaxDifference(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() ? cv::norm(a, b, cv::NORM_INF) : 1e9;
}

struct Kind {
  const char* name;
  RawFormat format;
  std::string bytes;
  double tolerance;  // of the grey levels
};

std::vector<Kind> Kinds() {
  const cv::Mat grey = GreyRamp(kSize_px);
  std::string padded_grey;
  for (int y = 0; y < grey.rows; ++y)
    padded_grey += std::string(grey.ptr<char>(y), 64) + std::string(16, '\xee');
  return {{"grey", {kFourccGrey, kSize_px}, std::string(grey.ptr<char>(), grey.total()), 0.0},
          {"padded grey", {kFourccGrey, kSize_px, 80}, padded_grey, 0.0},
          {"nv12", {kFourccNv12, kSize_px}, AsNv12(grey), 0.0},
          {"padded nv12", {kFourccNv12, kSize_px, 96}, AsNv12(grey, 96), 0.0},
          {"yuyv", {kFourccYuyv, kSize_px}, AsYuyv(grey), 0.0},
          {"padded yuyv", {kFourccYuyv, kSize_px, 160}, AsYuyv(grey, 160), 0.0},
          {"jpeg", {kFourccMjpg, kSize_px}, AsJpeg(grey), 4.0},
          {"restarted jpeg", {kFourccMjpg, kSize_px}, AsJpeg(grey, 2), 4.0}};
}

TEST(FrameDecoder, GivesGreyAsItWas) {
  FrameDecoder decoder;
  for (const Kind& kind : Kinds()) {
    cv::Mat grey;
    EXPECT_EQ(decoder.ToGrey(kind.format, Bytes(kind.bytes), &grey), "") << kind.name;
    EXPECT_LE(MaxDifference(grey, GreyRamp(kSize_px)), kind.tolerance) << kind.name;
  }
}

// Y of a video signal goes from 16 to 235, and that of JPEG from 0 to 255.
TEST(FrameDecoder, GivesColoursOfGrey) {
  FrameDecoder decoder;
  cv::Mat ramp, stretched;
  cv::cvtColor(GreyRamp(kSize_px), ramp, cv::COLOR_GRAY2BGR);
  ramp.convertTo(stretched, -1, 255.0 / 219.0, -16.0 * 255.0 / 219.0);
  for (const Kind& kind : Kinds()) {
    cv::Mat bgr;
    EXPECT_EQ(decoder.ToBgr(kind.format, Bytes(kind.bytes), &bgr), "") << kind.name;
    const bool is_signal = kind.format.fourcc == kFourccYuyv || kind.format.fourcc == kFourccNv12;
    EXPECT_LE(MaxDifference(bgr, is_signal ? stretched : ramp), kind.tolerance + 1.0) << kind.name;
  }
}

TEST(FrameDecoder, GivesColours) {
  // Red, by BT.601: Y 81, U 90, V 240.
  std::string yuyv, nv12(64 * 48, '\x51');
  for (int i = 0; i < 64 * 48 / 2; ++i) yuyv += "\x51\x5a\x51\xf0";
  for (int i = 0; i < 32 * 24; ++i) nv12 += "\x5a\xf0";
  const std::string jpeg = AsJpeg(cv::Mat(kSize_px, CV_8UC3, cv::Scalar(0, 0, 255)));
  FrameDecoder decoder;
  for (const auto& [fourcc, bytes] :
       {std::pair(kFourccYuyv, yuyv), {kFourccNv12, nv12}, {kFourccMjpg, jpeg}}) {
    cv::Mat bgr;
    ASSERT_EQ(decoder.ToBgr({fourcc, kSize_px}, Bytes(bytes), &bgr), "");
    const cv::Scalar mean = cv::mean(bgr);
    EXPECT_NEAR(mean[0], 0.0, 3.0) << FourccText(fourcc);
    EXPECT_NEAR(mean[1], 0.0, 3.0) << FourccText(fourcc);
    EXPECT_NEAR(mean[2], 255.0, 3.0) << FourccText(fourcc);
  }
}

TEST(FrameDecoder, GivesGreyWithoutACopyWhereItIsThere) {
  FrameDecoder decoder;
  for (const Kind& kind : Kinds()) {
    const cv::Mat bytes = Bytes(kind.bytes);
    cv::Mat grey;
    ASSERT_EQ(decoder.ToGrey(kind.format, bytes, &grey), "") << kind.name;
    const bool has_plane = kind.format.fourcc == kFourccGrey || kind.format.fourcc == kFourccNv12;
    EXPECT_EQ(grey.data == bytes.data, has_plane) << kind.name;
  }
}

// The memory lives as long as the picture does.
TEST(FrameDecoder, GreyOutlivesItsBytes) {
  FrameDecoder decoder;
  cv::Mat grey;
  {
    const cv::Mat bytes = Bytes(AsNv12(GreyRamp(kSize_px)));
    ASSERT_EQ(decoder.ToGrey({kFourccNv12, kSize_px}, bytes, &grey), "");
  }
  EXPECT_EQ(MaxDifference(grey, GreyRamp(kSize_px)), 0.0);
}

TEST(FrameDecoder, ReadsJpegWithoutHuffmanTables) {
  const std::string jpeg = AsJpeg(GreyRamp(kSize_px));
  const std::string without = testing::WithoutHuffmanTables(jpeg);
  ASSERT_LT(without.size(), jpeg.size());
  FrameDecoder decoder;
  cv::Mat with_tables, picture;
  ASSERT_EQ(decoder.ToGrey({kFourccMjpg, kSize_px}, Bytes(jpeg), &with_tables), "");
  ASSERT_EQ(decoder.ToGrey({kFourccMjpg, kSize_px}, Bytes(without), &picture), "");
  EXPECT_EQ(MaxDifference(picture, with_tables), 0.0);
  // Nor do the tables of one frame stay for the next.
  ASSERT_EQ(FrameDecoder().ToGrey({kFourccMjpg, kSize_px}, Bytes(without), &picture), "");
  EXPECT_EQ(MaxDifference(picture, with_tables), 0.0);
}

// Every cut: no part of a picture is given for the whole.
TEST(FrameDecoder, RefusesWhatIsShort) {
  FrameDecoder decoder;
  for (const Kind& kind : Kinds()) {
    // The padding of the last line need not be there, nor the end mark of a JPEG.
    const size_t idle = kind.format.bytes_per_line > 0      ? 32
                        : kind.format.fourcc == kFourccMjpg ? 2
                                                            : 0;
    for (size_t length = 0; length + idle < kind.bytes.size(); ++length) {
      cv::Mat picture;
      const cv::Mat bytes = Bytes(kind.bytes.substr(0, length));
      EXPECT_NE(decoder.ToGrey(kind.format, bytes, &picture), "") << kind.name << " " << length;
      EXPECT_NE(decoder.ToBgr(kind.format, bytes, &picture), "") << kind.name << " " << length;
    }
  }
}

TEST(FrameDecoder, TakesAFullBufferForAShorterJpeg) {
  const std::string padded = AsJpeg(GreyRamp(kSize_px)) + std::string(5000, '\0');
  cv::Mat picture;
  EXPECT_EQ(FrameDecoder().ToGrey({kFourccMjpg, kSize_px}, Bytes(padded), &picture), "");
}

TEST(FrameDecoder, RefusesJpegOfAnotherSize) {
  cv::Mat picture;
  const std::string flaw = FrameDecoder().ToGrey({kFourccMjpg, {1280, 720}},
                                                 Bytes(AsJpeg(GreyRamp(kSize_px))), &picture);
  EXPECT_NE(flaw.find("64 x 48"), std::string::npos) << flaw;
}

// The bytes of a strip and the marker behind it.
std::string WithoutStrip(const std::string& jpeg, char marker) {
  const size_t begin = jpeg.find(std::string("\xff") + marker);
  const size_t end = jpeg.find(std::string("\xff") + static_cast<char>(marker + 1));
  EXPECT_LT(begin, end);
  return jpeg.substr(0, begin) + jpeg.substr(end);
}

TEST(FrameDecoder, TellsIdleBytesFromMissingStrips) {
  auto rng = TestRng();
  const std::string jpeg = AsJpeg(testing::Texture({160, 120}, &rng), 4);
  const size_t marker = jpeg.find("\xff\xd3");
  ASSERT_NE(marker, std::string::npos);
  FrameDecoder decoder;
  cv::Mat whole, picture;
  const RawFormat format{kFourccMjpg, {160, 120}};
  ASSERT_EQ(decoder.ToGrey(format, Bytes(jpeg), &whole), "");
  std::string idle = jpeg;
  idle.insert(marker, 3, '\x55');
  EXPECT_EQ(decoder.ToGrey(format, Bytes(idle), &picture), "");
  EXPECT_EQ(MaxDifference(picture, whole), 0.0);
  EXPECT_NE(decoder.ToGrey(format, Bytes(WithoutStrip(jpeg, '\xd3')), &picture), "");
  EXPECT_NE(decoder.ToGrey(format, Bytes(WithoutStrip(idle, '\xd5')), &picture), "");
}

TEST(FrameDecoder, RefusesFormatsThatMakeNoSense) {
  FrameDecoder decoder;
  cv::Mat picture;
  const cv::Mat bytes = Bytes(std::string(10000, 'z'));
  for (const RawFormat& format :
       {RawFormat{kFourccYuyv, {63, 48}}, RawFormat{kFourccNv12, {64, 47}},
        RawFormat{kFourccGrey, {64, 48}, 60}, RawFormat{kFourccYuyv, {64, 48}, 64},
        RawFormat{kFourccGrey, {0, 48}}, RawFormat{kFourccGrey, {-4, 48}},
        RawFormat{kFourccGrey, {2000000000, 2000000000}},
        RawFormat{kFourccMjpg, {1 << 20, 1 << 20}}, RawFormat{kFourccGrey, {64, 1 << 20}, 1 << 30},
        RawFormat{Fourcc('H', '2', '6', '4'), {64, 48}}, RawFormat{}}) {
    EXPECT_NE(decoder.ToGrey(format, bytes, &picture), "") << format.size_px;
    EXPECT_NE(decoder.ToBgr(format, bytes, &picture), "") << format.size_px;
  }
  EXPECT_NE(decoder.ToGrey({kFourccGrey, kSize_px}, {}, &picture), "");
  EXPECT_NE(decoder.ToGrey({kFourccMjpg, kSize_px}, {}, &picture), "");
}

// Bytes changed, cut out, doubled; lengths and sizes of the format changed.
TEST(MutatedFrames, AreRefusedOrGivenWhole) {
  auto rng = TestRng();
  const auto below = [&](size_t bound) { return static_cast<size_t>(rng() % bound); };
  FrameDecoder decoder;
  for (const Kind& kind : Kinds()) {
    int num_refused = 0;
    constexpr int kTrials = 1500;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::string bytes = kind.bytes;
      RawFormat format = kind.format;
      for (size_t i = 0, times = 1 + below(4); i < times && !bytes.empty(); ++i) {
        const size_t at = below(bytes.size());
        switch (below(5)) {
          case 0:
            bytes.erase(at, below(200));
            break;
          case 1:
            bytes.insert(at, bytes.substr(below(bytes.size()), below(200)));
            break;
          case 2:
            format.size_px.width = static_cast<int>(below(100));
            break;
          default:  // in the head as often as elsewhere
            bytes[below(2) ? at : at % 700] = static_cast<char>(rng());
        }
      }
      cv::Mat grey, bgr;
      const bool is_grey = decoder.ToGrey(format, Bytes(bytes), &grey).empty();
      const bool is_bgr = decoder.ToBgr(format, Bytes(bytes), &bgr).empty();
      EXPECT_TRUE(!is_grey || (grey.size() == format.size_px && grey.type() == CV_8UC1));
      EXPECT_TRUE(!is_bgr || (bgr.size() == format.size_px && bgr.type() == CV_8UC3));
      num_refused += is_grey ? 0 : 1;
      // One bad frame does not spoil the next.
      ASSERT_EQ(decoder.ToGrey(kind.format, Bytes(kind.bytes), &grey), "") << kind.name;
    }
    EXPECT_GT(num_refused, kTrials / 20) << kind.name;
    EXPECT_LT(num_refused, kTrials) << kind.name;
  }
}

}  // namespace
}  // namespace poselift
