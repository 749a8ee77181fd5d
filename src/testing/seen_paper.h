// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "src/testing/round_cone.h"

namespace poselift::testing {

// What is printed on a tag: a pixel a cell, 0 black, 255 white, square; the tag's size
// (tag_detection.h) is that of so many cells in its middle.
struct TagPrint {
  cv::Mat cells;
  int cells_of_size = 0;
};

// A flat square of paper with a tag on it, made ready for many rays from one eye, the
// origin of `cam`. Its back is white.
class SeenPaper {
 public:
  SeenPaper(const TagPrint& print, double size_m, double margin_m,
            const Eigen::Isometry3d& cam_from_tag);

  // The depth z at which the ray meets it, infinity where it does not.
  float Depth_m(const Ray& ray) const;
  // 0 black to 1 white, where the ray meets it.
  float Brightness(const Ray& ray, float depth_m) const;
  // Of the side that is seen, in cam.
  const Eigen::Vector3f& normal() const { return normal_; }
  bool ShowsFront() const { return shows_front_; }
  double print_edge_m() const { return 2.0 * half_print_m_; }
  Eigen::AlignedBox3d Box() const { return box_; }

 private:
  Eigen::Vector3f centre_, x_, y_, normal_;  // in cam
  float plane_;                              // normal . centre
  float half_paper_m_, half_print_m_;
  bool shows_front_;
  cv::Mat cells_;
  Eigen::AlignedBox3d box_;
};

}  // namespace poselift::testing
