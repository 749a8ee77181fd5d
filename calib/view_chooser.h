// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "calib/calibration_board.h"

namespace poselift {

// Frames of a moving board to calibrate from: few, still and sharp ones, all different.
struct ViewChooserOptions {
  double least_difference = 0.05;  // of corners from those of each other view, rms, over the
                                   // picture's diagonal
  double largest_speed = 0.15;     // diagonals a second: beyond it the board is blurred
  double least_sharpness = 0.5;    // of an edge, over the median of the views
  int most_views = 60;

  // What is wrong, with its value; empty when nothing is.
  std::string Validate() const;
};

struct ChosenView {
  BoardView view;
  int frame = 0;
  double time_s = 0.0;
  double sharpness = 0.0;  // EdgeSharpness of its corners
  double speed = 0.0;      // diagonals a second
};

class ViewChooser {
 public:
  // Throws std::invalid_argument for options that are not valid.
  ViewChooser(cv::Size size_px, const ViewChooserOptions& options = {});

  // A frame where the board was found, times rising. Of frames that are alike the better one
  // stays: the stiller, then the sharper. True when the views have changed.
  bool Offer(const cv::Mat& grey, const BoardView& view, int frame, double time_s);

  const std::vector<ChosenView>& views() const { return views_; }
  // Those that are sharp enough, in order of time.
  std::vector<ChosenView> SharpViews() const;

 private:
  double SpeedOf(const BoardView& view, double time_s) const;

  ViewChooserOptions options_;
  double diagonal_px_;
  std::vector<ChosenView> views_;
  BoardView last_;
  double last_s_ = 0.0;
};

// How steep edges are near corners of a view, the median: grey levels a px over the contrast
// there. Half a step a px is as sharp as a picture can be, a blur of s px has 0.4 / s.
double EdgeSharpness(const cv::Mat& grey, const BoardView& view);

}  // namespace poselift
