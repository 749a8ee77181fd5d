// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/pose_solver.h"

#include <exception>
#include <utility>

namespace poselift {

PoseSolver::PoseSolver(const PhotoLifter& lifter, Answer answer)
    : lifter_(lifter), answer_(std::move(answer)), thread_([this] { Run(); }) {}

PoseSolver::~PoseSolver() {
  {
    const std::scoped_lock lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

uint64_t PoseSolver::Ask(Observation observation) {
  const std::scoped_lock lock(mutex_);
  next_ = std::move(observation);
  changed_.notify_all();
  return ++newest_;
}

void PoseSolver::WaitUntilIdle() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !is_busy_ && !next_; });
}

void PoseSolver::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ended_ || next_; });
    if (is_ended_) return;
    const Observation observation = std::move(*next_);
    next_.reset();
    const uint64_t number = newest_;
    is_busy_ = true;
    lock.unlock();
    LiftResult result;
    try {
      result = lifter_.LiftPhoto(observation);
    } catch (const std::exception& error) {
      result.status = LiftStatus::kFailed;
      result.message = error.what();
    }
    answer_(number, result);
    lock.lock();
    is_busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace poselift
