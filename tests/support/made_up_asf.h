// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <random>
#include <string_view>

#include "src/motion.h"

namespace poselift::testing {

// A made-up skeleton in the manner of CMU: spread legs, turned axes, dof
// subsets, bones without dofs, and (unlike CMU) a bone that shifts, another
// axis order, comments and a child listed before its parent.
inline constexpr std::string_view kMadeUpAsf = R"(# made up
:version 1.10
:name made_up
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
  free text, with a stray begin and name in it
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name lhipjoint
    direction 0.66 -0.71 0.25
    length 2.5
    axis 0 0 0 XYZ
  end
  begin
    id 3
    name ltibia   # before its parent
    direction 0.34202 -0.939693 0
    length 7.1
    axis 0 0 20 XYZ
    dof rx
    limits (-10.0 170.0)
  end
  begin
    id 2
    name lfemur
    direction 0.34202 -0.939693 0
    length 7.4
    axis 0 0 20 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-inf inf)
  end
  begin
    name lfoot
    direction 0.09 -0.25 0.96
    length 2.2
    axis -90 7.6e-016 20 XYZ
    dof rx rz
  end
  begin
    name ltoes
    direction 0 0 1
    length 1.1
    axis -90 0 20 XYZ
    dof rx
  end
  begin
    name spine
    direction 0.01 0.99 -0.06
    length 4
    axis 10 20 30 ZXY
    dof rz tx ry tz rx
  end
  begin
    name rhumerus
    direction -1 0 0
    length 4.8
    axis 180 30 90 XYZ
    dof rx ry rz
  end
  begin
    name rwrist
    direction -1 0.1 0
    length 1.7
    axis 0 -90 -90 XYZ
    dof ry
  end
:hierarchy
  begin
    root lhipjoint spine
    lhipjoint lfemur
    lfemur ltibia
    ltibia lfoot
    lfoot ltoes
    spine rhumerus
    rhumerus rwrist
  end
)";

// A smooth motion that visits large angles.
Motion RandomMotion(const Skeleton& skeleton, int num_frames, std::mt19937_64* rng);

// The same bones (by name) at the same places with the same rotations.
void ExpectSamePlaces(const Motion& a, const Motion& b, double tolerance_m);

}  // namespace poselift::testing
