// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/pose3.h"

namespace poselift {

Pose3 MirroredInBody(const Pose3& joints_in_body) {
  Pose3 mirrored(3, joints_in_body.cols());
  for (int j = 0; j < joints_in_body.cols(); ++j)
    mirrored.col(j) = joints_in_body.col(Joints()[j].mirror);
  mirrored.row(0) *= -1.0;
  return mirrored;
}

}  // namespace poselift
