// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/labels.h"
#include "src/pose3.h"

namespace poselift {

// The picture that shows how well the lifted pose explains the labels: the
// photo, dimmed; the skeleton over it (see DrawFigure); each label as a ring,
// closed when the landmark was visible and broken when its place was guessed;
// a line from each label to where the lifted pose puts it, redder the longer,
// with its length in pixels where it is long; a legend.

struct OverlayLabel {
  std::string name;  // its side is read from it: "left_knee"
  Eigen::Vector2d x_px = Eigen::Vector2d::Zero();
  LabelState state = LabelState::kVisible;        // absent ones are not drawn
  std::optional<Eigen::Vector2d> reprojected_px;  // none for a landmark that is not lifted
};

struct OverlayPerson {
  // 3 x 23: x and y in pixels of the image; z the depth times the scale (the
  // same unit), larger = farther. 3 x 0 when this person was not lifted.
  Pose3 joints_in_px = Pose3(3, 0);
  std::vector<OverlayLabel> labels;
  std::optional<double> reprojection_rms_px;  // for the legend
};

struct OverlayInput {
  // Of the canvas when there is no image; 0: large enough for what is drawn.
  int width_px = 0;
  int height_px = 0;
  std::vector<OverlayPerson> people;
};

struct OverlayOptions {
  // A larger picture is drawn smaller: the longer side of the result is at most this.
  int max_side_px = 3000;
  // A residual longer than this part of the person's extent gets its number.
  double large_residual = 0.03;

  std::string Validate() const;  // empty when all is well, else what is wrong
};

// image: 8-bit BGR, or empty for a neutral canvas with a grid. The result is
// 8-bit BGR of the image's size (or smaller, see max_side_px); widths and letters
// grow with it. Positions may be anything: what is not finite is left out, what
// lies outside is cut off. Throws std::invalid_argument on another type of
// image, another number of joints, or options that do not validate.
cv::Mat DrawOverlay(const cv::Mat& image_or_empty, const OverlayInput& input,
                    const OverlayOptions& options = {});

}  // namespace poselift
