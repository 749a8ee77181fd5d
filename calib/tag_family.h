// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

struct apriltag_family;

namespace poselift {

// A family of AprilTags (Olson 2011; Wang and Olson 2016) as libapriltag has it, and
// tag36h11b2: tag36h11 with a black border of two cells, which Kalibr prints.
class TagFamily {
 public:
  // Throws InputError, with the names there are, for one that is unknown.
  explicit TagFamily(const std::string& name);

  static const std::vector<std::string>& Names();

  const std::string& name() const { return name_; }
  int num_ids() const;
  // The edge of the whole print, white border included, and of the square between the
  // black and the white border, whose edge is the tag's size: in cells.
  int cells() const;
  int cells_of_size() const;
  // A pixel a cell, upright, 0 black, 255 white, cells() x cells(). Throws InputError for
  // an id that the family does not have.
  cv::Mat Image(int id) const;

  apriltag_family* get() const { return family_.get(); }

 private:
  std::string name_;
  std::shared_ptr<apriltag_family> family_;
};

}  // namespace poselift
