// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Painting the window at 1280 x 800: the whole window, the picture with its
// labels (as it is, and brighter), and the pose.
//   QT_QPA_PLATFORM=offscreen poselift_window_bench
#include <benchmark/benchmark.h>

#include <QApplication>

#include "tests/support/support.h"
#include "tests/ui/window/sample_window.h"

namespace poselift {
namespace {

struct OpenWindow {
  Dictionary dictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  PhotoLifter lifter{dictionary};
  std::unique_ptr<LabelProject> project;
  std::unique_ptr<MainWindow> window;

  OpenWindow() {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / "poselift_window_bench";
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const char* name : {"kick.jpg", "kick.labels.json"})
      fs::copy_file(testing::SourcePath("samples/photo") / name, folder / name);
    project = std::make_unique<LabelProject>(folder / "kick.labels.json");
    window = std::make_unique<MainWindow>(project.get(), lifter, KeyMap());
    window->resize(1280, 800);
    window->show();
    window->session().WaitUntilSolved();
    window->Refresh();
  }
};

void Paint(benchmark::State& state, QWidget* widget) {
  QImage picture(widget->size(), QImage::Format_RGB32);
  for (auto _ : state) widget->render(&picture);
}

void PaintWindow(benchmark::State& state) {
  const OpenWindow open;
  Paint(state, open.window.get());
}
BENCHMARK(PaintWindow)->Name("paint/window")->Unit(benchmark::kMillisecond);

void PaintPicture(benchmark::State& state) {
  const OpenWindow open;
  auto* const picture = open.window->findChild<PictureCanvas*>("picture");
  if (state.range(0) == 1) picture->look.gamma = 1.5;
  Paint(state, picture);
}
BENCHMARK(PaintPicture)
    ->Name("paint/picture")
    ->ArgName("gamma")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

void PaintPose(benchmark::State& state) {
  const OpenWindow open;
  Paint(state, open.window->findChild<PoseCanvas*>("pose"));
}
BENCHMARK(PaintPose)->Name("paint/pose")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift

int main(int argc, char** argv) {
  QApplication app(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
