// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_pose.h"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "src/input_error.h"
#include "src/tag_detection.h"

namespace poselift {
namespace {

using Corners = Eigen::Matrix<double, 2, 4>;
using Residuals = Eigen::Matrix<double, 8, 1>;
using Jacobian = Eigen::Matrix<double, 8, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kMaxIterations = 30;
constexpr double kConverged = 1e-10;  // of a step, in radians and tag sizes
constexpr double kSamePose_rad = 1e-3;
constexpr double kMostSigmas = 5.0;

const Eigen::DiagonalMatrix<double, 3> kRosFromTag(1.0, -1.0, -1.0);

Eigen::Matrix3d ExpRotation(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  return angle < 1e-12 ? Eigen::Matrix3d::Identity()
                       : Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

// d pixel / d x_in_cam, by differences: the lens model has no simpler form.
Eigen::Matrix<double, 2, 3> ProjectionJacobian(const Camera& camera, const Eigen::Vector3d& x) {
  Eigen::Matrix<double, 2, 3> jacobian;
  const double step = 1e-6 * x.z();
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d ahead = x, behind = x;
    ahead[k] += step;
    behind[k] -= step;
    jacobian.col(k) = (camera.Project(ahead) - camera.Project(behind)) / (2.0 * step);
  }
  return jacobian;
}

// One tag seen by one camera.
class Problem {
 public:
  Problem(const Camera& camera, const Corners& corners_px, double size_m)
      : camera_(camera), corners_px_(corners_px), corners_m_(TagCorners_m(size_m)) {}

  Residuals Residual(const Eigen::Isometry3d& cam_from_tag) const {
    Residuals r;
    for (int i = 0; i < 4; ++i)
      r.segment<2>(2 * i) = camera_.Project(cam_from_tag * corners_m_.col(i)) - corners_px_.col(i);
    return r;
  }

  Jacobian Derivative(const Eigen::Isometry3d& cam_from_tag) const {
    Jacobian J;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d arm = cam_from_tag.linear() * corners_m_.col(i);
      Eigen::Matrix3d turned;  // d (exp(w) arm) / d w
      turned << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
      const Eigen::Matrix<double, 2, 3> px_from_cam =
          ProjectionJacobian(camera_, arm + cam_from_tag.translation());
      J.block<2, 3>(2 * i, 0) = px_from_cam * turned;
      J.block<2, 3>(2 * i, 3) = px_from_cam;
    }
    return J;
  }

