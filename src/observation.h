// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "src/joint_relation.h"
#include "src/labels.h"
#include "src/layout.h"
#include "src/pose3.h"

namespace poselift {

// A point of the body that was seen: a weighted sum of joints (a row of the
// layout), in the picture (px) or in space (metres in cam, as a tag or a user's
// drag gives it). Its weight in every objective is 1 / sigma.
struct ObservedPoint {
  enum class Kind { k2D, k3D };
  std::string name;
  std::vector<Landmark::Part> parts;
  Kind kind = Kind::k2D;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // k2D: (x_px, y_px, 0); k3D: x_in_cam_m
  double sigma = 1.0;                           // px or m
  LabelState state = LabelState::kVisible;
  int hint = -1;  // of PersonLabels::hints, of a firm pin
};

// The pose of a tag that is fixed to a bone, measured in space. Its residual is
//   [ (x_tag(q) - x) / sigma_m ;  log(R^T R_tag(q)) / sigma_rad ],
// (R, x) = cam_from_tag, and (R_tag(q), x_tag(q)) where the pose q has it: the
// bone's frame (Bone), with bone_from_tag behind it.
struct ObservedBonePose {
  std::string name;
  std::string bone;
  Eigen::Isometry3d bone_from_tag = Eigen::Isometry3d::Identity();  // metres
  Eigen::Isometry3d cam_from_tag = Eigen::Isometry3d::Identity();   // metres
  double sigma_m = 0.01;
  double sigma_rad = 0.05;
};

// A camera without lens distortion: a point at (X, Y, Z) in cam is seen at
// centre_px + focal_px (X, Y) / Z.
struct Pinhole {
  double focal_px = 0.0;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
};

// All that is known about one person in one frame: what the lifter takes.
struct Observation {
  std::vector<ObservedPoint> points;
  // For what solves for joint angles; the dictionary's poses have no bones to turn.
  std::vector<ObservedBonePose> bone_poses = {};
  std::optional<Pinhole> pinhole = std::nullopt;  // what took the picture, when it is known
  std::vector<JointRelation> relations = {};      // of hints
  // From the soles to the crown, of a hint. With it all metres here are the person's,
  // else those of the skeleton that is lifted to.
  std::optional<double> stature_m = std::nullopt;

  int Count(ObservedPoint::Kind kind) const;
};

// The larger side of the box around a person's labels, about the height of the
// body; 0 without any.
double Extent_px(const PersonLabels& labels);

struct ObserveOptions {
  double relative_sigma = 0.012;       // of the labels' extent, where a label has no radius_px
  double occluded_sigma_factor = 3.0;  // an occluded joint's position is a guess
  RelationOptions relations;
  bool pins_may_be_points = true;  // false where the frames around say more than pins alone

  std::string Validate() const;
};

// Labels of one person as an observation: landmarks the layout maps to joints,
// absent ones left out. A landmark that lies beside its sum of joints (an ear)
// has its offset added to its sigma, at a body height of about the labels'
// extent. Hints are relations and the stature (RelationsOf).
//
// Pins alone give a pose too: with fewer than four labels and as many pins at least, these are
// points in space beside the pelvis at the origin, and the labels wait.
Observation Observe(const PersonLabels& labels, const Layout& layout,
                    const ObserveOptions& options = {});

// The same with all metres of the person divided by `size`, and no stature: of a person
// `size` times as large as the skeleton, as the skeleton has it.
Observation AtSkeletonSize(Observation observation, double size);

// A pose in space as an observation (free dragging: P = identity); joints that
// are NaN are not observed.
Observation ObservePose(const Pose3& joints_in_cam_m, double sigma_m);

}  // namespace poselift
