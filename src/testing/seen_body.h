// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>
#include <variant>
#include <vector>

#include "src/camera.h"
#include "src/forward_kinematics.h"
#include "src/skeleton.h"
#include "src/testing/body_shape.h"
#include "src/testing/round_cone.h"
#include "src/testing/seen_paper.h"

namespace poselift::testing {

struct WornTag {
  int id = 0;
  int bone = 0;
  Eigen::Isometry3d bone_from_tag;
  double size_m = 0.0;
  double margin_m = 0.0;  // of the paper around the print
  TagPrint print;
};

// A body and its tags at one time, placed before a camera.
class SeenBody {
 public:
  struct Surface {
    std::variant<SeenRoundCone, SeenPaper> shape;
    Eigen::Vector3f albedo_bgr;  // of paper: where it is white
    cv::Rect box_px;             // within the picture; nothing of it is seen outside
  };

  SeenBody(const std::vector<BodyPart>& parts, const std::vector<WornTag>& tags,
           const BoneFrames& frames, const Camera& camera, const Eigen::Isometry3d& cam_from_world);

  // The parts, then the tags.
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const SeenPaper& paper(size_t tag) const {
    return std::get<SeenPaper>(surfaces_[num_parts_ + tag].shape);
  }
  const Eigen::Isometry3d& cam_from_tag(size_t tag) const { return cam_from_tag_[tag]; }
  bool IsTag(int surface) const { return surface >= static_cast<int>(num_parts_); }
  cv::Rect Box_px() const;  // of all surfaces

  // How much of a tag's print is in the picture, seen from the front and not hidden: the
  // share of a grid of points on it.
  double VisibleShare(size_t tag, const Camera& camera) const;

 private:
  bool IsHidden(const Eigen::Vector3d& x_in_cam_m, const Eigen::Vector2d& x_px,
                size_t but_by_surface) const;

  std::vector<Surface> surfaces_;
  std::vector<Eigen::Isometry3d> cam_from_tag_;
  size_t num_parts_;
};

}  // namespace poselift::testing
