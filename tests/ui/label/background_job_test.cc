// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: work that waits until the test lets it go on. Checked: in which order things happen,
// never how fast; that work is stopped where it says how far it is, and that the newest one wins.
#include "ui/label/background_job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <optional>
#include <thread>

#include "src/input_error.h"

namespace poselift {
namespace {

using Job = BackgroundJob<int>;

// Says how far it is again and again until it is stopped.
int GoOnForever(const ProgressFn& progress) {
  while (true) {
    progress(0.25);
    std::this_thread::yield();
  }
}

TEST(BackgroundJob, IsDoneAfterItWasAskedForAndSaysHowFarItIs) {
  std::atomic<int> num_ended = 0;
  std::latch asked(1);
  Job job([&] { ++num_ended; });
  EXPECT_FALSE(job.IsBusy());
  job.Start([&](const ProgressFn& progress) {
    progress(0.5);
    progress(0.25);  // of another thread, which was slower
    asked.wait();
    return 7;
  });
  while (job.Fraction() == 0.0) std::this_thread::yield();
  EXPECT_EQ(job.Fraction(), 0.5);
  EXPECT_TRUE(job.IsBusy());
  EXPECT_FALSE(job.Take());
  asked.count_down();
  job.WaitUntilIdle();
  EXPECT_FALSE(job.IsBusy());
  EXPECT_EQ(num_ended, 1);
  EXPECT_EQ(job.Take(), 7);
  EXPECT_FALSE(job.Take());
}

TEST(BackgroundJob, NewWorkEndsTheOneThatRunsAndTheOneThatWaits) {
  Job job(nullptr);
  job.Start(GoOnForever);
  while (job.Fraction() == 0.0) std::this_thread::yield();
  job.Start(GoOnForever);
  job.Start([](const ProgressFn&) { return 3; });
  job.WaitAtMost(std::chrono::hours(1));  // not so long
  EXPECT_EQ(job.Take(), 3);
}

TEST(BackgroundJob, StopsWhereItSaysHowFarItIsAndGivesNothing) {
  std::optional<Job> job(std::in_place, nullptr);
  job->Start(GoOnForever);
  job->Stop();
  EXPECT_FALSE(job->IsBusy());
  job->WaitUntilIdle();
  EXPECT_FALSE(job->Take());
  job->Start([](const ProgressFn&) { return 4; });  // what was stopped is no burden
  job->WaitUntilIdle();
  job->Stop();  // nothing any more
  EXPECT_EQ(job->Take(), 4);
  job->Start(GoOnForever);
  job.reset();  // nor waits for the end
}

TEST(BackgroundJob, WhatTheWorkThrowsIsThrownOnceToWhoTakes) {
  Job job(nullptr);
  job.Start([](const ProgressFn&) -> int { throw InputError("none of this"); });
  job.WaitUntilIdle();
  EXPECT_THROW(job.Take(), InputError);
  EXPECT_FALSE(job.Take());
}

TEST(BackgroundJob, WhoWaitsALittleGoesOnWhileItIsBusy) {
  Job job(nullptr);
  job.Start(GoOnForever);
  job.WaitAtMost(std::chrono::milliseconds(1));
  EXPECT_TRUE(job.IsBusy());
}

}  // namespace
}  // namespace poselift