 private:
  const Camera& camera_;
  const Corners& corners_px_;
  Eigen::Matrix<double, 3, 4> corners_m_;
};

Eigen::Isometry3d Moved(const Eigen::Isometry3d& pose, const Vector6& step) {
  Eigen::Isometry3d moved = pose;
  moved.linear() = ExpRotation(step.head<3>()) * pose.linear();
  moved.translation() += step.tail<3>();
  return moved;
}

// Levenberg-Marquardt to the minimum that is downhill from the start.
Eigen::Isometry3d Refined(const Problem& problem, Eigen::Isometry3d pose, double size_m) {
  double error = problem.Residual(pose).squaredNorm();
  double damping = 1e-4;
  for (int iteration = 0; iteration < kMaxIterations && damping < 1e8; ++iteration) {
    const Jacobian J = problem.Derivative(pose);
    Eigen::Matrix<double, 6, 6> normal = J.transpose() * J;
    const Vector6 gradient = J.transpose() * problem.Residual(pose);
    normal.diagonal() *= 1.0 + damping;
    const Vector6 step = -normal.ldlt().solve(gradient);
    const Eigen::Isometry3d candidate = Moved(pose, step);
    const double candidate_error = problem.Residual(candidate).squaredNorm();
    if (!(candidate_error <= error)) {  // NaN too
      damping *= 10.0;
      continue;
    }
    pose = candidate;
    error = candidate_error;
    damping = std::max(0.1 * damping, 1e-12);
    if (step.head<3>().norm() < kConverged && step.tail<3>().norm() < kConverged * size_m) break;
  }
  pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return pose;
}

// Both solutions for pixels without distortion, by IPPE.
std::vector<Eigen::Isometry3d> Starts(const Camera& camera, const Corners& corners_px,
                                      double size_m) {
  const double half = 0.5 * size_m;
  const std::vector<cv::Point3d> square = {
      {-half, half, 0}, {half, half, 0}, {half, -half, 0}, {-half, -half, 0}};
  std::vector<cv::Point2d> seen;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d ray = camera.Undistort(corners_px.col(i));
    if (!ray.allFinite()) return {};
    seen.emplace_back(ray.x(), ray.y());
  }
  std::vector<cv::Mat> rotations, positions;
  try {
    cv::solvePnPGeneric(square, seen, cv::Matx33d::eye(), cv::noArray(), rotations, positions,
                        false, cv::SOLVEPNP_IPPE_SQUARE);
  } catch (const cv::Exception&) {  // corners on a line
    return {};
  }
  std::vector<Eigen::Isometry3d> starts;
  for (size_t k = 0; k < rotations.size(); ++k) {
    const Eigen::Vector3d w(rotations[k].ptr<double>()), t(positions[k].ptr<double>());
    if (!(w.allFinite() && t.allFinite() && t.z() > 0.0)) continue;
    Eigen::Isometry3d cam_from_ros = Eigen::Isometry3d::Identity();
    cam_from_ros.linear() = ExpRotation(w);
    cam_from_ros.translation() = t;
    starts.push_back(CamFromRosTag(cam_from_ros));  // its own inverse
  }
  return starts;
}

double Angle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

double Squared(double off, double sigma) {
  const double sigmas = std::min(off / sigma, kMostSigmas);
  return sigmas * sigmas;
}

// Minus twice the logarithm of how likely a pose is, by hints alone.
double HintsCost(const Eigen::Isometry3d& pose, const TagPoseHints& hints) {
  double cost = 0.0;
  if (hints.last)
    cost +=
        Squared(Angle(pose.linear(), hints.last->cam_from_tag.linear()), hints.last->sigma_rad) +
        Squared((pose.translation() - hints.last->cam_from_tag.translation()).norm(),
                hints.last->sigma_m);
  if (hints.body)
    cost += Squared(Angle(pose.linear(), hints.body->cam_from_tag.toRotationMatrix()),
                    hints.body->sigma_rad);
  if (hints.gravity) {
    const Eigen::Vector3d a = pose.linear() * hints.gravity->down_in_tag;
    const Eigen::Vector3d& b = hints.gravity->down_in_cam;
    cost += Squared(std::atan2(a.cross(b).norm(), a.dot(b)), hints.gravity->sigma_rad);
  }
  return cost;
}

double CornersCost(const TagPose& pose, const TagPoseOptions& options) {
  return 8.0 * pose.rms_px * pose.rms_px / (options.corner_sigma_px * options.corner_sigma_px);
}

// Radians, about the axis of which least is known.
double RotationSigma(const TagPose& pose) {
  const Eigen::Matrix3d rotation = pose.covariance.topLeftCorner<3, 3>();
  return std::sqrt(rotation.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
}

// The pose that looks the same from far away: its third axis mirrored at the picture plane.
Eigen::Isometry3d Mirrored(const Eigen::Isometry3d& pose) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1.0, 1.0, -1.0);
  const Eigen::Matrix3d sight_from_cam =
      Eigen::Quaterniond::FromTwoVectors(pose.translation(), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  Eigen::Isometry3d mirrored = pose;
  mirrored.linear() = sight_from_cam.transpose() * mirror * sight_from_cam * pose.linear() * mirror;
  return mirrored;
}

