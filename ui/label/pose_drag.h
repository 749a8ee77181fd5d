// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lift/ik/inverse_kinematics.h"
#include "lift/lift_photo.h"
#include "src/labels.h"
#include "src/skeleton.h"
#include "ui/label/pose_handles.h"

namespace poselift {

// Pins (LabelHint::kPin) are what becomes of a pose that is dragged: a joint that a person has put
// somewhere is firm, without metres_m; what is to stay about where it is has them. So labels say
// all, and who lifts them gets the pose that was dragged.
bool IsFirmPin(const LabelHint& hint);
bool IsSoftPin(const LabelHint& hint);

// All joints as they are, softly, but those that are pinned: free dragging, where the mask of (P0)
// is the identity. size: LiftedPose::size.
std::vector<LabelHint> SoftPins(const std::vector<PoseHandle>& handles,
                                const std::vector<LabelHint>& hints, const Pose3& joints_in_cam_m,
                                double size);
LabelHint FirmPin(const PoseHandle& handle, const Pose3& joints_in_cam_m, double size);

// One joint of a pose on its way, from a press on it, in one of two ways:
//  - the rest follows as the dictionary knows poses. Without labels all other joints are pinned
//    softly where they were, those between it and its limb's beginning more loosely, and those that
//    hang on it go along; with labels, which say enough, nothing but the joint is pinned.
//  - by angles: its limb bends within the limits of its joints, up to a joint of it that is pinned,
//    and all the rest holds still.
// The pelvis is where pins are counted from: as it goes, the pinned joints and the legs stay behind
// and the trunk comes along.
class PoseDrag {
 public:
  enum class Way { kFree, kByAngles };
  // What there is to drag; all of it as it was at the press.
  struct Start {
    std::vector<PoseHandle> handles;
    std::vector<LabelHint> hints;  // of the person
    LiftedPose pose;
    bool has_labels = false;
  };
  PoseDrag(Start start, size_t dragged, Way way, const Skeleton& skeleton);

  // The hints to give (GiveHints) when the joint is to be there: cam, metres from the pelvis at the
  // press, of the skeleton.
  std::vector<LabelHint> PinsAt(const Eigen::Vector3d& x_in_cam_m) const;

  const PoseHandle& handle() const { return start_.handles[dragged_]; }
  Eigen::Vector3d from_in_cam_m() const { return handle().In(start_.pose.joints_in_cam_m); }

 private:
  std::vector<LabelHint> FreePins(const Eigen::Vector3d& by_m) const;
  std::vector<LabelHint> PinsByAngles(const Eigen::Vector3d& by_m) const;
  std::vector<LabelHint> PinsUnderPelvis(const Eigen::Vector3d& by_m) const;
  bool MaySoften(const PoseHandle& handle) const;
  Pose3 Bent(const Eigen::Vector3d& by_m) const;

  Start start_;
  size_t dragged_;
  std::vector<int> limb_;                  // that bends
  std::unique_ptr<InverseKinematics> ik_;  // by angles
};

}  // namespace poselift
