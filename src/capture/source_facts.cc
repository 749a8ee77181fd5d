// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/source_facts.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace poselift {
namespace {

constexpr size_t kMostSamples = 12;

using Histogram = std::array<int64_t, 256>;

void Count(const cv::Mat& grey, Histogram* histogram) {
  constexpr int kStride = 4;  // of rows: a picture has enough of them
  for (int y = 0; y < grey.rows; y += kStride) {
    const uchar* const row = grey.ptr(y);
    for (int x = 0; x < grey.cols; ++x) ++(*histogram)[row[x]];
  }
}

void Summarise(const Histogram& histogram, SourceFacts* facts) {
  constexpr size_t kDark = 30;
  constexpr size_t kSaturated = 250;
  double total = 0.0, sum = 0.0, dark = 0.0, saturated = 0.0;
  for (size_t level = 0; level < histogram.size(); ++level) {
    const auto count = static_cast<double>(histogram[level]);
    total += count;
    sum += count * static_cast<double>(level);
    if (level < kDark) dark += count;
    if (level > kSaturated) saturated += count;
  }
  if (total == 0.0) return;
  facts->mean_grey = sum / total;
  facts->dark_part = dark / total;
  facts->saturated_part = saturated / total;
}

}  // namespace

SourceFacts WatchSource(FrameSource* source, double seconds) {
  SourceFacts facts;
  Histogram histogram{};
  double first_s = 0.0, last_s = 0.0;
  while (auto frame = source->Next()) {
    if (facts.num_frames == 0) first_s = last_s = frame->time_s;
    ++facts.num_frames;
    facts.longest_gap_s = std::max(facts.longest_gap_s, frame->time_s - last_s);
    last_s = frame->time_s;
    Count(frame->grey, &histogram);
    const double due_s = seconds * static_cast<double>(facts.samples.size()) / kMostSamples;
    if (last_s - first_s >= due_s && facts.samples.size() < kMostSamples)
      facts.samples.push_back(frame->grey);
    if (last_s - first_s >= seconds) break;
  }
  facts.duration_s = last_s - first_s;
  Summarise(histogram, &facts);
  return facts;
}

CameraFacts FactsOf(const LiveFrameSource& source, const CameraMode& wanted) {
  const CameraStream& camera = source.camera();
  return {camera.formats(), ListControls(camera.device()), wanted, camera.asked(), camera.given(),
          source.counts()};
}

}  // namespace poselift
