// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/pose3.h"

namespace poselift {

// What comes out for each person in each picture: the content of poses.json.
// NaN is "not known" everywhere: the pose of a person that could not be lifted
// has NaN joints, scale and rotation, and a status that is not "ok".

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Another pose that explains the same labels, e.g. a limb bent the other way in depth.
struct PoseAlternative {
  Pose3 joints_in_cam_m = Pose3::Constant(3, kNumJoints, kUnknown);  // root-centred
  double cost = kUnknown;
  double reprojection_rms_px = kUnknown;
};

// A tag that the person wears, as the frame shows it.
struct PoseTag {
  int id = 0;
  double error_px = kUnknown;  // of its corners to the pose, RMS
  bool believed = true;        // else it does not fit, and hardly counted
  bool ambiguous = false;      // the picture alone did not tell how it leans
};

struct PersonPose {
  int id = 0;
  // "ok", "filled" (guessed across a gap), or what went wrong in a word or two.
  std::string status = "not run";
  std::string message;  // the same in a sentence; may be empty

  // 3 x 23 with the pelvis at the origin, metres at the size of the skeleton
  // used; camera axes: x right, y down, z forward.
  Pose3 joints_in_cam_m = Pose3::Constant(3, kNumJoints, kUnknown);
  // How far off each may be: standard deviations in space; empty when nobody knows.
  Eigen::VectorXd joints_sigma_m;

  // Weak perspective: x_px = scale * (x, y) + translation.
  double scale_px_per_m = kUnknown;
  Eigen::Vector2d translation_px = Eigen::Vector2d::Constant(kUnknown);
  // Where the pelvis is, metres; known when the camera is.
  Eigen::Vector3d pelvis_in_cam_m = Eigen::Vector3d::Constant(kUnknown);
  Eigen::Quaterniond rotation_cam_from_body{kUnknown, kUnknown, kUnknown, kUnknown};

  std::vector<std::pair<std::string, double>> angles_deg;  // "left_elbow.flexion", degrees
  // Their standard deviations; empty when nobody knows.
  std::vector<std::pair<std::string, double>> angles_sigma_deg;

  double reprojection_rms_px = kUnknown;
  std::vector<std::pair<std::string, double>> per_joint_px;  // landmark, its reprojection error
  std::vector<PoseTag> tags;                                 // where the pose comes from tags
  std::vector<std::pair<int, double>> atoms;                 // dictionary index, coefficient
  std::vector<PoseAlternative> alternatives;
};

struct FramePoses {
  std::string image;  // may be empty
  std::optional<double> time_s;
  std::vector<PersonPose> people;
};

// The bones of a person, the same in all frames, by the joints at their ends.
struct PersonBones {
  int id = 0;
  Eigen::VectorXd lengths_m;  // 23, 0 for the pelvis
  Eigen::VectorXd sigmas_m;   // their standard deviations at this stature
};

struct Poses {
  std::vector<FramePoses> frames;
  std::vector<PersonBones> bodies;  // of people whose proportions were found out
};

}  // namespace poselift
