// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "src/body_tags.h"
#include "src/camera.h"
#include "src/pose3.h"
#include "src/skeleton.h"
#include "src/testing/body_shape.h"
#include "src/testing/ray_map.h"
#include "src/testing/seen_body.h"
#include "src/testing/seen_paper.h"

namespace poselift::testing {

// Pictures of a person who wears tags, moved by motion capture before a calibrated
// camera, with the truth of each. The body is that of BodyAround, the tags are flat
// paper; every ray of the camera, lens distortion included, is met with them exactly,
// so that what hides what is right. Edges are smoothed by 16 rays a pixel, a picture
// with motion blur is the mean over the exposure.

struct RenderOptions {
  double exposure_s = 0.0;         // 0: no motion blur
  double noise_grey_levels = 0.0;  // standard deviation of the sensor's noise, of 255
  std::uint64_t seed = 0;          // of noise and background
  bool color = false;              // BGR instead of grey
  cv::Mat background;              // 8-bit grey or BGR, any size; empty: a made-up wall
  double paper_margin = 0.05;      // white around the print, in tag sizes
  Eigen::Vector3d towards_light_in_cam = {-0.4, -0.8, -0.9};  // of any length but 0
  double ambient = 0.4;  // brightness away from the light, 0 ... 1

  std::string Validate() const;
};

struct TagTruth {
  int id = 0;
  Eigen::Isometry3d cam_from_tag;
  // In the order of TagDetection, by Camera::Project: NaN where it sees nothing.
  Eigen::Matrix<double, 2, 4> corners_px;
  // How much of the print, its white border included, is in the picture and not hidden;
  // 0 from behind.
  double visible_share = 0.0;
  double facing_rad = 0.0;      // between its normal and the way to the camera; 0 is face on
  double size_px = 0.0;         // mean edge
  double speed_px_per_s = 0.0;  // of its centre
};

// At the middle of the exposure.
struct FrameTruth {
  double time_s = 0.0;
  SkeletonPose pose;  // in world
  Pose3 joints_in_cam_m;
  std::vector<TagTruth> tags;  // in the order of BodyTags
};

struct RenderedFrame {
  cv::Mat picture;  // CV_8UC1 or CV_8UC3
  FrameTruth truth;
};

class BodyRenderer {
 public:
  using PoseAt = std::function<SkeletonPose(double time_s)>;
  using PrintOf = std::function<TagPrint(int id)>;

  // world has y up, metres. Throws InputError for a skeleton without CMU's bones and for
  // tags that have no place on one, std::invalid_argument for options, camera or prints
  // that are not valid.
  BodyRenderer(const Skeleton& skeleton, const BodyTags& tags, const PrintOf& print_of,
               const Camera& camera, const Eigen::Isometry3d& cam_from_world,
               const RenderOptions& options = {});

  // pose_at is asked for times within the exposure and a little around time_s. Same
  // arguments, same bytes, whatever was rendered before.
  RenderedFrame Render(const PoseAt& pose_at, double time_s) const;

  FrameTruth Truth(const PoseAt& pose_at, double time_s) const;

 private:
  SeenBody SeenAt(const SkeletonPose& pose) const;
  double Blur_px(const PoseAt& pose_at, double time_s) const;

  Skeleton skeleton_;
  std::vector<BodyPart> parts_;
  std::vector<WornTag> tags_;
  Camera camera_;
  Eigen::Isometry3d cam_from_world_;
  RenderOptions options_;
  RayMap rays_;
  cv::Mat background_;  // CV_32F, grey or BGR
};

}  // namespace poselift::testing
