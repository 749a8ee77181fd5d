// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/observation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

constexpr double kBodyHeight_m = 1.6;  // ankle to crown
constexpr int kLeastPoints = 4;        // of a pose
constexpr double kPelvisSigma_m = 0.01;

bool IsPin(const LabelHint& hint) { return hint.kind == LabelHint::Kind::kPin; }

// Pins as points, where they would be relations without a point to start from.
void ObservePins(const std::vector<LabelHint>& hints, const Layout& layout, double sigma_m,
                 Observation* observation) {
  observation->points = {{.name = "pelvis",
                          .parts = {{joint::kPelvis, 1.0}},
                          .kind = ObservedPoint::Kind::k3D,
                          .sigma = kPelvisSigma_m}};
  for (int i = 0; i < std::ssize(hints); ++i) {
    const LabelHint& hint = hints[static_cast<size_t>(i)];
    if (IsPin(hint))
      observation->points.push_back({.name = hint.joint,
                                     .parts = PartsNamed(hint.joint, layout),
                                     .kind = ObservedPoint::Kind::k3D,
                                     .x = hint.x_in_cam_m,
                                     .sigma = hint.metres_m.value_or(sigma_m),
                                     .hint = hint.metres_m ? -1 : i});
  }
  std::erase_if(observation->relations, [&](const JointRelation& relation) {
    return IsPin(hints[static_cast<size_t>(relation.hint)]);
  });
}

}  // namespace

double Extent_px(const PersonLabels& labels) {
  Eigen::AlignedBox2d box;
  for (const LandmarkLabel& label : labels.landmarks)
    if (label.state != LabelState::kAbsent) box.extend(label.x_px);
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

int Observation::Count(ObservedPoint::Kind kind) const {
  return static_cast<int>(std::count_if(points.begin(), points.end(),
                                        [&](const ObservedPoint& p) { return p.kind == kind; }));
}

std::string ObserveOptions::Validate() const {
  if (!(relative_sigma > 0.0))
    return fmt::format("ObserveOptions::relative_sigma = {}, wanted more than 0", relative_sigma);
  if (!(occluded_sigma_factor >= 1.0))
    return fmt::format("ObserveOptions::occluded_sigma_factor = {}, wanted at least 1",
                       occluded_sigma_factor);
  return relations.Validate();
}

Observation Observe(const PersonLabels& labels, const Layout& layout,
                    const ObserveOptions& options) {
  const double extent_px = Extent_px(labels);
  Observation observation;
  for (const LandmarkLabel& label : labels.landmarks) {
    const auto row = layout.Find(label.name);
    if (label.state == LabelState::kAbsent || !row || layout.landmarks[*row].parts.empty())
      continue;
    const Landmark& landmark = layout.landmarks[*row];
    ObservedPoint point;
    point.name = label.name;
    point.parts = landmark.parts;
    point.state = label.state;
    point.x << label.x_px, 0.0;
    // A radius of 0 would be an infinite weight: nobody clicks that well.
    const double radius_px =
        std::max(0.1, label.radius_px.value_or(std::max(1.0, options.relative_sigma * extent_px)));
    const double offset_px = landmark.offset_sigma_m * extent_px / kBodyHeight_m;
    point.sigma = std::hypot(radius_px, offset_px);
    if (label.state == LabelState::kOccluded) point.sigma *= options.occluded_sigma_factor;
    observation.points.push_back(std::move(point));
  }
  observation.relations = RelationsOf(labels.hints, layout, options.relations);
  for (const LabelHint& hint : labels.hints)
    if (hint.kind == LabelHint::Kind::kHeight) observation.stature_m = hint.metres_m;
  if (options.pins_may_be_points && std::ssize(observation.points) < kLeastPoints &&
      std::ranges::count_if(labels.hints, IsPin) >= kLeastPoints)
    ObservePins(labels.hints, layout, options.relations.sigma_m, &observation);
  return observation;
}

Observation AtSkeletonSize(Observation observation, double size) {
  observation.stature_m.reset();
  for (ObservedPoint& point : observation.points) {
    if (point.kind != ObservedPoint::Kind::k3D) continue;
    point.x /= size;
    point.sigma /= size;
  }
  for (ObservedBonePose& tag : observation.bone_poses) {
    tag.bone_from_tag.translation() /= size;
    tag.cam_from_tag.translation() /= size;
    tag.sigma_m /= size;
  }
  for (JointRelation& relation : observation.relations) {
    relation.bound_m /= size;
    relation.sigma_m /= size;
  }
  return observation;
}

Observation ObservePose(const Pose3& joints_in_cam_m, double sigma_m) {
  Observation observation;
  for (int j = 0; j < joints_in_cam_m.cols(); ++j) {
    if (!joints_in_cam_m.col(j).allFinite()) continue;
    ObservedPoint point;
    point.name = Joints()[j].name;
    point.parts = {{j, 1.0}};
    point.kind = ObservedPoint::Kind::k3D;
    point.x = joints_in_cam_m.col(j);
    point.sigma = sigma_m;
    observation.points.push_back(std::move(point));
  }
  return observation;
}

}  // namespace poselift
