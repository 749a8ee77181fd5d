// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "src/skeleton.h"

namespace poselift {

// A skeleton as a BVH should carry it.
//
// * Bones are BVH joints: three rotations each, R = Rz Rx Ry (dofs ry rx rz,
//   first innermost), shifts kept before them, no axes of their own.
// * A bone without dofs that only carries an offset (CMU: lhipjoint, rhipjoint; any
//   bone named ...joint with children) melts into the offsets of its children:
//   with it Blender would give the hips a bone of no length. Other bones
//   without dofs (clavicles of the trimmed skeleton) stay as joints to animate.
// * The rest pose of CMU skeletons, whose legs are spread by 20 degrees, becomes
//   a T-pose: with d the rest direction of a bone, it is Q d, Q the smallest
//   rotation that does it:
//     thigh, shank  straight down          arm to fingers  along +x (left), -x
//     foot, toes    as they stand to the shank            others  Q = I
// RebaseMotion(motion, rig.skeleton, rig.source_bone) puts the motion on it, and
// RebaseMotion(..., the first skeleton) by name takes it back exactly.
struct BvhRig {
  Skeleton skeleton;
  std::vector<int> source_bone;  // of each joint
};

BvhRig MakeBvhRig(const Skeleton& skeleton);

}  // namespace poselift
