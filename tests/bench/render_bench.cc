// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Pictures of 1280 x 720 of a standing body with 13 tags of 80 mm, 3 m away, grey, one
// core; with an exposure of 8 ms while it goes sideways at 1.5 m/s, 3.5 px.
#include <benchmark/benchmark.h>

#include "src/testing/body_renderer.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "tests/support/cmu_like_skeleton.h"

namespace poselift {
namespace {

void Render(benchmark::State& state, double exposure_s) {
  SkeletonPose pose = SkeletonPose::Rest(testing::TrimmedCmuLikeSkeleton());
  const Motion still{testing::TrimmedCmuLikeSkeleton(), 1.0, {pose}};
  const testing::PlacedCamera placed = testing::CameraBefore(still, 3.0);
  const auto print_of = [](int) { return testing::TagPrint{cv::Mat::eye(10, 10, CV_8U) * 255, 8}; };
  const testing::BodyRenderer renderer(still.skeleton, testing::DefaultTagPlacement(still.skeleton),
                                       print_of, placed.camera, placed.cam_from_world,
                                       {.exposure_s = exposure_s, .noise_grey_levels = 2.0});
  const auto pose_at = [&](double time_s) {
    SkeletonPose moved = pose;
    moved.root_in_world_m.x() = 1.5 * time_s;
    return moved;
  };
  for (auto _ : state) {
    testing::RenderedFrame frame = renderer.Render(pose_at, 0.0);
    benchmark::DoNotOptimize(frame.picture.data);
  }
  state.SetItemsProcessed(state.iterations());
}

void RenderBench(benchmark::State& state) { Render(state, 0.0); }
void RenderBlurBench(benchmark::State& state) { Render(state, 0.008); }
BENCHMARK(RenderBench)->Name("render_720p")->Unit(benchmark::kMillisecond);
BENCHMARK(RenderBlurBench)->Name("render_720p_blur")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift
