// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/seen_paper.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poselift::testing {

SeenPaper::SeenPaper(const TagPrint& print, double size_m, double margin_m,
                     const Eigen::Isometry3d& cam_from_tag)
    : centre_(cam_from_tag.translation().cast<float>()),
      x_(cam_from_tag.linear().col(0).cast<float>()),
      y_(cam_from_tag.linear().col(1).cast<float>()),
      cells_(print.cells) {
  const Eigen::Vector3d into_paper = cam_from_tag.linear().col(2);
  shows_front_ = into_paper.dot(cam_from_tag.translation()) > 0;
  normal_ = ((shows_front_ ? -1.0 : 1.0) * into_paper).cast<float>();
  plane_ = normal_.dot(centre_);
  const double half_print_m = 0.5 * size_m * print.cells.cols / print.cells_of_size;
  half_print_m_ = static_cast<float>(half_print_m);
  half_paper_m_ = static_cast<float>(half_print_m + margin_m);
  for (const double u : {-1.0, 1.0})
    for (const double v : {-1.0, 1.0})
      box_.extend(cam_from_tag *
                  Eigen::Vector3d((half_print_m + margin_m) * Eigen::Vector3d(u, v, 0)));
}

float SeenPaper::Depth_m(const Ray& ray) const {
  constexpr float kMiss = std::numeric_limits<float>::infinity();
  const Eigen::Vector3f d(ray.x(), ray.y(), 1.0f);
  const float z = plane_ / normal_.dot(d);
  const Eigen::Vector3f at = z * d - centre_;
  const bool meets =
      z > 0 && std::abs(at.dot(x_)) <= half_paper_m_ && std::abs(at.dot(y_)) <= half_paper_m_;
  return meets ? z : kMiss;
}

float SeenPaper::Brightness(const Ray& ray, float depth_m) const {
  if (!shows_front_) return 1.0f;
  const Eigen::Vector3f at = depth_m * Eigen::Vector3f(ray.x(), ray.y(), 1.0f) - centre_;
  const float per_cell = 0.5f * static_cast<float>(cells_.cols) / half_print_m_;
  const int u = static_cast<int>(std::floor((at.dot(x_) + half_print_m_) * per_cell));
  const int v = static_cast<int>(std::floor((at.dot(y_) + half_print_m_) * per_cell));
  if (u < 0 || v < 0 || u >= cells_.cols || v >= cells_.rows) return 1.0f;
  return static_cast<float>(cells_.at<uchar>(v, u)) / 255.0f;
}

}  // namespace poselift::testing
