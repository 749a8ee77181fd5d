// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "src/joints.h"
#include "src/skeleton.h"

namespace poselift {

// Which bones of any skeleton, the source, stand for those of the body of 23
// joints (TrimToJoints), by the names of its joints (FindJointSites) and its tree:
//
//   thigh to foot, upper arm to hand   the bone of the name
//   pelvis       the last that carries both thighs
//   trunk        the chain from there to the last bone that carries both arms
//   neck, head   the chain from there to the head
//
// Chains of n bones and of the body's three are two divisions of one curve: bone
// k of one has the orientation in the world that the other has at the same part of
// its length, between two of its bones. At rest all orientations are the same.
struct BodyMap {
  // Of two bones, by slerp; nowhere: -1.
  struct Between {
    int from = -1;
    int to = -1;
    double share = 0.0;  // 0 is from, 1 is to

    bool IsKnown() const { return from >= 0; }
    bool IsOneBone() const { return from == to; }
  };

  std::array<Between, kNumJoints> source_of_body;
  std::vector<Between> body_of_source;
  int pelvis = -1;  // of the source
  // The body's axes (x left, y up, z forward) from the source's, at rest and in
  // the world alike: the source's axes, of which one points up and one to the left.
  Eigen::Matrix3d body_from_source = Eigen::Matrix3d::Identity();
  // Why the source is no body, in one line, or "": joints that no bone is named
  // after, or a rest pose that does not stand. Then nothing above counts.
  std::string flaw;
};

// Hands, feet, neck and head may be missing.
BodyMap FindBody(const Skeleton& source);

}  // namespace poselift
