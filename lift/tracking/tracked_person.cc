// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tracked_person.h"

#include "lift/poses_to_motion.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;

std::vector<std::pair<std::string, double>> Named(const Eigen::VectorXd& values) {
  std::vector<std::pair<std::string, double>> named;
  for (Eigen::Index a = 0; a < values.size(); ++a)
    named.emplace_back(JointAngles()[static_cast<size_t>(a)].name, values[a]);
  return named;
}

}  // namespace

TrackedPerson::TrackedPerson(const Skeleton& skeleton, const Camera& camera,
                             const Eigen::Quaterniond& cam_from_world)
    : body_(skeleton), camera_(camera), cam_from_world_(cam_from_world), reader_(skeleton) {}

PersonPose TrackedPerson::Convert(const TrackedFrame& frame) {
  PersonPose person;
  const SmoothedFrame& body = frame.body;
  for (const TrackedTag& tag : frame.tags)
    person.tags.push_back({tag.id, tag.error_px, tag.is_believed, tag.is_ambiguous});
  if (body.kind == Kind::kNotKnown) {
    person.status = kUnknownStatus;
    person.message = "too few tags are seen";
    return person;
  }
  person.status = body.kind == Kind::kMeasured ? "ok" : kFilledStatus;
  const Pose3 joints_m = JointPositions(body_, body.pose).colwise() - body.pose.root_in_world_m;
  person.joints_in_cam_m = cam_from_world_.toRotationMatrix() * joints_m;
  person.rotation_cam_from_body = cam_from_world_ * body.pose.world_from_root;
  person.pelvis_in_cam_m = cam_from_world_ * body.pose.root_in_world_m;
  person.scale_px_per_m = camera_.fx_px / person.pelvis_in_cam_m.z();
  person.translation_px = Eigen::Vector2d(camera_.cx_px, camera_.cy_px) +
                          person.scale_px_per_m * person.pelvis_in_cam_m.head<2>();
  last_deg_ =
      last_deg_.size() == 0 ? reader_.ReadDeg(body.pose) : reader_.ReadDeg(body.pose, last_deg_);
  person.angles_deg = Named(last_deg_);
  person.angles_sigma_deg = Named(AnglesSigma_deg(body));
  return person;
}

// To first order.
Eigen::VectorXd TrackedPerson::AnglesSigma_deg(const SmoothedFrame& body) const {
  const Eigen::Vector3d turn(body.deviations[feature::kTilt], body.deviations[feature::kYawRate],
                             body.deviations[feature::kTilt + 1]);
  Eigen::VectorXd deviations(3 + kNumAngles);
  deviations << turn, body.deviations.head<kNumAngles>();
  Eigen::MatrixXd by_pose_deg = reader_.DerivativeDeg(body.pose);
  const Eigen::Matrix3d world_from_heading =
      Eigen::AngleAxisd(Yaw(body.pose.world_from_root), Eigen::Vector3d::UnitY())
          .toRotationMatrix();
  by_pose_deg.leftCols<3>() *= world_from_heading;
  return (by_pose_deg * deviations.asDiagonal()).rowwise().norm();
}

}  // namespace poselift
