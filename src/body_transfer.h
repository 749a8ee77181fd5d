// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "src/body_map.h"
#include "src/forward_kinematics.h"
#include "src/motion.h"
#include "src/skeleton.h"

namespace poselift {

// Motions of any skeleton that is a body (FindBody), put on another of 23 joints,
// and what was changed there carried back. With G the orientation of a source's
// bone in the world, A the map's body_from_source, d and d' the rest directions of
// the bone in the source and in the body, and s the ratio of the legs' lengths:
//
//   to the body   G' = A G A^T Q^T,  Q the smallest rotation of A d to d'
//                 p' = s A p         the pelvis
//   back          G  <- A^T (G'_after G'_before^T) A G
//                 p  <- p + A^T (p'_after - p'_before) / s
//
// Q = I for the pelvis, for bones without length and for those between two. What
// a bone's dofs cannot express is not passed on to its children.
class BodyTransfer {
 public:
  // body: as TrimToJoints makes it. Throws InputError with the source's flaw.
  BodyTransfer(Skeleton source, Skeleton body);

  // Angles are continuous over time, from the rest pose. Unknown frames stay so,
  // bones of the body that the source has none for stay at rest.
  Motion ToBody(const Motion& motion) const;

  // The source's motion, of which ToBody should be `after`. Bones that stand for
  // none of the body keep their dofs; of equal angles those nearest to the motion's
  // are taken. Frames that are unknown in either are so. Throws
  // std::invalid_argument when the numbers of frames differ.
  Motion CarryBack(const Motion& motion, const Motion& after) const;

 private:
  using Rotations = std::vector<Eigen::Matrix3d>;

  void PoseBody(const BoneFrames& source, SkeletonPose* pose) const;
  SkeletonPose CarryPoseBack(const SkeletonPose& pose, const SkeletonPose& before,
                             const SkeletonPose& after) const;
  void PutPelvis(const Eigen::Vector3d& place_in_world_m, SkeletonPose* pose) const;

  Skeleton source_, body_;
  BodyMap map_;
  std::vector<int> source_dofs_, body_dofs_;  // where those of each bone start
  double scale_ = 1.0;
  std::array<Eigen::Matrix3d, kNumJoints> source_from_body_;  // A^T Q^T
};

}  // namespace poselift
