// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/rendered_tags.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace poselift::testing {
namespace {

// The pixels that the whole print, white border included, may touch.
cv::Rect Bounds(const PlacedTag& tag, double half_print, const cv::Size& size) {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  for (const double u : {-half_print, half_print})
    for (const double v : {-half_print, half_print}) {
      const Eigen::Vector2d px = (tag.px_from_tag * Eigen::Vector3d(u, v, 1)).hnormalized();
      left = std::min(left, px.x()), right = std::max(right, px.x());
      top = std::min(top, px.y()), bottom = std::max(bottom, px.y());
    }
  const cv::Point first(static_cast<int>(left) - 2, static_cast<int>(top) - 2);
  const cv::Point last(static_cast<int>(right) + 3, static_cast<int>(bottom) + 3);
  return cv::Rect(first, last) & cv::Rect({0, 0}, size);
}

}  // namespace

Eigen::Matrix<double, 2, 4> PlacedTag::Corners() const {
  Eigen::Matrix<double, 3, 4> corners;
  corners << -1, 1, 1, -1, -1, -1, 1, 1, 1, 1, 1, 1;
  return (px_from_tag * corners).colwise().hnormalized();
}

Eigen::Matrix3d PxFromTag(const Camera& camera, const Eigen::Isometry3d& cam_from_tag,
                          double size_m) {
  Eigen::Matrix3d px_from_cam, cam_from_plane;
  px_from_cam << camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1;
  cam_from_plane << 0.5 * size_m * cam_from_tag.linear().leftCols<2>(), cam_from_tag.translation();
  return px_from_cam * cam_from_plane;
}

Eigen::Matrix3d PxFromTag(const Eigen::Vector2d& centre_px, double size_px, double turn_rad) {
  const Eigen::Affine2d px_from_tag = Eigen::Translation2d(centre_px) *
                                      Eigen::Rotation2Dd(turn_rad) *
                                      Eigen::UniformScaling<double>(0.5 * size_px);
  return px_from_tag.matrix();
}

void DrawTags(const TagFamily& family, const std::vector<PlacedTag>& tags, cv::Mat* grey,
              double white, double black, int samples) {
  const double cells = family.cells();
  const double half_print = cells / family.cells_of_size();
  for (const PlacedTag& tag : tags) {
    const cv::Mat print = family.Image(tag.id);
    const Eigen::Matrix3d tag_from_px = tag.px_from_tag.inverse();
    const cv::Rect bounds = Bounds(tag, half_print, grey->size());
    for (int y = bounds.y; y < bounds.br().y; ++y)
      for (int x = bounds.x; x < bounds.br().x; ++x) {
        double sum = 0.0;
        for (int i = 0; i < samples; ++i) {
          const Eigen::Vector3d px(x - 0.5 + (i + 0.5) / samples,
                                   y - 0.5 + std::fmod(0.618034 * i, 1.0), 1.0);
          const Eigen::Vector2d cell =
              ((tag_from_px * px).hnormalized().array() / half_print + 1.0) * 0.5 * cells;
          const bool on_print = cell.minCoeff() >= 0.0 && cell.maxCoeff() < cells;
          sum += !on_print ? grey->at<uchar>(y, x)
                 : print.at<uchar>(static_cast<int>(cell.y()), static_cast<int>(cell.x())) > 0
                     ? white
                     : black;
        }
        grey->at<uchar>(y, x) = cv::saturate_cast<uchar>(sum / samples);
      }
  }
}

void AddNoise(double sigma, std::mt19937_64* rng, cv::Mat* grey) {
  std::normal_distribution<double> normal;
  for (int y = 0; y < grey->rows; ++y)
    for (int x = 0; x < grey->cols; ++x) {
      uchar& value = grey->at<uchar>(y, x);
      value = cv::saturate_cast<uchar>(value + sigma * normal(*rng));
    }
}

cv::Mat Clutter(const cv::Size& size, std::mt19937_64* rng) {
  cv::Mat grey(size, CV_8U, cv::Scalar(120));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto up_to = [&](double limit) { return static_cast<float>(limit * unit(*rng)); };
  for (int i = 0; i < 400; ++i) {
    const float edge = 4.0F + 200.0F * std::pow(up_to(1.0), 3.0F);
    const cv::RotatedRect blotch({up_to(size.width), up_to(size.height)},
                                 {edge, edge * (0.3F + up_to(1.0))}, up_to(180.0));
    std::array<cv::Point2f, 4> corners;
    blotch.points(corners.data());
    std::vector<cv::Point> polygon(corners.begin(), corners.end());
    cv::fillConvexPoly(grey, polygon, cv::Scalar(40 + up_to(170.0)), cv::LINE_AA);
  }
  return grey;
}

}  // namespace poselift::testing
