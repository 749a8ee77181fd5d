// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "src/labels.h"
#include "src/layout.h"
#include "src/motion.h"
#include "src/pose3.h"

namespace poselift {

// A camera that looks at a known pose from a random side: weak perspective.
// Angles as in lift/rotation.h; elevation is the pitch.
struct ViewRange {
  std::string name;
  double min_elevation_deg, max_elevation_deg;
  double max_roll_deg;  // either way; yaw is drawn from the whole circle
};

inline const ViewRange kLevelViews{"level", -10.0, 30.0, 5.0};
inline const ViewRange kFreeViews{"free", -30.0, 60.0, 40.0};

struct SyntheticView {
  Pose3 joints_in_cam_m;
  PersonLabels labels;  // every landmark of the layout, visible, without radius
};

// noise_m: standard deviation of each label coordinate, at the body's size.
SyntheticView MakeView(const Pose3& joints_in_body_m, const Layout& layout, const ViewRange& range,
                       double noise_m, std::mt19937_64* rng);

// A camera that stands still before a motion: weak perspective, the root's path
// in the picture.
struct SequenceViewOptions {
  ViewRange range{"fixed camera", -10.0, 20.0, 3.0};
  double body_height_px = 300.0;  // of the skeleton at rest
  double noise_px = 0.0;          // standard deviation of each label coordinate
  double missing_share = 0.0;     // of all labels, drawn one by one
};

struct SequenceView {
  Eigen::Matrix3d cam_from_world;
  std::vector<Pose3> joints_in_cam_m;  // pelvis at the origin
  std::vector<PersonLabels> labels;    // what is missing is absent; no radius
};

// With the same generator and share the view and what is missing are the same
// whatever the noise, and the noise is the same but for its size.
SequenceView MakeSequenceView(const Motion& motion, const Layout& layout,
                              const SequenceViewOptions& options, std::mt19937_64* rng);

}  // namespace poselift
