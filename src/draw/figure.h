// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>

#include "src/pose3.h"

namespace poselift {

// The body as both pictures draw it: bones over one another as the body's are,
// nearer ones on top, thicker and brighter, each bone tapering towards its
// farther end; L and R at the hands and feet.
struct FigureStyle {
  double bone_width_px = 4.0;     // at the middle depth
  double letter_height_px = 0.0;  // of L and R; 0: none
};

// joints_in_px: 3 x 23; x and y in pixels of the canvas, z the depth in the same
// unit, larger = farther. Joints that are not finite are left out.
void DrawFigure(cv::Mat* canvas, const Pose3& joints_in_px, const FigureStyle& style);

// The bones alone, flat and in one colour: an alternative, a shadow.
void DrawBones(cv::Mat* canvas, const Pose3& joints_in_px, const cv::Scalar& color,
               double width_px);

// The larger side of the box around the joints; 0 without any.
double FigureExtent(const Pose3& joints_in_px);

}  // namespace poselift
