// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tracked_person.h"

#include "lift/poses_to_motion.h"

namespace poselift {
namespace {

using Kind = SmoothedFrame::Kind;
constexpr int kSize = 3 + kNumAngles;

std::vector<std::pair<std::string, double>> Named(const Eigen::VectorXd& values) {
  std::vector<std::pair<std::string, double>> named;
  for (Eigen::Index a = 0; a < values.size(); ++a)
    named.emplace_back(JointAngles()[static_cast<size_t>(a)].name, values[a]);
  return named;
}

// Of a small rotation of the root in world and the dofs. A pose that was not measured has
// deviations alone.
Eigen::MatrixXd CovarianceOf(const TrackedFrame& frame) {
  if (frame.covariance.size() > 0) return frame.covariance.bottomRightCorner<kSize, kSize>();
  const FeatureVector variances = frame.body.deviations.cwiseAbs2();
  const Eigen::Matrix3d world_from_heading =
      Eigen::AngleAxisd(Yaw(frame.body.pose.world_from_root), Eigen::Vector3d::UnitY())
          .toRotationMatrix();
  const Eigen::Vector3d turn(variances[feature::kTilt], variances[feature::kYawRate],
                             variances[feature::kTilt + 1]);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kSize, kSize);
  covariance.topLeftCorner<3, 3>() =
      world_from_heading * turn.asDiagonal() * world_from_heading.transpose();
  covariance.diagonal().tail<kNumAngles>() = variances.head<kNumAngles>();
  return covariance;
}

// The diagonal of J C J^T.
Eigen::VectorXd Variances(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& covariance) {
  return (jacobian * covariance).cwiseProduct(jacobian).rowwise().sum().cwiseMax(0.0);
}

// Covariances are linear in the angles and know no circle: of an angle that is not known at all the
// deviation is that of a uniform one.
const double kUnknownAngle_deg = 180.0 / std::sqrt(3.0);

// Nor do they know how far a joint reaches: where a bone's direction is not known, its end is off
// by what its start is and by a uniform direction, whose expected square is twice the length's.
Eigen::VectorXd WithinReach(const Pose3& joints_m, Eigen::VectorXd sigma_m) {
  for (int j = 1; j < kNumJoints; ++j) {
    const int parent = Joints()[static_cast<size_t>(j)].parent;
    const double length_m = (joints_m.col(j) - joints_m.col(parent)).norm();
    sigma_m[j] = std::min(sigma_m[j], std::hypot(sigma_m[parent], std::sqrt(2.0) * length_m));
  }
  return sigma_m;
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
  const Eigen::MatrixXd covariance = CovarianceOf(frame);
  person.angles_sigma_deg = Named(Variances(reader_.DerivativeDeg(body.pose), covariance)
                                      .cwiseSqrt()
                                      .cwiseMin(kUnknownAngle_deg));
  person.joints_sigma_m = WithinReach(joints_m, JointsSigma_m(body.pose, covariance));
  return person;
}

// From the pelvis.
Eigen::VectorXd TrackedPerson::JointsSigma_m(const SkeletonPose& pose,
                                             const Eigen::MatrixXd& covariance) const {
  BoneFrames frames;
  ForwardKinematics(body_.skeleton, pose, &frames);
  Eigen::MatrixXd jacobian;
  JointJacobian(body_.skeleton, body_.sites, pose, frames, &jacobian);
  const Eigen::VectorXd variances = Variances(jacobian.rightCols<kSize>(), covariance);
  return Eigen::Map<const Pose3>(variances.data(), 3, kNumJoints).colwise().sum().cwiseSqrt();
}

}  // namespace poselift
