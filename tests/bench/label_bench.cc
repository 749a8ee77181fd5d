// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// From the mouse to the pose that answers it, with the dictionary that ships: a landmark of a
// sample picture dragged by some pixels and let go, its step in the journal and the lift; and,
// while the button is down, each move of a label in the picture and of a joint in space beside the
// labels.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift/dictionary_file.h"
#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

const PhotoLifter& TheLifter() {
  static const Dictionary kDictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  static const PhotoLifter kLifter(kDictionary);
  return kLifter;
}

// At work on the labels of a sample picture, which are copied to a folder that goes with this.
class Labelling {
 public:
  explicit Labelling(const std::string& sample) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const fs::path file = folder_ / (sample + ".labels.json");
    CreateLabelsFile(file,
                     ReadLabels(testing::SourcePath("samples/photo/" + sample + ".labels.json")));
    project_.emplace(file);
    session_.emplace(&*project_, TheLifter(), nullptr);
    session_->WaitUntilSolved();
  }
  ~Labelling() {
    session_.reset();
    project_.reset();
    fs::remove_all(folder_);
  }
  Labelling(const Labelling&) = delete;
  Labelling& operator=(const Labelling&) = delete;

  LabelSession& session() { return *session_; }
  // Until the pose is there, kept.
  template <typename Function>
  double Time_s(const Function& function) {
    const auto begin = std::chrono::steady_clock::now();
    function();
    session_->WaitUntilSolved();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    times_ms_.push_back(1e3 * time.count());
    return time.count();
  }
  void Report(benchmark::State* state) {
    std::ranges::sort(times_ms_);
    state->counters["median_ms"] = times_ms_[times_ms_.size() / 2];
    state->counters["p99_ms"] = times_ms_[times_ms_.size() * 99 / 100];
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / "poselift_label_bench";
  std::optional<LabelProject> project_;
  std::optional<LabelSession> session_;
  std::vector<double> times_ms_;
};

void ClickToPose(benchmark::State& state) {
  Labelling labelling("kick");
  LabelSession& session = labelling.session();
  size_t click = 0;
  for (auto _ : state) {
    const auto& labels = session.labels().frames[0].people[0].landmarks;
    const Eigen::Vector2d at_px = labels[click++ % labels.size()].x_px;
    labelling.Time_s([&] {
      session.Press(at_px, 5.0);
      session.Move(at_px + Eigen::Vector2d(click % 2 == 0 ? 4.0 : -4.0, 3.0 - click % 7));
      session.Release();
    });
  }
  labelling.Report(&state);
}
BENCHMARK(ClickToPose)
    ->Name("label/click_to_pose")
    ->Iterations(300)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

constexpr const char* kSamples[] = {"kick", "throw", "reach"};
constexpr int kMoves = 15;  // of one drag

// One label after the other, 2 px a move.
void DragInPicture(benchmark::State& state) {
  Labelling labelling(kSamples[state.range(0)]);
  LabelSession& session = labelling.session();
  Eigen::Vector2d at_px;
  for (int move = 0; auto _ : state) {
    const auto& labels = session.labels().frames[0].people[0].landmarks;
    if (move % kMoves == 0) {
      at_px = labels[static_cast<size_t>(move / kMoves) % labels.size()].x_px;
      session.Press(at_px, 5.0);
    }
    at_px += Eigen::Vector2d(move / kMoves % 2 == 0 ? 2.0 : -2.0, 0.7);
    state.SetIterationTime(labelling.Time_s([&] { session.Move(at_px); }));
    if (++move % kMoves != 0) continue;
    session.Release();
    session.Do(Action::kUndo);
    session.WaitUntilSolved();
  }
  labelling.Report(&state);
}

// One joint after the other, 1 cm a move.
void DragInSpace(benchmark::State& state, PoseDrag::Way way) {
  Labelling labelling(kSamples[state.range(0)]);
  LabelSession& session = labelling.session();
  Eigen::Vector3d at_m;
  size_t handle = 0;
  for (int move = 0; auto _ : state) {
    while (move % kMoves == 0) {
      handle = (handle + 1) % session.handles().size();
      at_m = session.handles()[handle].In(session.pose()->joints_in_cam_m);
      if (session.PressHandle(handle, way)) break;
    }
    at_m += Eigen::Vector3d(0.004, -0.003, move / kMoves % 2 == 0 ? 0.01 : -0.01);
    state.SetIterationTime(labelling.Time_s([&] { session.MoveHandle(at_m); }));
    if (++move % kMoves != 0) continue;
    session.Release();
    session.Do(Action::kUndo);
    session.WaitUntilSolved();
  }
  labelling.Report(&state);
}
void DragFreely(benchmark::State& state) { DragInSpace(state, PoseDrag::Way::kFree); }
void DragByAngles(benchmark::State& state) { DragInSpace(state, PoseDrag::Way::kByAngles); }

void EachSample(benchmark::internal::Benchmark* drag) {
  drag->ArgName("sample")
      ->DenseRange(0, 2)
      ->Iterations(20 * kMoves)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}
BENCHMARK(DragInPicture)->Name("label/drag_in_picture")->Apply(EachSample);
BENCHMARK(DragFreely)->Name("label/drag_in_space")->Apply(EachSample);
BENCHMARK(DragByAngles)->Name("label/drag_by_angles")->Apply(EachSample);

}  // namespace
}  // namespace poselift
