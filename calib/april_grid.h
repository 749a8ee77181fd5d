// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>

namespace poselift {

// A flat board of upright AprilTags in rows and columns, as Kalibr has it: the ids go
// row by row from the tag at the bottom left, to the right and then upwards,
//
//   first_id + 2    first_id + 3
//   first_id        first_id + 1        (rows = columns = 2)
//
// with the same gap between all neighbours, across and upwards.
struct AprilGrid {
  int rows = 6;
  int columns = 6;
  double tag_size_m = 0.0;  // edge of the square between black and white border, tag_detection.h
  double spacing = 0.3;     // gap between those squares / tag_size_m
  int first_id = 0;
  std::string family = "tag36h11";

  double Pitch_m() const { return tag_size_m * (1.0 + spacing); }
  double Width_m() const { return tag_size_m + (columns - 1) * Pitch_m(); }
  double Height_m() const { return tag_size_m + (rows - 1) * Pitch_m(); }
  int num_tags() const { return rows * columns; }
  bool Has(int id) const { return id >= first_id && id < first_id + num_tags(); }

  // The tag's top left corner. The frame `board` is the frame of a tag (tag_detection.h):
  // x to the right, y down, z into the paper; its origin is the top left corner of the top
  // left tag. id is one that the grid Has.
  Eigen::Vector2d TopLeft_m(int id) const;

  // What is wrong, with its value; empty when nothing is. The ids must exist in the family.
  std::string Validate() const;
};

}  // namespace poselift
