// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lift/temporal/motion_codebook.h"
#include "src/layout.h"

namespace poselift {

// The segments of a codebook that look, from one side, like what a level camera
// saw of a body around a moment.
//
// With (X, Y, Z) the points of a segment about the heading of its middle, Y up,
// and c, s the cosine and sine of the angle psi by which it is turned, its
// distance to points (x, y, z), z towards the viewer, is
//
//   E(psi) = mean (x - cX - sZ)^2 + (y - Y)^2 + depth_weight^2 (z + sX - cZ)^2
//
// over all points of all samples. It is quadratic in (c, s), with coefficients
// that are products of the query with all segments; its minimum over psi is found
// by Newton's method. Depth, which no picture shows, counts little (depth_weight),
// the picture much.
struct SegmentViewsOptions {
  // Samples are centred on the mean of their points, but for this part of how
  // that mean moves: the path says which way a body faces, but not where the
  // camera turns with it. Depth has no path.
  double path_weight = 0.3;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct SegmentView {
  int segment = 0;
  double psi_rad = 0.0;          // about y, from the heading of the segment's middle to the view
  double mean_squared_m2 = 0.0;  // E
};

class SegmentViews {
 public:
  // points: what is seen, each a sum of joints. Throws InputError for wrong
  // options. Keeps nothing of the codebook.
  SegmentViews(const MotionCodebook& codebook,
               const std::vector<std::vector<Landmark::Part>>& points,
               const SegmentViewsOptions& options = {});

  // Points of the samples of one moment: 3 x (samples * points), metres, x right,
  // y up, z towards the viewer, one sample after the other.
  using Query = Eigen::Matrix3Xd;

  // For each query its `count` nearest segments, nearest first.
  std::vector<std::vector<SegmentView>> FindNearest(const std::vector<Query>& queries,
                                                    double depth_weight, int count) const;

 private:
  // Centres the points of the samples as the options say; the depth without path.
  void Centre(Query* points, Eigen::RowVectorXd* x_without_path,
              Eigen::RowVectorXd* z_without_path) const;
  void FindNearestOf(const std::vector<Query>& queries, size_t first, size_t last,
                     double depth_weight, int count,
                     std::vector<std::vector<SegmentView>>* nearest) const;

  SegmentViewsOptions options_;
  int num_points_;
  // A column a segment. X, Y, Z with the path, X and Z without.
  Eigen::MatrixXf x_, y_, z_, x_still_, z_still_;
  Eigen::VectorXf xx_, yy_, zz_, xz_, xx_still_, zz_still_, xz_still_;
};

}  // namespace poselift
