// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk whose feet stand still, disturbed so that they slide, and
// locked again by the contacts that were planted.
#include "lift/temporal/foot_lock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::PlantedWalk;
using testing::PlantWalk;

FootContacts PlantedContacts(const PlantedWalk& walk) {
  FootContacts contacts;
  contacts.joints = {walk.left, walk.left, walk.right, walk.right};
  return contacts;
}

// Slow waves of the legs' and the trunk's angles, and of the root.
Motion Disturbed(Motion motion) {
  for (size_t t = 0; t < motion.frames.size(); ++t) {
    SkeletonPose& pose = motion.frames[t];
    for (Eigen::Index d = 0; d < pose.dofs.size(); ++d)
      pose.dofs[d] += 0.03 * std::sin(0.15 * t + d);
    pose.root_in_world_m.z() += 0.02 * std::sin(0.2 * t);
  }
  return motion;
}

TEST(FootLock, FeetStandAndAnglesHardlyChange) {
  const PlantedWalk walk = PlantWalk(150, 0.6, 0.0);
  const Motion disturbed = Disturbed(walk.motion);
  const FootContacts contacts = PlantedContacts(walk);
  const double before_mm = FootSlide_mm(disturbed, contacts);
  const LockedFeet locked = LockFeet(disturbed, contacts);
  EXPECT_EQ(locked.num_failures, 0);
  EXPECT_GT(before_mm, 10.0);
  EXPECT_LT(FootSlide_mm(locked.motion, contacts), 1.0);
  double squares = 0.0;
  for (size_t t = 0; t < 150; ++t) {
    const Eigen::VectorXd change = locked.motion.frames[t].dofs - disturbed.frames[t].dofs;
    EXPECT_LT(change.cwiseAbs().maxCoeff(), 0.25) << t;
    squares += change.squaredNorm() / change.size();
  }
  EXPECT_LT(std::sqrt(squares / 150.0), 0.04);
}

// The correction comes and goes smoothly: no frame jumps more than without it.
TEST(FootLock, NothingJumpsWhereAContactBeginsOrEnds) {
  const PlantedWalk walk = PlantWalk(150, 0.6, 0.0);
  const Motion disturbed = Disturbed(walk.motion);
  const LockedFeet locked = LockFeet(disturbed, PlantedContacts(walk));
  double largest_m = 0.0;
  Pose3 before_m;
  for (size_t t = 0; t < 150; ++t) {
    const Pose3 offset_m = JointPositions(disturbed.skeleton, locked.motion.frames[t]) -
                           JointPositions(disturbed.skeleton, disturbed.frames[t]);
    if (t > 0) largest_m = std::max(largest_m, (offset_m - before_m).colwise().norm().maxCoeff());
    before_m = offset_m;
  }
  EXPECT_LT(largest_m, 0.012);
}

TEST(FootLock, FramesFarFromAContactStayBitForBit) {
  const PlantedWalk walk = PlantWalk(120, 0.6, 0.0);
  FootContacts contacts;
  for (auto& joint : contacts.joints) joint.assign(120, false);
  for (int t = 40; t < 60; ++t) contacts.joints[1][t] = true;
  const Motion disturbed = Disturbed(walk.motion);
  const LockedFeet locked = LockFeet(disturbed, contacts, {.blend_s = 0.1});
  EXPECT_EQ(locked.num_locked_frames, 20 + 2 * 6);
  for (int t = 0; t < 120; ++t) {
    const bool near = t >= 40 - 6 && t < 60 + 6;
    EXPECT_EQ(locked.motion.frames[t].dofs == disturbed.frames[t].dofs, !near) << t;
  }
}

TEST(FootLock, AWalkWhoseFeetStandStaysAsItIs) {
  const PlantedWalk walk = PlantWalk(90, 0.6, 0.0);
  const LockedFeet locked = LockFeet(walk.motion, PlantedContacts(walk));
  for (size_t t = 0; t < 90; ++t)
    EXPECT_TRUE(
        testing::MatrixNear(locked.motion.frames[t].dofs, walk.motion.frames[t].dofs, 0.02));
}

TEST(FootLock, TheSameComesOutTwice) {
  const PlantedWalk walk = PlantWalk(60, 0.6, 0.0);
  const Motion disturbed = Disturbed(walk.motion);
  const LockedFeet a = LockFeet(disturbed, PlantedContacts(walk));
  const LockedFeet b = LockFeet(disturbed, PlantedContacts(walk));
  for (size_t t = 0; t < 60; ++t) EXPECT_EQ(a.motion.frames[t].dofs, b.motion.frames[t].dofs);
}

TEST(FootLock, BadOptionsAreRefused) {
  const PlantedWalk walk = PlantWalk(5, 0.6, 0.0);
  FootContacts contacts = PlantedContacts(walk);
  EXPECT_THROW(LockFeet(walk.motion, contacts, {.blend_s = -1.0}), InputError);
  EXPECT_THROW(LockFeet(walk.motion, contacts, {.contact_sigma_m = 0.0}), InputError);
  EXPECT_THROW(LockFeet(walk.motion, contacts, {.contact_sigma_m = 0.1}), InputError);
  contacts.joints[3].pop_back();
  EXPECT_THROW(LockFeet(walk.motion, contacts), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