// Of one minimum alone: noise may have swallowed the other, that of the true pose.
bool IsMirrorLikely(const Problem& problem, const TagPose& pose, const TagPoseOptions& options) {
  const double more = problem.Residual(Mirrored(pose.cam_from_tag)).squaredNorm() -
                      problem.Residual(pose.cam_from_tag).squaredNorm();
  const double sigma = options.corner_sigma_px;
  return 0.5 * more / (sigma * sigma) < std::log(options.ambiguous_odds) &&
         Angle(pose.cam_from_tag.linear(), Mirrored(pose.cam_from_tag).linear()) >
             options.uncertain_rad;
}

}  // namespace

std::string TagPoseOptions::Validate() const {
  if (!(corner_sigma_px > 0.0 && corner_sigma_px <= 100.0))
    return fmt::format("TagPoseOptions::corner_sigma_px = {}, wanted above 0 and at most 100",
                       corner_sigma_px);
  if (!(ambiguous_odds >= 1.0))
    return fmt::format("TagPoseOptions::ambiguous_odds = {}, wanted at least 1", ambiguous_odds);
  if (!(uncertain_rad > 0.0))
    return fmt::format("TagPoseOptions::uncertain_rad = {}, wanted above 0", uncertain_rad);
  return "";
}

TagPoses FindTagPoses(const Camera& camera, const Corners& corners_px, double size_m,
                      const TagPoseOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  if (!(size_m > 0.0)) throw std::invalid_argument("tag pose: a size is above 0");
  TagPoses found;
  if (!corners_px.allFinite()) return found;
  const Problem problem(camera, corners_px, size_m);
  for (const Eigen::Isometry3d& start : Starts(camera, corners_px, size_m)) {
    TagPose pose;
    pose.cam_from_tag = Refined(problem, start, size_m);
    pose.rms_px = std::sqrt(problem.Residual(pose.cam_from_tag).squaredNorm() / 8.0);
    const Jacobian J = problem.Derivative(pose.cam_from_tag);
    const Eigen::Matrix<double, 6, 6> normal = J.transpose() * J;
    pose.covariance = options.corner_sigma_px * options.corner_sigma_px * normal.inverse();
    if (!std::isfinite(pose.rms_px) || !pose.covariance.allFinite()) continue;
    const bool is_new = found.poses.empty() || Angle(found.poses[0].cam_from_tag.linear(),
                                                     pose.cam_from_tag.linear()) > kSamePose_rad;
    if (is_new) found.poses.push_back(pose);
  }
  std::stable_sort(found.poses.begin(), found.poses.end(),
                   [](const TagPose& a, const TagPose& b) { return a.rms_px < b.rms_px; });
  if (!found.poses.empty())
    found.is_ambiguous =
        ChooseTagPose(found, {}, options).is_ambiguous ||
        RotationSigma(found.poses[0]) > options.uncertain_rad ||
        (found.poses.size() == 1 && IsMirrorLikely(problem, found.poses[0], options));
  return found;
}

TagPoseChoice ChooseTagPose(const TagPoses& found, const TagPoseHints& hints,
                            const TagPoseOptions& options) {
  if (found.poses.empty()) throw std::invalid_argument("tag pose: no poses to choose from");
  TagPoseChoice choice{.log_odds = std::numeric_limits<double>::infinity()};
  double lowest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < found.poses.size(); ++k) {
    const TagPose& pose = found.poses[k];
    const double cost = CornersCost(pose, options) + HintsCost(pose.cam_from_tag, hints);
    choice.log_odds = 0.5 * std::abs(cost - lowest);
    if (cost < lowest) {
      lowest = cost;
      choice.index = k;
    }
  }
  choice.is_ambiguous = choice.log_odds < std::log(options.ambiguous_odds);
  return choice;
}

Eigen::Isometry3d CamFromRosTag(const Eigen::Isometry3d& cam_from_tag) {
  Eigen::Isometry3d cam_from_ros = cam_from_tag;
  cam_from_ros.linear() = cam_from_tag.linear() * kRosFromTag;
  return cam_from_ros;
}

}  // namespace poselift
