// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace poselift {

// The frame of a tag, `tag`: the origin at its centre, x to the right and y down as it is
// printed, z into the paper. So a camera before an upright tag has the tag's axes.
//
// The size of a tag is the edge of the square between its black and its white border (not
// that of the paper, nor of the whole pattern in the families whose pattern goes on outside).

// A tag as a picture shows it.
struct TagDetection {
  int id = 0;
  int hamming = 0;               // bits that had to be set right
  double decision_margin = 0.0;  // how far off the threshold its bits are, grey levels
  // Corners of that square, integer = pixel centre: top left, top right, bottom right,
  // bottom left, as it is printed: (-1, -1), (1, -1), (1, 1), (-1, 1) half sizes in tag.
  Eigen::Matrix<double, 2, 4> corners_px = Eigen::Matrix<double, 2, 4>::Zero();
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  // where its diagonals meet
  // Corners lie where its edges meet. False: an edge is hidden, they may be pixels off.
  bool is_refined = true;
};

// A pose that explains the corners, by a calibrated camera. A flat square has two: it may
// lean one way or the other.
struct TagPose {
  Eigen::Isometry3d cam_from_tag = Eigen::Isometry3d::Identity();  // metres
  double rms_px = 0.0;  // over the eight coordinates of its corners
  // Of (w, s): rotation exp(w) R, radians, and position t + s, metres, both in cam.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// A tag with its poses, the likelier first.
struct TagSighting {
  TagDetection detection;
  std::vector<TagPose> poses;
  bool is_ambiguous = false;  // the picture alone does not tell which
};

// The same corners in tag, 3 x 4, metres.
inline Eigen::Matrix<double, 3, 4> TagCorners_m(double size_m) {
  Eigen::Matrix<double, 3, 4> corners;
  corners << -1, 1, 1, -1, -1, -1, 1, 1, 0, 0, 0, 0;
  return 0.5 * size_m * corners;
}

}  // namespace poselift
