// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <span>

#include "src/testing/ray_map.h"
#include "src/testing/ray_samples.h"
#include "src/testing/seen_body.h"

namespace poselift::testing {

struct Light {
  Eigen::Vector3f towards_in_cam;  // unit length
  float ambient = 0.0f;            // brightness of what is turned away, 0 ... 1
};

// Steps from a pixel's centre that edges are smoothed by: each column and each row of a
// 16 x 16 grid has one. Four and eight that follow one another are evenly spread as well.
inline constexpr int kStepsOfPixel = 16;

// Paints a body over a background. Pixels with an edge or a tag are the mean of some rays,
// others one ray.
class BodyPainter {
 public:
  // background: CV_32FC1 or CV_32FC3, 0 ... 255. All must outlive the painter.
  BodyPainter(const RayMap& rays, const Light& light, const cv::Mat& background)
      : rays_(rays), light_(light), background_(background) {}

  // Adds `share` of what the body changes of the background to *picture. Rays are
  // `count` steps from `first` on, past the last the first ones.
  void Add(const SeenBody& body, int first, int count, float share, cv::Mat* picture) const;

 private:
  Eigen::Vector3f Color(const SeenBody& body, const RaySamples::Meeting& meeting,
                        const Ray& ray) const;
  void AddPixel(const SeenBody& body, int x, int y, std::span<const RaySamples::Meeting> meetings,
                std::span<const Eigen::Vector2f> steps_px, float share, cv::Mat* picture) const;

  const RayMap& rays_;
  Light light_;
  const cv::Mat& background_;
};

}  // namespace poselift::testing
