// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/camera_formats.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <tuple>

#include "src/capture/fourcc.h"
#include "src/capture/frame_decoder.h"

namespace poselift {
namespace {

// A driver that answers for ever must not hang us.
constexpr uint32_t kMostEntries = 256;

const std::array kUsualSizes_px = {cv::Size(320, 240),   cv::Size(640, 360),  cv::Size(640, 480),
                                   cv::Size(800, 600),   cv::Size(960, 540),  cv::Size(1280, 720),
                                   cv::Size(1920, 1080), cv::Size(3840, 2160)};
constexpr std::array kUsualRates_hz = {5.0, 10.0, 15.0, 24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 120.0};

double Rate_hz(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0.0 : 1.0 * interval.denominator / interval.numerator;
}

std::vector<double> ListRates(const V4l2Device& device, uint32_t fourcc, cv::Size size_px) {
  std::vector<double> rates_hz;
  for (uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmivalenum entry{};
    entry.index = i;
    entry.pixel_format = fourcc;
    entry.width = static_cast<uint32_t>(size_px.width);
    entry.height = static_cast<uint32_t>(size_px.height);
    if (device.Try(VIDIOC_ENUM_FRAMEINTERVALS, &entry)) break;
    if (entry.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      rates_hz.push_back(Rate_hz(entry.discrete));
      continue;
    }
    const double highest_hz = Rate_hz(entry.stepwise.min);  // the shortest interval
    const double lowest_hz = Rate_hz(entry.stepwise.max);
    rates_hz = {highest_hz, lowest_hz};
    for (const double rate_hz : kUsualRates_hz)
      if (rate_hz > lowest_hz && rate_hz < highest_hz) rates_hz.push_back(rate_hz);
    break;
  }
  std::sort(rates_hz.begin(), rates_hz.end(), std::greater<>());
  rates_hz.erase(std::unique(rates_hz.begin(), rates_hz.end()), rates_hz.end());
  return rates_hz;
}

// A size on the grid that starts at `smallest`.
bool Fits(cv::Size size_px, const v4l2_frmsize_stepwise& range) {
  const auto fits = [](int value, uint32_t lowest, uint32_t highest, uint32_t step) {
    const auto size = static_cast<uint32_t>(value);
    return size >= lowest && size <= highest && (step == 0 || (size - lowest) % step == 0);
  };
  return fits(size_px.width, range.min_width, range.max_width, range.step_width) &&
         fits(size_px.height, range.min_height, range.max_height, range.step_height);
}

void ListRange(const v4l2_frmsize_stepwise& range, cv::Size also_px, CameraFormat* format) {
  format->any_size = true;
  format->smallest_px = cv::Size(static_cast<int>(range.min_width),  //
                                 static_cast<int>(range.min_height));
  format->largest_px = cv::Size(static_cast<int>(range.max_width),  //
                                static_cast<int>(range.max_height));
  std::vector<cv::Size> sizes_px(kUsualSizes_px.begin(), kUsualSizes_px.end());
  sizes_px.insert(sizes_px.end(), {also_px, format->smallest_px, format->largest_px});
  for (const cv::Size size_px : sizes_px) {
    const bool listed =
        std::any_of(format->sizes.begin(), format->sizes.end(),
                    [&](const CameraSize& size) { return size.size_px == size_px; });
    if (!listed && Fits(size_px, range)) format->sizes.push_back({size_px, {}});
  }
}

void ListSizes(const V4l2Device& device, cv::Size also_px, CameraFormat* format) {
  for (uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmsizeenum entry{};
    entry.index = i;
    entry.pixel_format = format->fourcc;
    if (device.Try(VIDIOC_ENUM_FRAMESIZES, &entry)) break;
    if (entry.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      ListRange(entry.stepwise, also_px, format);
      break;
    }
    format->sizes.push_back(
        {cv::Size(static_cast<int>(entry.discrete.width), static_cast<int>(entry.discrete.height)),
         {}});
  }
  std::stable_sort(format->sizes.begin(), format->sizes.end(), [](const auto& a, const auto& b) {
    return a.size_px.area() > b.size_px.area();
  });
  for (CameraSize& size : format->sizes)
    size.rates_hz = ListRates(device, format->fourcc, size.size_px);
}

// The rate nearest above the wanted one, or the highest.
double ChooseRate(const CameraSize& size, double wanted_hz) {
  double chosen_hz = 0.0;
  for (const double rate_hz : size.rates_hz)  // from the highest down
    if (chosen_hz == 0.0 || rate_hz > 0.99 * wanted_hz) chosen_hz = rate_hz;
  return chosen_hz;
}

int Cost(uint32_t fourcc) {
  constexpr std::array kCheapestFirst = {kFourccGrey, kFourccNv12, kFourccYuyv, kFourccMjpg,
                                         kFourccJpeg};
  return static_cast<int>(std::find(kCheapestFirst.begin(), kCheapestFirst.end(), fourcc) -
                          kCheapestFirst.begin());
}

}  // namespace

std::string ModeText(const CameraMode& mode) {
  std::string text = fmt::format("{}x{}", mode.size_px.width, mode.size_px.height);
  if (mode.fourcc != 0) text.append(" ").append(FourccText(mode.fourcc));
  if (mode.rate_hz > 0.0) text += fmt::format(" {:.4g} Hz", mode.rate_hz);
  return text;
}

std::vector<CameraFormat> ListFormats(const V4l2Device& device, cv::Size also_px) {
  std::vector<CameraFormat> formats;
  for (uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (device.Try(VIDIOC_ENUM_FMT, &entry)) break;
    const auto* text = reinterpret_cast<const char*>(entry.description);
    CameraFormat format;
    format.fourcc = entry.pixelformat;
    format.description.assign(text, strnlen(text, sizeof(entry.description)));
    ListSizes(device, also_px, &format);
    formats.push_back(std::move(format));
  }
  return formats;
}

CameraMode ChooseMode(const std::vector<CameraFormat>& formats, const CameraMode& wanted) {
  CameraMode chosen;
  // Of what is worse in a mode, the gravest first.
  using Badness = std::tuple<int, double, int>;
  Badness least;
  for (const CameraFormat& format : formats) {
    if (!IsDecodable(format.fourcc) || (wanted.fourcc != 0 && format.fourcc != wanted.fourcc))
      continue;
    for (const CameraSize& size : format.sizes) {
      const double rate_hz = ChooseRate(size, wanted.rate_hz);
      const Badness badness{std::abs(size.size_px.width - wanted.size_px.width) +
                                std::abs(size.size_px.height - wanted.size_px.height),
                            std::max(0.0, 0.99 * wanted.rate_hz - rate_hz), Cost(format.fourcc)};
      if (chosen.fourcc != 0 && badness >= least) continue;
      least = badness;
      chosen = {format.fourcc, size.size_px, rate_hz};
    }
  }
  return chosen;
}

}  // namespace poselift
