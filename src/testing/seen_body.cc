// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/seen_body.h"

#include <cmath>

namespace poselift::testing {
namespace {

const Eigen::Vector3f kPaper(0.88f, 0.88f, 0.88f);

// Where a box in cam may be seen: the box around its corners, wider by what the lens
// bends the lines between them. Everywhere when a corner is not seen at all.
cv::Rect BoxOnPicture(const Eigen::AlignedBox3d& box, const Camera& camera) {
  const cv::Rect picture(0, 0, camera.width_px, camera.height_px);
  Eigen::AlignedBox2d box_px;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector2d corner_px =
        camera.Project(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    if (!corner_px.allFinite()) return box.max().z() > 0 ? picture : cv::Rect();
    box_px.extend(corner_px);
  }
  const Eigen::Vector2d margin_px = 0.05 * box_px.sizes() + Eigen::Vector2d::Constant(2.0);
  const Eigen::Vector2d size_px(camera.width_px, camera.height_px);
  const Eigen::Vector2d low = (box_px.min() - margin_px).cwiseMax(0.0).cwiseMin(size_px);
  const Eigen::Vector2d high = (box_px.max() + margin_px).cwiseMax(0.0).cwiseMin(size_px);
  return cv::Rect(cv::Point(static_cast<int>(low.x()), static_cast<int>(low.y())),
                  cv::Point(static_cast<int>(std::ceil(high.x())),
                            static_cast<int>(std::ceil(high.y())))) &
         picture;
}

}  // namespace

SeenBody::SeenBody(const std::vector<BodyPart>& parts, const std::vector<WornTag>& tags,
                   const BoneFrames& frames, const Camera& camera,
                   const Eigen::Isometry3d& cam_from_world)
    : num_parts_(parts.size()) {
  for (const BodyPart& part : parts) {
    SeenRoundCone cone(part.cone, cam_from_world * WorldFromBone(frames, part.bone));
    const cv::Rect box_px = BoxOnPicture(cone.Box(), camera);
    surfaces_.push_back({std::move(cone), part.albedo_bgr, box_px});
  }
  for (const WornTag& tag : tags) {
    cam_from_tag_.push_back(cam_from_world * WorldFromBone(frames, tag.bone) * tag.bone_from_tag);
    SeenPaper paper(tag.print, tag.size_m, tag.margin_m, cam_from_tag_.back());
    const cv::Rect box_px = BoxOnPicture(paper.Box(), camera);
    surfaces_.push_back({std::move(paper), kPaper, box_px});
  }
}

cv::Rect SeenBody::Box_px() const {
  cv::Rect all;
  for (const Surface& surface : surfaces_)
    if (!surface.box_px.empty()) all |= surface.box_px;
  return all;
}

bool SeenBody::IsHidden(const Eigen::Vector3d& x_in_cam_m, const Eigen::Vector2d& x_px,
                        size_t but_by_surface) const {
  const Ray ray = (x_in_cam_m.head<2>() / x_in_cam_m.z()).cast<float>();
  const auto depth_m = static_cast<float>(x_in_cam_m.z() * (1 - 1e-5));
  const cv::Point pixel(static_cast<int>(x_px.x() + 0.5), static_cast<int>(x_px.y() + 0.5));
  for (size_t i = 0; i < surfaces_.size(); ++i) {
    if (i == but_by_surface || !surfaces_[i].box_px.contains(pixel)) continue;
    const auto meets = [&](const auto& shape) { return shape.Depth_m(ray) < depth_m; };
    if (std::visit(meets, surfaces_[i].shape)) return true;
  }
  return false;
}

double SeenBody::VisibleShare(size_t tag, const Camera& camera) const {
  constexpr int kSide = 16;
  if (!paper(tag).ShowsFront()) return 0.0;
  const double edge_m = paper(tag).print_edge_m();
  int visible = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector3d x_in_cam_m =
        cam_from_tag_[tag] * Eigen::Vector3d(edge_m * ((i % kSide + 0.5) / kSide - 0.5),
                                             edge_m * ((i / kSide + 0.5) / kSide - 0.5), 0);
    const Eigen::Vector2d x_px = camera.Project(x_in_cam_m);
    const bool is_in_picture = x_px.x() >= -0.5 && x_px.x() < camera.width_px - 0.5 &&
                               x_px.y() >= -0.5 && x_px.y() < camera.height_px - 0.5;
    if (is_in_picture && !IsHidden(x_in_cam_m, x_px, num_parts_ + tag)) ++visible;
  }
  return static_cast<double>(visible) / (kSide * kSide);
}

}  // namespace poselift::testing
