// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/pose_drag.h"

#include <algorithm>
#include <utility>

namespace poselift {
namespace {

// Standard deviations: of what is to stay, of what must give way, of what holds still; the last
// weaker than labels where there are any.
constexpr double kSoft_m = 0.05, kLoose_m = 0.15, kStill_m = 0.01, kStillBesideLabels_m = 0.04;
constexpr double kFarthest_m = 5.0;  // a mouse may leave the window
// Of what is to hold still in inverse kinematics, where the joint that is dragged has 1.
constexpr double kHeavy = 30.0;

LabelHint Pin(const PoseHandle& handle, const Eigen::Vector3d& x_in_cam_m,
              std::optional<double> sigma_m = {}) {
  return {.kind = LabelHint::Kind::kPin,
          .joint = handle.name,
          .metres_m = sigma_m,
          .x_in_cam_m = x_in_cam_m.cwiseMax(-kFarthest_m).cwiseMin(kFarthest_m)};
}

const LabelHint* FindFirm(const std::vector<LabelHint>& hints, const PoseHandle& handle) {
  const auto found = std::ranges::find_if(
      hints, [&](const LabelHint& hint) { return IsFirmPin(hint) && hint.joint == handle.name; });
  return found == hints.end() ? nullptr : &*found;
}

bool HasSoft(const std::vector<LabelHint>& hints, const PoseHandle& handle) {
  return std::ranges::any_of(
      hints, [&](const LabelHint& hint) { return IsSoftPin(hint) && hint.joint == handle.name; });
}

bool IsOfLeg(int joint) {
  return HangsOn(joint, joint::kLeftHip) || HangsOn(joint, joint::kRightHip);
}

bool Has(const std::vector<int>& joints, int joint) {
  return std::ranges::count(joints, joint) > 0;
}

}  // namespace

bool IsFirmPin(const LabelHint& hint) {
  return hint.kind == LabelHint::Kind::kPin && !hint.metres_m;
}

bool IsSoftPin(const LabelHint& hint) {
  return hint.kind == LabelHint::Kind::kPin && hint.metres_m;
}

LabelHint FirmPin(const PoseHandle& handle, const Pose3& joints_in_cam_m, double size) {
  return Pin(handle, size * handle.In(joints_in_cam_m));
}

std::vector<LabelHint> SoftPins(const std::vector<PoseHandle>& handles,
                                const std::vector<LabelHint>& hints, const Pose3& joints_in_cam_m,
                                double size) {
  std::vector<LabelHint> pins;
  for (const PoseHandle& handle : handles)
    if (handle.joint != joint::kPelvis && !FindFirm(hints, handle))
      pins.push_back(Pin(handle, size * handle.In(joints_in_cam_m), kSoft_m));
  return pins;
}

PoseDrag::PoseDrag(Start start, size_t dragged, Way way, const Skeleton& skeleton)
    : start_(std::move(start)), dragged_(dragged), limb_(LimbUpTo(handle().joint)) {
  // What is pinned on the way is where the limb begins.
  const auto pinned = std::ranges::find_if(limb_, [&](int joint) {
    return joint != handle().joint &&
           std::ranges::any_of(start_.handles, [&](const PoseHandle& other) {
             return other.joint == joint && FindFirm(start_.hints, other);
           });
  });
  limb_.erase(pinned, limb_.end());
  if (way == Way::kByAngles && handle().joint != joint::kPelvis)
    ik_ = std::make_unique<InverseKinematics>(skeleton);
}

std::vector<LabelHint> PoseDrag::PinsAt(const Eigen::Vector3d& x_in_cam_m) const {
  const Eigen::Vector3d by_m = x_in_cam_m - from_in_cam_m();
  if (handle().joint == joint::kPelvis) return PinsUnderPelvis(by_m);
  return ik_ ? PinsByAngles(by_m) : FreePins(by_m);
}

// Beside labels nothing but what was left of an earlier drag.
bool PoseDrag::MaySoften(const PoseHandle& handle) const {
  if (handle.joint == joint::kPelvis || FindFirm(start_.hints, handle)) return false;
  return !start_.has_labels || HasSoft(start_.hints, handle);
}

std::vector<LabelHint> PoseDrag::FreePins(const Eigen::Vector3d& by_m) const {
  const Pose3& joints_m = start_.pose.joints_in_cam_m;
  const double size = start_.pose.size;
  std::vector<LabelHint> pins = {Pin(handle(), size * (handle().In(joints_m) + by_m))};
  for (const PoseHandle& other : start_.handles) {
    if (&other == &handle() || !MaySoften(other)) continue;
    const bool goes_along = HangsOn(other.joint, handle().joint);
    const bool gives_way = Has(limb_, other.joint);
    pins.push_back(Pin(other, size * (other.In(joints_m) + (goes_along ? 1.0 : 0.0) * by_m),
                       gives_way ? kLoose_m : kSoft_m));
  }
  return pins;
}

std::vector<LabelHint> PoseDrag::PinsByAngles(const Eigen::Vector3d& by_m) const {
  const Pose3 bent_m = Bent(by_m);
  const double size = start_.pose.size;
  std::vector<LabelHint> pins;
  for (const PoseHandle& other : start_.handles) {
    const bool is_dragged = &other == &handle();
    if (other.joint == joint::kPelvis || (!is_dragged && FindFirm(start_.hints, other))) continue;
    const double still_m = start_.has_labels ? kStillBesideLabels_m : kStill_m;
    pins.push_back(Pin(other, size * other.In(bent_m),
                       is_dragged ? std::optional<double>() : std::optional<double>(still_m)));
  }
  return pins;
}

std::vector<LabelHint> PoseDrag::PinsUnderPelvis(const Eigen::Vector3d& by_m) const {
  const double size = start_.pose.size;
  std::vector<LabelHint> pins;
  for (const PoseHandle& other : start_.handles) {
    if (other.joint == joint::kPelvis) continue;
    if (const LabelHint* firm = FindFirm(start_.hints, other)) {
      pins.push_back(Pin(other, firm->x_in_cam_m - size * by_m));
    } else if (MaySoften(other)) {
      Eigen::Vector3d x_m = other.In(start_.pose.joints_in_cam_m);
      if (IsOfLeg(other.joint)) x_m -= by_m;
      const bool is_knee = other.joint == joint::kLeftKnee || other.joint == joint::kRightKnee;
      pins.push_back(Pin(other, size * x_m, is_knee ? kLoose_m : kSoft_m));
    }
  }
  return pins;
}

// The start with the limb's angles alone another: all else is as it was to the last bit.
Pose3 PoseDrag::Bent(const Eigen::Vector3d& by_m) const {
  const int dragged = handle().joint;
  Pose3 target_m = start_.pose.joints_in_cam_m;
  target_m.col(dragged) += by_m;
  Eigen::VectorXd weights = Eigen::VectorXd::Constant(kNumJoints, kHeavy);
  weights[dragged] = 1.0;
  for (int j = 0; j < kNumJoints; ++j) {
    const bool is_moved = std::ranges::any_of(
        limb_, [&](int moved) { return j != dragged && (j == moved || HangsOn(j, moved)); });
    if (is_moved) weights[j] = 0.0;
  }
  const SkeletonPose& start = start_.pose.pose;
  const IkResult result =
      ik_->Solve(target_m, {.joint_weights = weights, .start = start, .rest_dofs = start.dofs});
  SkeletonPose bent = start;
  const Articulation& body = ik_->body();
  for (const int joint : limb_) {
    const int bone = body.sites[static_cast<size_t>(joint)].bone;
    if (bone < 0 || !IsUsable(result.status)) continue;
    const auto first = body.dof_starts[static_cast<size_t>(bone)];
    const auto count = std::ssize(body.skeleton.bones[static_cast<size_t>(bone)].dofs);
    bent.dofs.segment(first, count) = result.pose.dofs.segment(first, count);
  }
  return JointPositions(body, bent);
}

}  // namespace poselift
