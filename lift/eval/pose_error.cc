// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/pose_error.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>

#include "src/dof_angles.h"
#include "src/units.h"

namespace poselift {
namespace {

Pose3 Centred(const Pose3& pose) { return pose.colwise() - pose.rowwise().mean().eval(); }

double MeanDistance_mm(const Pose3& a, const Pose3& b) {
  return 1e3 * (a - b).colwise().norm().mean();
}

}  // namespace

double PaError_mm(const Pose3& estimate, const Pose3& truth) {
  const Pose3 from = Centred(estimate);
  const Eigen::Matrix4d similarity = Eigen::umeyama(from, Centred(truth), true);
  return MeanDistance_mm(similarity.topLeftCorner<3, 3>() * from, Centred(truth));
}

double CamError_mm(const Pose3& estimate, const Pose3& truth) {
  const Pose3 from = Centred(estimate);
  const Pose3 to = Centred(truth);
  const double squared = from.squaredNorm();
  const double scale = squared > 0.0 ? std::max(0.0, from.cwiseProduct(to).sum() / squared) : 0.0;
  return MeanDistance_mm(scale * from, to);
}

double RootError_mm(const Pose3& estimate, const Pose3& truth) {
  return MeanDistance_mm(estimate.colwise() - estimate.col(joint::kPelvis),
                         truth.colwise() - truth.col(joint::kPelvis));
}

double MeanAngle_deg(const Skeleton& skeleton, const SkeletonPose& a, const SkeletonPose& b) {
  double sum_rad =
      AngleBetween(a.world_from_root.toRotationMatrix(), b.world_from_root.toRotationMatrix());
  int count = 1;
  int first = 0;
  for (const Bone& bone : skeleton.bones) {
    if (bone.dofs.empty()) continue;
    sum_rad += AngleBetween(RotationOfDofs(bone.dofs, a.dofs.data() + first),
                            RotationOfDofs(bone.dofs, b.dofs.data() + first));
    first += static_cast<int>(bone.dofs.size());
    ++count;
  }
  return sum_rad / count * kDegFromRad;
}

}  // namespace poselift
