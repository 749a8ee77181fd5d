// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "lift/lift_photo.h"
#include "src/observation.h"

namespace poselift {

// A person to lift. start: the pose to go on from, while labels are dragged (LiftPhotoFrom).
struct PoseRequest {
  Observation observation;
  std::optional<LiftedPose> start = {};
};

// Lifts in a thread of its own, so that who asks never waits. The newest request wins: one that
// has not begun when another comes is dropped.
class PoseSolver {
 public:
  struct Answer {
    uint64_t number = 0;      // of the request
    Observation observation;  // that the result explains
    LiftResult result;
  };
  // answer: called in the solver's thread. lifter must outlive this.
  using OnAnswer = std::function<void(Answer answer)>;
  PoseSolver(const PhotoLifter& lifter, OnAnswer answer);
  ~PoseSolver();  // waits for the lift that runs
  PoseSolver(const PoseSolver&) = delete;
  PoseSolver& operator=(const PoseSolver&) = delete;

  // The number of this request, larger than those before.
  uint64_t Ask(PoseRequest request);
  // Waits until the newest request is answered; for programs without events.
  void WaitUntilIdle();

 private:
  void Run();

  const PhotoLifter& lifter_;
  OnAnswer answer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<PoseRequest> next_;
  uint64_t newest_ = 0;
  bool is_busy_ = false, is_ended_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace poselift
