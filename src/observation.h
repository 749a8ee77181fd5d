// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

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
  std::optional<Pinhole> pinhole = std::nullopt;  // what took the picture, when it is known

  int Count(ObservedPoint::Kind kind) const;
};

// The larger side of the box around a person's labels, about the height of the
// body; 0 without any.
double Extent_px(const PersonLabels& labels);

struct ObserveOptions {
  double relative_sigma = 0.012;       // of the labels' extent, where a label has no radius_px
  double occluded_sigma_factor = 3.0;  // an occluded joint's position is a guess

  std::string Validate() const;
};

// Labels of one person as an observation: landmarks the layout maps to joints,
// absent ones left out. A landmark that lies beside its sum of joints (an ear)
// has its offset added to its sigma, at a body height of about the labels'
// extent.
Observation Observe(const PersonLabels& labels, const Layout& layout,
                    const ObserveOptions& options = {});

// A pose in space as an observation (free dragging: P = identity); joints that
// are NaN are not observed.
Observation ObservePose(const Pose3& joints_in_cam_m, double sigma_m);

}  // namespace poselift
