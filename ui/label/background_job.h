// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "src/progress.h"

namespace poselift {

// Work of seconds or minutes in a thread of its own, which says how far it is and can be stopped
// wherever it says so. One at a time.
template <typename Result>
class BackgroundJob {
 public:
  // work: throws for what cannot be done, and lets through what the progress throws. ended is
  // called in the job's thread.
  BackgroundJob(std::function<Result(const ProgressFn&)> work, std::function<void()> ended)
      : thread_([this, work = std::move(work), ended = std::move(ended)] {
          try {
            result_ = work([this](double fraction) {
              if (is_stopped_) throw Stopped();
              fraction_ = fraction;
            });
          } catch (const Stopped&) {
          } catch (const std::exception& error) {
            error_ = error.what();
          }
          is_done_ = true;
          if (ended) ended();
        }) {}
  ~BackgroundJob() {
    Stop();
    thread_.join();
  }
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  double fraction() const { return fraction_; }
  bool is_done() const { return is_done_; }
  void Stop() { is_stopped_ = true; }
  // Of a job that is done: nothing when it was stopped, or failed.
  std::optional<Result>& result() { return result_; }
  const std::string& error() const { return error_; }  // empty unless it failed

 private:
  struct Stopped {};

  std::optional<Result> result_;
  std::string error_;
  std::atomic<double> fraction_ = 0.0;
  std::atomic<bool> is_done_ = false, is_stopped_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace poselift
