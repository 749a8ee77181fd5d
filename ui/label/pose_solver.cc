// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/pose_solver.h"

#include <exception>
#include <utility>

namespace poselift {

PoseSolver::PoseSolver(const PhotoLifter& lifter, OnAnswer answer)
    : lifter_(lifter), answer_(std::move(answer)), thread_([this] { Run(); }) {}

PoseSolver::~PoseSolver() {
  {
    const std::scoped_lock lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

uint64_t PoseSolver::Ask(PoseRequest request) {
  const std::scoped_lock lock(mutex_);
  next_ = std::move(request);
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
    PoseRequest request = *std::exchange(next_, std::nullopt);
    const uint64_t number = newest_;
    is_busy_ = true;
    lock.unlock();
    LiftResult result;
    try {
      result = request.start ? lifter_.LiftPhotoFrom(request.observation, *request.start)
                             : lifter_.LiftPhoto(request.observation);
    } catch (const std::exception& error) {
      result.status = LiftStatus::kFailed;
      result.message = error.what();
    }
    answer_({number, std::move(request.observation), std::move(result)});
    lock.lock();
    is_busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace poselift
