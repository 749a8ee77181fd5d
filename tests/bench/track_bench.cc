// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up person in 13 tags, with the models that ship: a frame that follows another,
// and the first, which is lifted out of nothing.
#include <benchmark/benchmark.h>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "lift/tracking/tag_tracker.h"
#include "src/level_camera.h"
#include "tests/support/tagged_person.h"

namespace poselift {
namespace {

constexpr double kRate_hz = 30.0;

struct Scene {
  Dictionary dictionary = ReadDictionary(DefaultDictionaryPath());
  std::shared_ptr<const MotionCodebook> codebook =
      std::make_shared<MotionCodebook>(WithMirrored(ReadMotionCodebook(DefaultMotionModelPath())));
  PhotoLifter lifter{dictionary};
  testing::TaggedPerson person{dictionary.skeleton};
  std::vector<std::vector<TagSighting>> frames;

  Scene() {
    std::mt19937_64 rng(1);
    for (int t = 0; t < 300; ++t)
      frames.push_back(person.Sight(person.PoseAt(t / kRate_hz), 0.1, &rng));
  }
  TagTracker Tracker() const {
    return {person.skeleton, person.worn, person.camera, kLevelFromCam, lifter, codebook};
  }
};

const Scene& TheScene() {
  static const Scene kScene;
  return kScene;
}

void TrackFrame(benchmark::State& state) {
  const Scene& scene = TheScene();
  TagTracker tracker = scene.Tracker();
  int t = 0;
  for (auto _ : state) {
    tracker.Add(t / kRate_hz, scene.frames[static_cast<size_t>(t) % scene.frames.size()]);
    benchmark::DoNotOptimize(tracker.Take());
    ++t;
  }
}
BENCHMARK(TrackFrame)->Name("track_tags/frame")->Unit(benchmark::kMillisecond);

void TrackFirstFrame(benchmark::State& state) {
  const Scene& scene = TheScene();
  for (auto _ : state) {
    state.PauseTiming();
    TagTracker tracker = scene.Tracker();
    state.ResumeTiming();
    tracker.Add(0.0, scene.frames[0]);
    benchmark::DoNotOptimize(tracker.Take());
  }
}
BENCHMARK(TrackFirstFrame)->Name("track_tags/first")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift
