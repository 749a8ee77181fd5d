// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/planted_walk.h"

#include <cmath>
#include <numbers>

#include "lift/ik/inverse_kinematics.h"
#include "tests/support/cmu_like_skeleton.h"

namespace poselift::testing {
namespace {

constexpr int kStrideFrames = 60;
constexpr double kStride_m = 1.2, kAnkleHeight_m = 0.08, kBallHeight_m = 0.03, kLift_m = 0.15,
                 kPelvisHeight_m = 0.85;

struct FootPlace {
  bool stands;
  Eigen::Vector2d forward_and_up_m;  // of the ankle, up from where it stands
};

FootPlace PlaceAt(int frame, int phase_frames, double stance) {
  const double strides = static_cast<double>(frame - phase_frames) / kStrideFrames;
  const double whole = std::floor(strides);
  const double part = strides - whole;
  const double from_m = (whole + phase_frames / double{kStrideFrames}) * kStride_m;
  if (part < stance) return {true, {from_m, 0.0}};
  const double u = (part - stance) / (1.0 - stance);
  return {false,
          {from_m + kStride_m * 0.5 * (1.0 - std::cos(std::numbers::pi * u)),
           kLift_m * std::sin(std::numbers::pi * u)}};
}

}  // namespace

PlantedWalk PlantWalk(int num_frames, double stance, double floor_height_m) {
  PlantedWalk walk{{TrimmedCmuLikeSkeleton(), 1.0 / 60.0, {}}, {}, {}};
  const InverseKinematics ik(walk.motion.skeleton);
  const Pose3 rest_m = JointPositions(ik.body(), SkeletonPose::Rest(walk.motion.skeleton));
  const double foot_m = (rest_m.col(joint::kLeftFoot) - rest_m.col(joint::kLeftAnkle)).norm();
  const double drop_m = kAnkleHeight_m - kBallHeight_m;
  const Eigen::Vector3d ball_from_ankle_m(0.0, -drop_m,
                                          std::sqrt(foot_m * foot_m - drop_m * drop_m));
  IkHints hints;
  hints.joint_weights = Eigen::VectorXd::Zero(kNumJoints);
  for (const int j : {joint::kPelvis, joint::kLeftAnkle, joint::kLeftFoot, joint::kRightAnkle,
                      joint::kRightFoot, joint::kThorax})
    hints.joint_weights[j] = 1.0;
  for (int t = 0; t < num_frames; ++t) {
    const FootPlace left = PlaceAt(t, 0, stance);
    const FootPlace right = PlaceAt(t, kStrideFrames / 2, stance);
    Pose3 target_m = Pose3::Zero(3, kNumJoints);
    const double middle_m = (t / double{kStrideFrames} - 0.5 * stance) * kStride_m + 0.25;
    target_m.col(joint::kPelvis) << 0.0, kPelvisHeight_m, middle_m;
    target_m.col(joint::kThorax) =
        target_m.col(joint::kPelvis) + rest_m.col(joint::kThorax) - rest_m.col(joint::kPelvis);
    for (const auto& [place, ankle, x_m] :
         {std::tuple{left, joint::kLeftAnkle, 0.1}, std::tuple{right, joint::kRightAnkle, -0.1}}) {
      target_m.col(ankle) << x_m, kAnkleHeight_m + place.forward_and_up_m.y(),
          place.forward_and_up_m.x();
      target_m.col(ankle + 1) = target_m.col(ankle) + ball_from_ankle_m;
    }
    target_m.row(1).array() += floor_height_m;
    hints.start = ik.Solve(target_m, hints).pose;
    walk.motion.frames.push_back(*hints.start);
    walk.left.push_back(left.stands);
    walk.right.push_back(right.stands);
  }
  return walk;
}

}  // namespace poselift::testing
