// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/joints.h"
#include "src/pose3.h"

namespace poselift {

// A label set (COCO, OpenPose, ...) as rows of the projection operator: each
// landmark is a weighted sum of skeleton joints, with weights that sum to one.
// Landmarks that are no combination of joints (nose, eyes) have no parts and
// are left out of the lift.
struct Landmark {
  struct Part {
    int joint;
    double weight;
  };
  std::string_view name;
  std::vector<Part> parts;
  // How far the landmark may lie from the sum (standard deviation): an ear is
  // not the middle of the head.
  double offset_sigma_m = 0.0;
};

struct Layout {
  std::string_view name;
  std::vector<Landmark> landmarks;  // in the order of the format's arrays

  std::optional<int> Find(std::string_view landmark) const;
};

// Where a landmark is in a pose.
inline Eigen::Vector3d SumOfJoints(const std::vector<Landmark::Part>& parts, const Pose3& joints) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Landmark::Part& part : parts) sum += part.weight * joints.col(part.joint);
  return sum;
}

// body15, coco17, openpose25, openpose18, joints23. Null when there is none.
const Layout* FindLayout(std::string_view name);
const std::vector<Layout>& AllLayouts();

}  // namespace poselift
