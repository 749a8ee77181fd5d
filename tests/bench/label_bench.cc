// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// From a click to the pose that answers it: the labels of the sample picture, a landmark dragged by
// some pixels and let go, its step in the journal, the lift with the dictionary that ships.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "lift/dictionary_file.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

void ClickToPose(benchmark::State& state) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "poselift_label_bench";
  fs::remove_all(folder);
  fs::create_directories(folder);
  CreateLabelsFile(folder / "kick.labels.json",
                   ReadLabels(testing::SourcePath("samples/photo/kick.labels.json")));
  LabelProject project(folder / "kick.labels.json");
  const Dictionary dictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  const PhotoLifter lifter(dictionary);
  LabelSession session(&project, lifter, nullptr);
  std::vector<double> times_ms;
  size_t click = 0;
  for (auto _ : state) {
    const auto& labels = session.labels().frames[0].people[0].landmarks;
    const Eigen::Vector2d at_px = labels[click++ % labels.size()].x_px;
    const auto begin = std::chrono::steady_clock::now();
    session.Press(at_px, 5.0);
    session.Move(at_px + Eigen::Vector2d(click % 2 == 0 ? 4.0 : -4.0, 3.0 - click % 7));
    session.Release();
    session.WaitUntilSolved();
    times_ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
  }
  std::ranges::sort(times_ms);
  state.counters["median_ms"] = times_ms[times_ms.size() / 2];
  state.counters["p99_ms"] = times_ms[times_ms.size() * 99 / 100];
  fs::remove_all(folder);
}
BENCHMARK(ClickToPose)
    ->Name("label/click_to_pose")
    ->Iterations(300)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift
