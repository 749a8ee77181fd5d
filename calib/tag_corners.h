// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace poselift {

// The homography that maps a tag, its corners at (-1, -1), (1, -1), (1, 1), (-1, 1), to
// corners in a picture (Heckbert 1989, 2.2.3). The last element is 1, the centre is its last
// column. Not finite for corners that are no convex quadrangle.
Eigen::Matrix3d PxFromTag(const Eigen::Matrix<double, 2, 4>& corners_px);

// Moves corners to where the edges of a tag's black square meet, from up to a cell off to
// some hundredths of a pixel. Along every edge, the grey levels b and w at the middle of the
// two cells beside it and the mean m over the way between them (h to either side) say how far
// off the edge is: t = h (b + w - 2 m) / (w - b), which holds for any blur that is the same
// on both sides. A line is fitted to each edge, lines meet in corners, and again. Places
// where something lies over the edge are left out: there the levels are not those of the
// tag's borders, or the edge is off the line.
//
// grey: 8-bit, one channel. cells: of the tag's size. False, and corners as they were, when
// an edge leaves the picture, has no contrast, is hidden for the most part or leads far away.
bool RefineTagCorners(const cv::Mat& grey, int cells, Eigen::Matrix<double, 2, 4>* corners_px);

}  // namespace poselift
