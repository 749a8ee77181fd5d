// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "src/progress.h"

namespace poselift {

// Work of seconds or minutes in a thread of its own, so that who asks for it never waits. It says
// how far it is and can be stopped wherever it says so. New work ends the one that runs.
template <typename Result>
class BackgroundJob {
 public:
  // Throws for what cannot be done, and lets through what the progress throws.
  using Work = std::function<Result(const ProgressFn&)>;

  // ended: called in the job's thread whenever work has ended, done or not.
  explicit BackgroundJob(std::function<void()> ended)
      : ended_(std::move(ended)), thread_([this] { Run(); }) {}
  // Stops, and waits until that is done.
  ~BackgroundJob() {
    {
      const std::scoped_lock lock(mutex_);
      is_over_ = true;
      wanted_ = 0;
    }
    changed_.notify_all();
    thread_.join();
  }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  void Start(Work work) {
    const std::scoped_lock lock(mutex_);
    next_ = std::move(work);
    wanted_ = ++newest_;
    fraction_ = 0.0;
    result_.reset();
    error_ = nullptr;
    changed_.notify_all();
  }
  void Stop() {
    const std::scoped_lock lock(mutex_);
    next_ = nullptr;
    wanted_ = 0;
  }
  bool IsBusy() const {  // with work that is still wanted
    const std::scoped_lock lock(mutex_);
    return wanted_ != 0;
  }
  double Fraction() const {
    const std::scoped_lock lock(mutex_);
    return fraction_;
  }
  // What the newest work came to, once; nothing while it runs, or when it was stopped. Throws what
  // the work threw.
  std::optional<Result> Take() {
    const std::scoped_lock lock(mutex_);
    if (const auto error = std::exchange(error_, nullptr)) std::rethrow_exception(error);
    return std::exchange(result_, std::nullopt);
  }
  // Until nothing runs, not even what was stopped; for programs without events.
  void WaitUntilIdle() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !is_running_ && !next_; });
  }
  // For work that is mostly done at once; no longer than that.
  void WaitAtMost(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, time, [this] { return wanted_ == 0; });
  }

 private:
  struct Stopped {};

  // From several threads, never less than before.
  void SayHowFar(uint64_t number, double fraction) {
    const std::scoped_lock lock(mutex_);
    if (wanted_ != number) throw Stopped();
    fraction_ = std::max(fraction_, fraction);
  }

  void Do(const Work& work, uint64_t number) {
    std::optional<Result> result;
    std::exception_ptr error;
    try {
      result = work([&](double fraction) { SayHowFar(number, fraction); });
    } catch (const Stopped&) {
    } catch (...) {
      error = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    if (wanted_ != number) return;
    result_ = std::move(result);
    error_ = std::move(error);
    wanted_ = 0;
    changed_.notify_all();
  }

  void Run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_over_ || next_; });
      if (is_over_) return;
      const Work work = std::exchange(next_, nullptr);
      const uint64_t number = newest_;
      is_running_ = true;
      lock.unlock();
      Do(work, number);
      if (ended_) ended_();
      lock.lock();
      is_running_ = false;
      changed_.notify_all();
    }
  }

  std::function<void()> ended_;
  mutable std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  Work next_;
  uint64_t newest_ = 0, wanted_ = 0;  // 0: none
  double fraction_ = 0.0;
  std::optional<Result> result_;
  std::exception_ptr error_;
  bool is_running_ = false, is_over_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace poselift
