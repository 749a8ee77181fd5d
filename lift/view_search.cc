// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/view_search.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>

namespace poselift {
namespace {

// What the views need to know of all atoms; columns are atoms.
struct AtomMoments {
  Eigen::Matrix3Xd with_x, with_y, with_z;           // B b_x^T, B b_y^T, B b_z^T
  Eigen::Matrix<double, 6, Eigen::Dynamic> scatter;  // B B^T: xx xy xz yy yz zz
};

AtomMoments Moments(const Eigen::MatrixXd& centred_atoms, Eigen::Index first, Eigen::Index count,
                    const Eigen::Matrix3Xd& target) {
  const Eigen::Index num_atoms = centred_atoms.cols();
  AtomMoments moments{Eigen::Matrix3Xd(3, num_atoms),
                      Eigen::Matrix3Xd(3, num_atoms),
                      Eigen::Matrix3Xd(3, num_atoms),
                      {}};
  moments.scatter.resize(6, num_atoms);
  for (Eigen::Index k = 0; k < num_atoms; ++k) {
    const Eigen::Map<const Eigen::Matrix3Xd> B(centred_atoms.col(k).data() + 3 * first, 3, count);
    moments.with_x.col(k).noalias() = B * target.row(0).transpose();
    moments.with_y.col(k).noalias() = B * target.row(1).transpose();
    moments.with_z.col(k).noalias() = B * target.row(2).transpose();
    const Eigen::Matrix3d S = B * B.transpose();
    moments.scatter.col(k) << S(0, 0), S(0, 1), S(0, 2), S(1, 1), S(1, 2), S(2, 2);
  }
  return moments;
}

// r^T S r for every atom.
Eigen::RowVectorXd Quadratic(const Eigen::Vector3d& r, const AtomMoments& moments) {
  Eigen::Matrix<double, 1, 6> weights;
  weights << r.x() * r.x(), 2 * r.x() * r.y(), 2 * r.x() * r.z(), r.y() * r.y(), 2 * r.y() * r.z(),
      r.z() * r.z();
  return weights * moments.scatter;
}

ViewStart BestAtomOfView(const AtomMoments& moments, bool is_3d, double target_squared,
                         double pitch_rad, double yaw_rad) {
  const Eigen::Matrix3d view = CamFromBody({pitch_rad, yaw_rad, 0.0});
  const Eigen::RowVector3d r1 = view.row(0), r2 = view.row(1), r3 = view.row(2);
  const Eigen::ArrayXd real = (r1 * moments.with_x + r2 * moments.with_y).transpose();
  const Eigen::ArrayXd imaginary = (r1 * moments.with_y - r2 * moments.with_x).transpose();
  Eigen::ArrayXd product = (real.square() + imaginary.square()).sqrt();
  Eigen::ArrayXd norm = (Quadratic(r1, moments) + Quadratic(r2, moments)).transpose();
  if (is_3d) {
    product += (r3 * moments.with_z).transpose().array();
    norm += Quadratic(r3, moments).transpose().array();
  }
  // A third of an atom's energy must be seen: a body end on fits anything.
  const Eigen::ArrayXd whole =
      (moments.scatter.row(0) + moments.scatter.row(3) + moments.scatter.row(5)).transpose();
  const Eigen::ArrayXd gain =
      (norm > 0.25 * whole && product > 0.0).select(product.square() / norm, 0.0);
  ViewStart start;
  Eigen::Index best = 0;
  start.cost = target_squared - gain.maxCoeff(&best);
  start.atom = static_cast<int>(best);
  start.scale_px_per_unit = is_3d ? 1.0 : product[best] / norm[best];
  // CamFromBody with roll c turns the picture by -c.
  start.tau_rad << pitch_rad, yaw_rad, -std::atan2(imaginary[best], real[best]);
  return start;
}

double AngleBetween(const Eigen::Vector3d& tau_a, const Eigen::Vector3d& tau_b) {
  const Eigen::Matrix3d difference = CamFromBody(tau_a).transpose() * CamFromBody(tau_b);
  return std::acos(std::clamp((difference.trace() - 1.0) / 2.0, -1.0, 1.0));
}

}  // namespace

std::string ViewSearchOptions::Validate() const {
  if (num_yaws < 1)
    return fmt::format("ViewSearchOptions::num_yaws = {}, wanted 1 or more", num_yaws);
  if (pitches_rad.empty()) return "ViewSearchOptions::pitches_rad is empty, wanted one or more";
  if (num_starts < 1)
    return fmt::format("ViewSearchOptions::num_starts = {}, wanted 1 or more", num_starts);
  if (!(min_separation_rad >= 0.0))
    return fmt::format("ViewSearchOptions::min_separation_rad = {}, wanted 0 or more",
                       min_separation_rad);
  return "";
}

std::vector<ViewStart> SearchViews(const ProjectionOperator& op,
                                   const Eigen::MatrixXd& centred_atoms,
                                   const RotationOptions& prior, const ViewSearchOptions& options) {
  const bool is_3d = !op.Has2D();
  const Eigen::Index count = op.Has2D() ? op.Num2D() : op.NumPoints();
  Eigen::Matrix3Xd target = Eigen::Matrix3Xd::Zero(3, count);
  const int rows_per_point = is_3d ? 3 : 2;
  target.topRows(rows_per_point) =
      Eigen::Map<const Eigen::MatrixXd>(op.target().data(), rows_per_point, count);
  const AtomMoments moments = Moments(centred_atoms, 0, count, target);

  std::vector<ViewStart> views;
  for (const double pitch : options.pitches_rad)
    for (int i = 0; i < options.num_yaws; ++i) {
      const double yaw = 2 * M_PI * i / options.num_yaws;
      ViewStart view = BestAtomOfView(moments, is_3d, target.squaredNorm(), pitch, yaw);
      view.cost += RotationPriorCost(view.tau_rad, prior);
      views.push_back(view);
    }
  std::stable_sort(views.begin(), views.end(),
                   [](const ViewStart& a, const ViewStart& b) { return a.cost < b.cost; });

  std::vector<ViewStart> starts;
  for (const ViewStart& view : views) {
    if (static_cast<int>(starts.size()) == options.num_starts) break;
    const bool is_new = std::all_of(starts.begin(), starts.end(), [&](const ViewStart& start) {
      return AngleBetween(start.tau_rad, view.tau_rad) >= options.min_separation_rad;
    });
    if (is_new) starts.push_back(view);
  }
  return starts;
}

}  // namespace poselift
