// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "lift/temporal/foot_contact.h"
#include "src/motion.h"
#include "src/progress.h"

namespace poselift {

// Feet that stand stay where they are. Each contact of an ankle or a ball of
// the foot gets one target, its mean place; before and after it the offset to
// the target fades out over blend_s, or over the whole time to the next contact
// when that is sooner. In every frame that has an offset the pose q is
//
//   min_q  sum_k w_k^2 |f_k(q) - target_k|^2      ankles and balls of the feet
//        + sum_j |f_j(q) - f_j(q_0)|^2 / joint_sigma^2     the other joints
//        + |dofs - dofs_0|^2 / dof_sigma^2
//
// from q_0, the pose as it was, with w_k between 1 / joint_sigma (no contact)
// and 1 / contact_sigma (contact). Joint angles change as little as they can;
// the root gives way where a leg is too short. Other frames stay bit for bit.
struct FootLockOptions {
  double blend_s = 0.1;
  double contact_sigma_m = 0.001;
  double joint_sigma_m = 0.05;
  double dof_sigma_rad = 0.05;  // metres for shifts

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct LockedFeet {
  Motion motion;
  int num_locked_frames = 0;
  int num_failures = 0;  // frames that inverse kinematics left as they were
};

// contacts: those of the motion. Dofs stay within the skeleton's limits, or as
// far outside as they were. Throws InputError when the options are invalid,
// std::invalid_argument when the numbers of frames differ.
LockedFeet LockFeet(const Motion& motion, const FootContacts& contacts,
                    const FootLockOptions& options = {}, const ProgressFn& progress = {});

}  // namespace poselift
