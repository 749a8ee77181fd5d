// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Twelve tags of 45 px before clutter with noise, 1280 x 720: full frames, full frames
// decimated by two, and regions with a full frame every ten. Two threads. found: of twelve.
#include <benchmark/benchmark.h>

#include "calib/tag_search.h"
#include "tests/support/rendered_tags.h"

namespace poselift {
namespace {

const std::vector<cv::Mat>& Video() {
  static const std::vector<cv::Mat> kVideo = [] {
    std::mt19937_64 rng(1);
    const TagFamily family("tag36h11");
    const cv::Mat room = testing::Clutter({1280, 720}, &rng);
    std::vector<cv::Mat> frames;
    for (int t = 0; t < 20; ++t) {
      frames.push_back(room.clone());
      std::vector<testing::PlacedTag> tags;
      for (int id = 0; id < 12; ++id)
        tags.push_back({id, testing::PxFromTag({130.0 + 200.0 * (id % 6) + 3.0 * t,
                                                200.0 + 300.0 * (id / 6) + 2.0 * t},
                                               45.0, 0.02 * t + id)});
      testing::DrawTags(family, tags, &frames.back(), 210.0, 40.0, 16);
      testing::AddNoise(4.0, &rng, &frames.back());
    }
    return frames;
  }();
  return kVideo;
}

template <class Detector>
void Run(benchmark::State& state, Detector* detector) {
  const std::vector<cv::Mat>& video = Video();
  size_t t = 0, num_found = 0;
  for (auto _ : state) num_found += detector->Detect(video[t++ % video.size()]).size();
  state.counters["found"] =
      static_cast<double>(num_found) / static_cast<double>(state.iterations());
}

void TagsFull(benchmark::State& state) {
  TagSearch detector(TagFamily("tag36h11"),
                     {.detector = {.decimate = static_cast<double>(state.range(0))},
                      .threads = 2,
                      .full_every = 1});
  Run(state, &detector);
}
BENCHMARK(TagsFull)
    ->Name("tags_720p/full/decimate")
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void TagsRegions(benchmark::State& state) {
  TagSearch search(TagFamily("tag36h11"), {.threads = 2});
  Run(state, &search);
}
BENCHMARK(TagsRegions)
    ->Name("tags_720p/search")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift
