// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "src/joints.h"
#include "src/motion.h"

namespace poselift {

// When a foot stands on the floor. Two points of each foot are watched, because
// in a step each is still at its own time: the ankle from the heel's strike
// until the heel rises, the ball of the foot (joint "foot") from when the foot
// is flat until the toes leave. A point is in contact from when it is both near
// its level and slow, until it is one of the two no more by a laxer measure
// (hysteresis):
//
//   begins   height < on_height_m    and  speed < on_speed
//   ends     height > off_height_m   or   speed > off_speed
//
// height: above the floor of the point, a plane h = f_0 + f_1 x + f_2 z through
// where its joints of both sides are while slow, by least squares that give up
// outliers (Cauchy's weights): ankles lie higher in the foot than balls, floors
// are seldom at 0, and captured ones often tilt by a degree. Slopes are drawn to
// 0 where the feet do not get about. speed: horizontal, between the frames half
// a window before and after. The foot is in contact when one of its points is.
// Thresholds are for a leg (hip to ankle) of 0.85 m; heights scale with the
// leg's length L, speeds with sqrt(L), as those of walking do (Froude number
// v^2 / g L).
//
// Flat floors only: on stairs, ramps or a moving belt nothing is found, or the
// wrong thing.
struct FootContactOptions {
  struct Thresholds {
    double on_height_m, off_height_m;
    double on_speed_m_per_s, off_speed_m_per_s;
  };
  // It moves as soon as the heel rises, over a ball that still stands.
  Thresholds ankle = {0.025, 0.03, 0.25, 0.3};
  Thresholds ball = {0.05, 0.08, 0.4, 0.7};
  double speed_window_s = 0.05;
  double min_contact_s = 0.04;  // shorter ones are none

  std::string Validate() const;  // empty, or which option is wrong and why
};

// The watched points.
inline constexpr std::array<int, 4> kFootJoints = {joint::kLeftAnkle, joint::kLeftFoot,
                                                   joint::kRightAnkle, joint::kRightFoot};

struct FootContacts {
  // Of each of kFootJoints, frame by frame.
  std::array<std::vector<bool>, 4> joints;
  // Of ankles and balls: f_0 (metres), f_1, f_2, the height at which they stand.
  std::array<Eigen::Vector3d, 2> floors;
  double leg_length_m = 0.0;

  std::vector<bool> Left() const;  // of the foot
  std::vector<bool> Right() const;
};

// Unknown frames (motion.h) are in no contact. Throws InputError when the
// options are invalid or the skeleton lacks a hip, ankle or foot.
FootContacts FindFootContacts(const Motion& motion, const FootContactOptions& options = {});

// How far feet slide while in contact: the root mean square horizontal distance
// of the points from their mean places, contact by contact, mm. -1 without any.
double FootSlide_mm(const Motion& motion, const FootContacts& contacts);

}  // namespace poselift
