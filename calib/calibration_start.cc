// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/calibration_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "calib/camera_refinement.h"

namespace poselift {
namespace {

std::vector<cv::Point2d> BoardPoints(const CalibrationBoard& board, const BoardView& view) {
  std::vector<cv::Point2d> points;
  for (const int id : view.ids)
    points.emplace_back(board.corners_in_board_m(0, id), board.corners_in_board_m(1, id));
  return points;
}

Eigen::Matrix3d ToEigen(const cv::Mat& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m.at<double>(i, j);
  return result;
}

// The value where half of the weight lies below. By weight; not empty.
double WeightedMedian(std::vector<std::pair<double, double>> values_and_weights) {
  std::sort(values_and_weights.begin(), values_and_weights.end());
  double total = 0.0;
  for (const auto& [value, weight] : values_and_weights) total += weight;
  double below = 0.0;
  for (const auto& [value, weight] : values_and_weights)
    if ((below += weight) >= 0.5 * total) return value;
  return values_and_weights.back().first;
}

std::vector<Eigen::Isometry3d> PlanarPoses(const std::vector<cv::Point2d>& on_board_m,
                                           const std::vector<cv::Point2d>& normalised) {
  std::vector<cv::Point3d> points_m;
  for (const cv::Point2d& p : on_board_m) points_m.emplace_back(p.x, p.y, 0.0);
  std::vector<cv::Mat> rotations, translations;
  try {
    cv::solvePnPGeneric(points_m, normalised, cv::Matx33d::eye(), {}, rotations, translations,
                        false, cv::SOLVEPNP_IPPE);
  } catch (const cv::Exception&) {  // no homography through the corners
    return {};
  }
  std::vector<Eigen::Isometry3d> poses;
  for (size_t i = 0; i < rotations.size(); ++i) {
    cv::Mat R;
    cv::Rodrigues(rotations[i], R);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = ToEigen(R);
    for (int k = 0; k < 3; ++k) pose.translation()[k] = translations[i].at<double>(k);
    if (pose.matrix().allFinite() && pose.translation().z() > 0.0) poses.push_back(pose);
  }
  return poses;
}

}  // namespace

std::optional<Eigen::Matrix3d> BoardHomography(const CalibrationBoard& board,
                                               const BoardView& view) {
  if (view.ids.size() < 4) return std::nullopt;
  std::vector<cv::Point2d> seen;
  for (Eigen::Index i = 0; i < view.corners_px.cols(); ++i)
    seen.emplace_back(view.corners_px(0, i), view.corners_px(1, i));
  const cv::Mat H = cv::findHomography(BoardPoints(board, view), seen);
  if (H.empty()) return std::nullopt;
  const Eigen::Matrix3d homography = ToEigen(H);
  if (!homography.allFinite()) return std::nullopt;
  return homography;
}

std::optional<double> FocalLengthFromViews_px(const std::vector<Eigen::Matrix3d>& px_from_board,
                                              int width_px, int height_px) {
  // In units of the picture's size about its middle all numbers are near 1.
  const double size_px = std::max(width_px, height_px);
  Eigen::Matrix3d unit_from_px = Eigen::Matrix3d::Identity();
  unit_from_px.topLeftCorner<2, 2>() /= size_px;
  unit_from_px(0, 2) = -0.5 * (width_px - 1) / size_px;
  unit_from_px(1, 2) = -0.5 * (height_px - 1) / size_px;
  constexpr double kShortest = 0.2, kLongest = 20.0;  // of the picture's size
  std::vector<std::pair<double, double>> focal_lengths;
  for (const Eigen::Matrix3d& H_px : px_from_board) {
    Eigen::Matrix3d H = unit_from_px * H_px;
    H /= H.leftCols<2>().norm();
    const double a[2] = {H(0, 0) * H(0, 1) + H(1, 0) * H(1, 1),
                         H.col(0).head<2>().squaredNorm() - H.col(1).head<2>().squaredNorm()};
    const double b[2] = {H(2, 0) * H(2, 1), H(2, 0) * H(2, 0) - H(2, 1) * H(2, 1)};
    for (int i = 0; i < 2; ++i) {
      const double f2 = -a[i] / b[i];
      if (f2 > kShortest * kShortest && f2 < kLongest * kLongest)
        focal_lengths.emplace_back(std::sqrt(f2), std::abs(a[i]));
    }
  }
  if (focal_lengths.empty()) return std::nullopt;
  return size_px * WeightedMedian(std::move(focal_lengths));
}

std::optional<Eigen::Isometry3d> FindBoardPose(const CalibrationBoard& board, const BoardView& view,
                                               const Camera& camera, double loss_px) {
  std::vector<cv::Point2d> normalised;
  for (Eigen::Index i = 0; i < view.corners_px.cols(); ++i) {
    const Eigen::Vector3d ray = camera.Undistort(view.corners_px.col(i));
    if (!ray.allFinite()) return std::nullopt;
    normalised.emplace_back(ray.x(), ray.y());
  }
  if (normalised.size() < 4) return std::nullopt;
  std::optional<Eigen::Isometry3d> best;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Isometry3d pose : PlanarPoses(BoardPoints(board, view), normalised)) {
    const RefinementResult refined = RefineBoardPose(board, view, camera, loss_px, &pose);
    if (!refined.is_done || refined.cost_px2 >= least) continue;
    least = refined.cost_px2;
    best = pose;
  }
  return best;
}

}  // namespace poselift
