// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <random>
#include <vector>

#include "calib/tag_family.h"
#include "src/camera.h"

namespace poselift::testing {

// A tag put into a picture: corners of its size at (-1, -1) to (1, 1), x right and y down as
// it is printed, are mapped to pixels (integer = pixel centre) by px_from_tag.
struct PlacedTag {
  int id = 0;
  Eigen::Matrix3d px_from_tag = Eigen::Matrix3d::Identity();

  // As TagDetection has them.
  Eigen::Matrix<double, 2, 4> Corners() const;
};

// The homography of a tag that a camera without lens distortion sees.
Eigen::Matrix3d PxFromTag(const Camera& camera, const Eigen::Isometry3d& cam_from_tag,
                          double size_m);

// Upright at a place, turned about its centre.
Eigen::Matrix3d PxFromTag(const Eigen::Vector2d& centre_px, double size_px, double turn_rad);

// Draws tags into a grey picture as a lens and a sensor of square pixels would: each pixel is
// the mean of samples that differ in both coordinates, so that edges along the pixels are as
// fine as others. white and black: grey levels of the print.
void DrawTags(const TagFamily& family, const std::vector<PlacedTag>& tags, cv::Mat* grey,
              double white = 220.0, double black = 30.0, int samples = 128);

// Grey noise, normal, clipped to a byte.
void AddNoise(double sigma, std::mt19937_64* rng, cv::Mat* grey);

// Blotches of all sizes and greys with straight edges: what a room looks like to a detector.
cv::Mat Clutter(const cv::Size& size, std::mt19937_64* rng);

}  // namespace poselift::testing
