// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/tagged_person.h"

#include <cmath>

#include "calib/tag_pose.h"
#include "src/forward_kinematics.h"
#include "src/level_camera.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "tests/support/cmu_like_skeleton.h"

namespace poselift::testing {
namespace {

constexpr double kLeastFacing = 0.45;  // cosine

}  // namespace

TaggedPerson::TaggedPerson(const Skeleton& skeleton_in)
    : skeleton(skeleton_in),
      worn(DefaultTagPlacement(skeleton_in, {.size_m = 0.08})),
      camera(Webcam()) {
  for (BodyTag& tag : worn.tags) {
    tag.on_bone->sigma_m = 0.002;
    tag.on_bone->sigma_rad = 0.01;
  }
}

SkeletonPose TaggedPerson::PoseAt(double time_s) const {
  const double phase = 2.0 * time_s;
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  pose.root_in_world_m = {0.1 * std::sin(0.7 * phase), 0.0, -3.0};
  pose.world_from_root = Eigen::AngleAxisd(0.3 * std::sin(0.5 * phase), Eigen::Vector3d::UnitY());
  const auto turn = [&](const char* bone, Dof::Kind kind, double rad) {
    DofOf(skeleton, bone, kind, &pose) = rad;
  };
  turn("lfemur", Dof::Kind::kRx, -0.3 * std::sin(phase));
  turn("rfemur", Dof::Kind::kRx, 0.3 * std::sin(phase));
  turn("ltibia", Dof::Kind::kRx, 0.6 + 0.4 * std::sin(phase));
  turn("rtibia", Dof::Kind::kRx, 0.6 - 0.4 * std::sin(phase));
  turn("lhumerus", Dof::Kind::kRx, 0.4 * std::sin(phase));
  turn("rhumerus", Dof::Kind::kRx, -0.4 * std::sin(phase));
  turn("lhumerus", Dof::Kind::kRz, -0.9);
  turn("rhumerus", Dof::Kind::kRz, 0.9);
  turn("lradius", Dof::Kind::kRx, 0.7 + 0.4 * std::cos(phase));
  turn("rradius", Dof::Kind::kRx, 0.7 - 0.4 * std::cos(phase));
  turn("lfoot", Dof::Kind::kRx, 0.2 * std::sin(phase));
  turn("thorax", Dof::Kind::kRy, 0.2 * std::sin(0.8 * phase));
  return pose;
}

std::vector<TagSighting> TaggedPerson::Sight(const SkeletonPose& pose, double noise_px,
                                             std::mt19937_64* rng) const {
  std::normal_distribution<double> noise(0.0, noise_px);
  BoneFrames frames;
  ForwardKinematics(skeleton, pose, &frames);
  std::vector<TagSighting> seen;
  for (const BodyTag& tag : worn.tags) {
    const int bone = *skeleton.FindBone(tag.on_bone->bone);
    const Eigen::Isometry3d cam_from_tag =
        Eigen::Isometry3d(kLevelFromCam) * WorldFromBone(frames, bone) * tag.on_bone->bone_from_tag;
    const Eigen::Vector3d into_tag = cam_from_tag.linear().col(2);
    if (into_tag.dot(cam_from_tag.translation().normalized()) < kLeastFacing) continue;
    TagDetection detection{.id = tag.id};
    const Eigen::Matrix<double, 3, 4> corners_m = cam_from_tag * TagCorners_m(tag.size_m);
    for (int i = 0; i < 4; ++i)
      detection.corners_px.col(i) =
          camera.Project(corners_m.col(i)) + Eigen::Vector2d(noise(*rng), noise(*rng));
    detection.centre_px = detection.corners_px.rowwise().mean();
    TagPoses poses = FindTagPoses(camera, detection.corners_px, tag.size_m);
    seen.push_back({detection, std::move(poses.poses), poses.is_ambiguous});
  }
  return seen;
}

}  // namespace poselift::testing
