// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/april_grid.h"

#include <apriltag.h>
#include <fmt/format.h>

#include "calib/tag_family.h"

namespace poselift {

Eigen::Vector2d AprilGrid::TopLeft_m(int id) const {
  const int place = id - first_id;
  const int row_from_top = rows - 1 - place / columns;
  return Pitch_m() * Eigen::Vector2d(place % columns, row_from_top);
}

std::string AprilGrid::Validate() const {
  if (rows < 1 || columns < 1 || num_tags() < 2 || rows > 100 || columns > 100)
    return fmt::format("found {} x {} tags, wanted 2 tags or more, at most 100 a row and column",
                       rows, columns);
  if (!(tag_size_m > 0.0 && tag_size_m < 10.0))
    return fmt::format("found the tag size {:g} m, wanted one above 0 and below 10 m", tag_size_m);
  const TagFamily of(family);
  // White borders may be shared, cells outside of the border may not.
  const double least_gap_cells =
      (of.cells() - of.cells_of_size()) * (of.get()->reversed_border ? 1.0 : 0.5);
  const double least_spacing = least_gap_cells / of.cells_of_size();
  if (!(spacing >= least_spacing - 1e-9 && spacing < 10.0))
    return fmt::format(
        "found the spacing {:g}, wanted the gap between two tags as a fraction of their size, for "
        "{} at least {:.3g}",
        spacing, family, least_spacing);
  if (first_id < 0 || first_id + num_tags() > of.num_ids())
    return fmt::format("found the ids {} to {}, wanted ids below {}, the number of {}", first_id,
                       first_id + num_tags() - 1, of.num_ids(), family);
  return {};
}

}  // namespace poselift
