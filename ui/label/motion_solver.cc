// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/motion_solver.h"

#include <exception>
#include <utility>

namespace poselift {
namespace {

struct Cancelled {};

}  // namespace

MotionSolver::MotionSolver(const PhotoLifter& lifter, std::function<void()> answered)
    : lifter_(lifter), answered_(std::move(answered)), thread_([this] { Run(); }) {}

MotionSolver::~MotionSolver() {
  {
    const std::scoped_lock lock(mutex_);
    is_ended_ = true;
    wanted_ = 0;
  }
  changed_.notify_all();
  thread_.join();
}

void MotionSolver::Ask(Labels labels, int person_id) {
  const std::scoped_lock lock(mutex_);
  next_ = Request{std::move(labels), person_id, ++last_};
  wanted_ = last_;
  answer_.reset();
  progress_ = 0.0;
  changed_.notify_all();
}

void MotionSolver::Cancel() {
  const std::scoped_lock lock(mutex_);
  next_.reset();
  wanted_ = 0;
}

bool MotionSolver::IsBusy() const { return wanted_ != 0; }

std::optional<PersonMotion> MotionSolver::Take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void MotionSolver::WaitUntilIdle() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !is_busy_ && !next_; });
}

std::optional<PersonMotion> MotionSolver::Lift(const Request& request) {
  // From several threads, never less than before.
  const auto so_far = [&](double part) {
    if (wanted_ != request.number) throw Cancelled();
    double before = progress_;
    while (before < part && !progress_.compare_exchange_weak(before, part)) {
    }
  };
  try {
    return LiftPersonAsMotion(lifter_, request.labels, request.person_id, so_far);
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const std::exception& error) {
    return PersonMotion{.person_id = request.person_id, .message = error.what()};
  }
}

void MotionSolver::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ended_ || next_; });
    if (is_ended_) return;
    const Request request = std::move(*std::exchange(next_, std::nullopt));
    is_busy_ = true;
    lock.unlock();
    std::optional<PersonMotion> motion = Lift(request);
    lock.lock();
    if (motion && wanted_ == request.number) {
      answer_ = std::move(motion);
      answer_->number = request.number;
      wanted_ = 0;
    }
    lock.unlock();
    if (answered_) answered_();
    lock.lock();
    is_busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace poselift
