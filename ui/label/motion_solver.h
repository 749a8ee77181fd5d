// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "lift/lift_photo.h"
#include "src/labels.h"
#include "ui/label/person_motion.h"

namespace poselift {

// Lifts whole motions in a thread of its own, so that who asks never waits. A new request ends the
// one that runs.
class MotionSolver {
 public:
  // answered: called in the solver's thread when a motion waits to be taken, or when one was
  // cancelled. lifter must outlive this.
  MotionSolver(const PhotoLifter& lifter, std::function<void()> answered);
  ~MotionSolver();  // cancels, and waits until that is done
  MotionSolver(const MotionSolver&) = delete;
  MotionSolver& operator=(const MotionSolver&) = delete;

  void Ask(Labels labels, int person_id);
  void Cancel();
  bool IsBusy() const;  // with a request that is still wanted
  double Progress() const { return progress_; }
  // The newest motion, once.
  std::optional<PersonMotion> Take();
  // For programs without events.
  void WaitUntilIdle();

 private:
  struct Request {
    Labels labels;
    int person_id = 0;
    uint64_t number = 0;
  };
  void Run();
  std::optional<PersonMotion> Lift(const Request& request);

  const PhotoLifter& lifter_;
  std::function<void()> answered_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Request> next_;
  std::optional<PersonMotion> answer_;
  std::atomic<uint64_t> wanted_ = 0;  // 0: none
  uint64_t last_ = 0;
  std::atomic<double> progress_ = 0.0;
  bool is_busy_ = false, is_ended_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace poselift
