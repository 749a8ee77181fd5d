// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/view_search.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

// What the views need to know of all atoms; columns are atoms.
struct AtomMoments {
  Eigen::Matrix3Xd with_x, with_y, with_z;           // B b_x^T, B b_y^T, B b_z^T
  Eigen::Matrix<double, 6, Eigen::Dynamic> scatter;  // B B^T: xx xy xz yy yz zz
  Eigen::ArrayXd energy;                             // |B|^2
};

// The points [first, first + target.cols()) of every atom.
AtomMoments Moments(const Eigen::MatrixXd& centred_atoms, Eigen::Index first,
                    const Eigen::Matrix3Xd& target) {
  const Eigen::Index num_atoms = centred_atoms.cols();
  AtomMoments moments;
  moments.with_x.resize(3, num_atoms);
  moments.with_y.resize(3, num_atoms);
  moments.with_z.resize(3, num_atoms);
  moments.scatter.resize(6, num_atoms);
  moments.energy.resize(num_atoms);
  for (Eigen::Index k = 0; k < num_atoms; ++k) {
    const Eigen::Map<const Eigen::Matrix3Xd> B(centred_atoms.col(k).data() + 3 * first, 3,
                                               target.cols());
    moments.with_x.col(k).noalias() = B * target.row(0).transpose();
    moments.with_y.col(k).noalias() = B * target.row(1).transpose();
    moments.with_z.col(k).noalias() = B * target.row(2).transpose();
    const Eigen::Matrix3d S = B * B.transpose();
    moments.scatter.col(k) << S(0, 0), S(0, 1), S(0, 2), S(1, 1), S(1, 2), S(2, 2);
    moments.energy[k] = S.trace();
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
  // A quarter of an atom's energy must be seen: a body end on fits anything.
  const Eigen::ArrayXd gain =
      (norm > 0.25 * moments.energy && product > 0.0).select(product.square() / norm, 0.0);
  ViewStart start;
  Eigen::Index best = 0;
  start.cost = target_squared - gain.maxCoeff(&best);
  start.atom = static_cast<int>(best);
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
  const int num_3d = op.Num3D();
  const bool is_3d = num_3d > op.Num2D();
  Eigen::Matrix3Xd target = Eigen::Matrix3Xd::Zero(3, is_3d ? num_3d : op.Num2D());
  if (is_3d) {
    target = op.target().segment(2 * op.Num2D(), 3 * num_3d).reshaped(3, num_3d);
  } else {
    target.topRows<2>() = op.target().head(2 * op.Num2D()).reshaped(2, op.Num2D());
  }
  const AtomMoments moments = Moments(centred_atoms, is_3d ? op.Num2D() : 0, target);

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
  for (ViewStart& start : starts)
    start.scale_px_per_unit = op.BestScale_px_per_m(
        CamFromBody(start.tau_rad), centred_atoms.col(start.atom).reshaped(3, op.NumPoints()), 1.0);
  return starts;
}

}  // namespace poselift
