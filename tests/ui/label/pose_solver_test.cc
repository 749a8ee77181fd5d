// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made up: a random dictionary. Checked: the newest request is answered as the lifter answers
// it, older ones may be dropped, and nobody waits.
#include "ui/label/pose_solver.h"

#include <gtest/gtest.h>

#include <mutex>
#include <vector>

#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

class PoseSolverTest : public ::testing::Test {
 protected:
  std::mt19937_64 rng_ = testing::TestRng();
  Dictionary dictionary_ = testing::RandomDictionary(64, &rng_);
  PhotoLifter lifter_{dictionary_};
  std::mutex mutex_;
  std::vector<PoseSolver::Answer> answers_;

  PoseSolver::OnAnswer Keep() {
    return [this](PoseSolver::Answer answer) {
      const std::scoped_lock lock(mutex_);
      answers_.push_back(std::move(answer));
    };
  }
  Observation Seen(double turn_px) const {
    Observation observation;
    const Pose3 pose = Unstacked(dictionary_.atoms.col(0));
    for (const int j : {0, 2, 3, 6, 7, 11, 14, 16, 17, 20, 21})
      observation.points.push_back({.name = std::string(Joints()[static_cast<size_t>(j)].name),
                                    .parts = {{j, 1.0}},
                                    .x = {200.0 * pose(0, j) + turn_px, 200.0 * pose(1, j), 0.0}});
    return observation;
  }
};

TEST_F(PoseSolverTest, TheNewestRequestIsAnsweredAsTheLifterWould) {
  PoseSolver solver(lifter_, Keep());
  uint64_t last = 0;
  for (int i = 0; i < 20; ++i) {
    const uint64_t number = solver.Ask({Seen(i)});
    EXPECT_GT(number, last);
    last = number;
  }
  solver.WaitUntilIdle();
  const std::scoped_lock lock(mutex_);
  ASSERT_FALSE(answers_.empty());
  EXPECT_LT(answers_.size(), 20U);  // they came faster than they are lifted
  EXPECT_EQ(answers_.back().number, last);
  const LiftResult wanted = lifter_.LiftPhoto(Seen(19));
  ASSERT_TRUE(wanted.IsUsable());
  EXPECT_TRUE(testing::MatrixNear(answers_.back().result.poses.front().joints_in_cam_m,
                                  wanted.poses.front().joints_in_cam_m, 0.0));
}

TEST_F(PoseSolverTest, ARequestWithAStartGoesOnFromThere) {
  const LiftedPose start = lifter_.LiftPhoto(Seen(0.0)).poses.back();
  PoseSolver solver(lifter_, Keep());
  solver.Ask({Seen(0.0), start});
  solver.WaitUntilIdle();
  const std::scoped_lock lock(mutex_);
  const LiftResult wanted = lifter_.LiftPhotoFrom(Seen(0.0), start);
  ASSERT_EQ(answers_.back().result.poses.size(), 1U);
  EXPECT_TRUE(testing::MatrixNear(answers_.back().result.poses.front().joints_in_cam_m,
                                  wanted.poses.front().joints_in_cam_m, 0.0));
}

TEST_F(PoseSolverTest, WhatCannotBeLiftedIsAnsweredToo) {
  PoseSolver solver(lifter_, Keep());
  solver.Ask(PoseRequest());
  solver.WaitUntilIdle();
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_EQ(answers_[0].result.status, LiftStatus::kCannotLift);
}

TEST_F(PoseSolverTest, EndsWithRequestsOpen) {
  PoseSolver solver(lifter_, Keep());
  for (int i = 0; i < 5; ++i) solver.Ask({Seen(i)});
}

}  // namespace
}  // namespace poselift
