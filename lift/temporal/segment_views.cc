// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/segment_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr size_t kQueriesAtOnce = 16;
constexpr int kNewtonSteps = 3;
constexpr double kLongestStep_rad = 0.5;

// a_cc c^2 + a_ss s^2 + 2 a_cs c s - 2 b_c c - 2 b_s s, with c^2 + s^2 = 1.
struct CircleQuadratic {
  double a_cc, a_ss, a_cs, b_c, b_s;

  double At(double psi) const {
    const double c = std::cos(psi), s = std::sin(psi);
    return a_cc * c * c + a_ss * s * s + 2.0 * a_cs * c * s - 2.0 * b_c * c - 2.0 * b_s * s;
  }

  // From the minimum of the linear part, which the rest moves but little.
  double Argmin() const {
    double psi = std::atan2(b_s, b_c);
    for (int i = 0; i < kNewtonSteps; ++i) {
      const double c = std::cos(psi), s = std::sin(psi);
      const double slope =
          2.0 * ((a_ss - a_cc) * c * s + a_cs * (c * c - s * s) + b_c * s - b_s * c);
      const double bend =
          2.0 * ((a_ss - a_cc) * (c * c - s * s) - 4.0 * a_cs * c * s + b_c * c + b_s * s);
      if (bend <= 0.0) break;
      psi -= std::clamp(slope / bend, -kLongestStep_rad, kLongestStep_rad);
    }
    return psi;
  }
};

// The points of all samples, about the middle's place and heading.
Eigen::Matrix3Xd PointsOf(const Skeleton& skeleton, const JointSites& sites,
                          const Eigen::Ref<const Eigen::VectorXf>& segment,
                          const std::vector<std::vector<Landmark::Part>>& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix3Xd placed(3, kSegmentSamples * count);
  BoneFrames frames;
  for (int k = 0; k < kSegmentSamples; ++k) {
    const SkeletonPose pose =
        PoseOfSample(segment.segment<kNumFeatures>(k * kNumFeatures).cast<double>());
    ForwardKinematics(skeleton, pose, &frames);
    const Pose3 joints_m = JointPositions(sites, frames);
    for (Eigen::Index i = 0; i < count; ++i)
      placed.col(k * count + i) = SumOfJoints(points[static_cast<size_t>(i)], joints_m);
  }
  return placed;
}

}  // namespace

std::string SegmentViewsOptions::Validate() const {
  if (!(path_weight >= 0.0 && path_weight <= 1.0))
    return fmt::format("SegmentViewsOptions::path_weight = {}, wanted 0 to 1", path_weight);
  return "";
}

SegmentViews::SegmentViews(const MotionCodebook& codebook,
                           const std::vector<std::vector<Landmark::Part>>& points,
                           const SegmentViewsOptions& options)
    : options_(options), num_points_(static_cast<int>(points.size())) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
  const Eigen::Index rows = kSegmentSamples * num_points_;
  const Eigen::Index count = codebook.NumSegments();
  for (Eigen::MatrixXf* matrix : {&x_, &y_, &z_, &x_still_, &z_still_}) matrix->resize(rows, count);
  const JointSites sites = FindJointSites(codebook.skeleton);
#pragma omp parallel for
  for (Eigen::Index e = 0; e < count; ++e) {
    Query placed = PointsOf(codebook.skeleton, sites, codebook.segments.col(e), points);
    Eigen::RowVectorXd x_still, z_still;
    Centre(&placed, &x_still, &z_still);
    x_.col(e) = placed.row(0).cast<float>();
    y_.col(e) = placed.row(1).cast<float>();
    z_.col(e) = placed.row(2).cast<float>();
    x_still_.col(e) = x_still.cast<float>();
    z_still_.col(e) = z_still.cast<float>();
  }
  const auto products = [](const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
    return Eigen::VectorXf(a.cwiseProduct(b).colwise().sum());
  };
  xx_ = products(x_, x_);
  yy_ = products(y_, y_);
  zz_ = products(z_, z_);
  xz_ = products(x_, z_);
  xx_still_ = products(x_still_, x_still_);
  zz_still_ = products(z_still_, z_still_);
  xz_still_ = products(x_still_, z_still_);
}

void SegmentViews::Centre(Query* points, Eigen::RowVectorXd* x_without_path,
                          Eigen::RowVectorXd* z_without_path) const {
  Query still = *points;
  for (int k = 0; k < kSegmentSamples; ++k) {
    const Eigen::Vector3d mean = points->middleCols(k * num_points_, num_points_).rowwise().mean();
    still.middleCols(k * num_points_, num_points_).colwise() -= mean;
    points->middleCols(k * num_points_, num_points_).colwise() -=
        (1.0 - options_.path_weight) * mean;
  }
  const Eigen::Vector3d mean = points->rowwise().mean();
  points->colwise() -= mean;
  *x_without_path = still.row(0);
  *z_without_path = still.row(2);
}

std::vector<std::vector<SegmentView>> SegmentViews::FindNearest(const std::vector<Query>& queries,
                                                                double depth_weight,
                                                                int count) const {
  std::vector<std::vector<SegmentView>> nearest(queries.size());
  const size_t num_batches = (queries.size() + kQueriesAtOnce - 1) / kQueriesAtOnce;
#pragma omp parallel for schedule(dynamic)
  for (size_t batch = 0; batch < num_batches; ++batch)
    FindNearestOf(queries, batch * kQueriesAtOnce,
                  std::min(queries.size(), (batch + 1) * kQueriesAtOnce), depth_weight, count,
                  &nearest);
  return nearest;
}

void SegmentViews::FindNearestOf(const std::vector<Query>& queries, size_t first, size_t last,
                                 double depth_weight, int count,
                                 std::vector<std::vector<SegmentView>>* nearest) const {
  const auto num_queries = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXf x(x_.rows(), num_queries), y = x, z = x;
  for (Eigen::Index i = 0; i < num_queries; ++i) {
    Query query = queries[first + static_cast<size_t>(i)];
    Eigen::RowVectorXd x_still, z_still;
    Centre(&query, &x_still, &z_still);
    x.col(i) = query.row(0).cast<float>();
    y.col(i) = query.row(1).cast<float>();
    z.col(i) = z_still.cast<float>();
  }
  const Eigen::MatrixXf x_x = x_.transpose() * x, z_x = z_.transpose() * x,
                        y_y = y_.transpose() * y, x_z = x_still_.transpose() * z,
                        z_z = z_still_.transpose() * z;
  const double w = depth_weight * depth_weight;
  const auto num_segments = x_.cols();
  std::vector<SegmentView> views(static_cast<size_t>(num_segments));
  for (Eigen::Index i = 0; i < num_queries; ++i) {
    const double constant =
        x.col(i).squaredNorm() + y.col(i).squaredNorm() + w * z.col(i).squaredNorm();
    for (Eigen::Index e = 0; e < num_segments; ++e) {
      const CircleQuadratic by_psi{xx_[e] + w * zz_still_[e], zz_[e] + w * xx_still_[e],
                                   xz_[e] - w * xz_still_[e], x_x(e, i) + w * z_z(e, i),
                                   z_x(e, i) - w * x_z(e, i)};
      SegmentView& view = views[static_cast<size_t>(e)];
      view.segment = static_cast<int>(e);
      view.psi_rad = by_psi.Argmin();
      view.mean_squared_m2 =
          std::max(0.0, constant + yy_[e] - 2.0 * y_y(e, i) + by_psi.At(view.psi_rad)) /
          static_cast<double>(x.rows());
    }
    const auto kept = std::min(static_cast<std::ptrdiff_t>(count), std::ssize(views));
    std::partial_sort(views.begin(), views.begin() + kept, views.end(),
                      [](const SegmentView& a, const SegmentView& b) {
                        return std::pair(a.mean_squared_m2, a.segment) <
                               std::pair(b.mean_squared_m2, b.segment);
                      });
    (*nearest)[first + static_cast<size_t>(i)].assign(views.begin(), views.begin() + kept);
  }
}

}  // namespace poselift
