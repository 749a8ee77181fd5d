// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "src/body_tags.h"
#include "src/camera.h"
#include "src/labels.h"
#include "src/layout.h"
#include "src/pose3.h"
#include "src/poses.h"
#include "src/tag_detection.h"

namespace poselift {

// A person as tags tell of them, before a calibrated camera.
struct LivePose {
  Camera camera;
  Pose3 joints_in_cam_m = Pose3(3, 0);  // 3 x 23, the pelvis at the origin
  Eigen::Vector3d pelvis_in_cam_m = Eigen::Vector3d::Constant(std::nan(""));
  Eigen::Vector3d up_in_cam = -Eigen::Vector3d::UnitY();
  // Joints at an end of a bone whose tag the picture shows, and which fits the pose. The others
  // follow from them: somebody guessed.
  std::array<bool, kNumJoints> is_seen{};

  // 2 x 23, NaN behind the camera.
  Eigen::Matrix2Xd JointsInPicture_px() const;
};

// A picture of a camera and what was found in it.
struct LiveView {
  cv::Mat bgr;         // shared, never written to; empty: no picture has come
  int64_t number = 0;  // of the picture, from 1
  std::vector<TagDetection> tags;
  std::optional<LivePose> pose;
};

// Nothing for a person whose pose is not known.
std::optional<LivePose> LivePoseOf(const PersonPose& person, const BodyTags& tags,
                                   const Camera& camera, const Eigen::Vector3d& up_in_cam);

// Where the pose has the landmarks, to label from: visible where all of a landmark's joints were
// seen, else occluded. Without those that lie outside the picture.
std::vector<LandmarkLabel> LabelsOf(const LivePose& pose, const Layout& layout);

}  // namespace poselift
