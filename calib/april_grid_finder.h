// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <vector>

#include "calib/april_grid.h"
#include "calib/calibration_board.h"
#include "calib/tag_detector.h"

namespace poselift {

// Corner 4 (id - first_id) + c is the tag's corner c in the order of TagDetection.
CalibrationBoard BoardOf(const AprilGrid& grid);

// Two tags of the grid are enough: the rest may be hidden or outside of the picture.
class AprilGridFinder : public BoardFinder {
 public:
  // Throws InputError for a grid that is not valid.
  explicit AprilGridFinder(const AprilGrid& grid);

  const CalibrationBoard& board() const override { return board_; }
  BoardCounts counts() const override { return {grid_.rows, grid_.columns}; }
  std::string counted() const override { return "tags"; }

  // Nothing as well when the tags do not lie as on the grid. It is part of a larger one when
  // tags beside it lie as on that.
  BoardView Find(const cv::Mat& grey) override;
  // Tags that lie as on a grid of other columns, with as many rows as are seen; tags that only
  // the mirrored picture shows; tags of other ids or of another family.
  BoardAbsence Explain(const cv::Mat& grey) override;

 private:
  std::optional<TagRange> OtherFamily(const cv::Mat& grey);

  AprilGrid grid_;
  CalibrationBoard board_;
  TagFamily family_;
  TagDetector detector_;
  std::vector<std::string> other_families_ = TagFamily::Names();  // to be looked for
};

}  // namespace poselift
