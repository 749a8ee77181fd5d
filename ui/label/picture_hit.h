// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "src/labels.h"

namespace poselift {

// A landmark of a picture: frame.people[person].landmarks[landmark].
struct PictureHit {
  size_t person = 0, landmark = 0;

  bool operator==(const PictureHit&) const = default;
};

// The landmark nearest to x_px and within radius_px of it, absent ones aside; of two that are as
// near, that of `preferred_person`. Outside the picture landmarks can be hit too.
std::optional<PictureHit> HitLandmark(const FrameLabels& frame, const Eigen::Vector2d& x_px,
                                      double radius_px, size_t preferred_person = 0);

}  // namespace poselift
