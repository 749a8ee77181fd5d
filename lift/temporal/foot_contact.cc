// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/foot_contact.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lift/frame_span.h"
#include "lift/ik/articulation.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kUsualLeg_m = 0.85;

// The watched points, 3 x T each; NaN where the frame is unknown.
using FootPaths = std::array<Eigen::Matrix3Xd, 4>;

FootPaths PathsOf(const Motion& motion, const Articulation& body) {
  FootPaths paths_m;
  for (Eigen::Matrix3Xd& path : paths_m) path.resize(3, std::ssize(motion.frames));
  for (Eigen::Index t = 0; t < std::ssize(motion.frames); ++t) {
    const Pose3 joints_m = JointPositions(body, motion.frames[static_cast<size_t>(t)]);
    for (size_t k = 0; k < kFootJoints.size(); ++k)
      paths_m[k].col(t) = joints_m.col(kFootJoints[k]);
  }
  return paths_m;
}

// Hip to knee to ankle, the mean of both legs.
double LegLength_m(const Articulation& body) {
  const Pose3 rest_m = JointPositions(body, SkeletonPose::Rest(body.skeleton));
  double sum_m = 0.0;
  for (const auto& [hip, knee, ankle] :
       {std::array{joint::kLeftHip, joint::kLeftKnee, joint::kLeftAnkle},
        std::array{joint::kRightHip, joint::kRightKnee, joint::kRightAnkle}})
    sum_m +=
        (rest_m.col(hip) - rest_m.col(knee)).norm() + (rest_m.col(knee) - rest_m.col(ankle)).norm();
  return sum_m / 2.0;
}

void RequireLegs(const Articulation& body) {
  for (const int j : {joint::kLeftHip, joint::kLeftKnee, joint::kLeftAnkle, joint::kLeftFoot,
                      joint::kRightHip, joint::kRightKnee, joint::kRightAnkle, joint::kRightFoot})
    if (body.sites[j].bone < 0)
      throw InputError(
          body.skeleton.name,
          fmt::format("found no joint \"{}\", wanted two legs with feet", Joints()[j].name));
}

// Horizontal, across the window or what there is of it; NaN for a lone frame.
double Speed_m_per_s(const Eigen::Matrix3Xd& path_m, Eigen::Index t, Eigen::Index half_window,
                     double frame_time_s) {
  Eigen::Index before = t, after = t;
  while (before > 0 && t - before < half_window && path_m.col(before - 1).allFinite()) --before;
  while (after + 1 < path_m.cols() && after - t < half_window && path_m.col(after + 1).allFinite())
    ++after;
  const Eigen::Vector3d step_m = path_m.col(after) - path_m.col(before);
  return std::hypot(step_m.x(), step_m.z()) / (static_cast<double>(after - before) * frame_time_s);
}

// With a leg's length put in.
FootContactOptions::Thresholds ForLeg(FootContactOptions::Thresholds thresholds,
                                      double leg_length_m) {
  const double scale = leg_length_m / kUsualLeg_m;
  thresholds.on_height_m *= scale;
  thresholds.off_height_m *= scale;
  thresholds.on_speed_m_per_s *= std::sqrt(scale);
  thresholds.off_speed_m_per_s *= std::sqrt(scale);
  return thresholds;
}

double HeightAbove_m(const Eigen::Vector3d& floor, const Eigen::Vector3d& x_m) {
  return x_m.y() - floor.dot(Eigen::Vector3d(1.0, x_m.x(), x_m.z()));
}

// The plane of the header, through the points of one kind.
Eigen::Vector3d FitFloor(const std::vector<Eigen::Vector3d>& slow_m) {
  constexpr int kRounds = 20;
  constexpr double kOutlier_m = 0.02;
  constexpr double kFewMetres = 0.5;  // of ground covered: too few to see a slope
  if (slow_m.empty()) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x_m : slow_m) middle_m += x_m / static_cast<double>(slow_m.size());
  Eigen::Vector3d floor = Eigen::Vector3d::Zero();  // about the middle
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& x_m : slow_m) {
      const Eigen::Vector3d off_m = x_m - middle_m;
      const Eigen::Vector3d row(1.0, off_m.x(), off_m.z());
      const double relative = round == 0 ? 0.0 : HeightAbove_m(floor, off_m) / kOutlier_m;
      const double weight = 1.0 / (1.0 + relative * relative);
      normal += weight * row * row.transpose();
      right += weight * off_m.y() * row;
    }
    const double ridge = normal(0, 0) * kFewMetres * kFewMetres;
    normal.diagonal() += Eigen::Vector3d(0.0, ridge, ridge);
    floor = normal.ldlt().solve(right);
  }
  floor[0] += middle_m.y() - floor[1] * middle_m.x() - floor[2] * middle_m.z();
  return floor;
}

Eigen::Index HalfWindow(const FootContactOptions& options, double frame_time_s) {
  return std::max<Eigen::Index>(1, std::lround(0.5 * options.speed_window_s / frame_time_s));
}

void AddSlow(const Eigen::Matrix3Xd& path_m, Eigen::Index half_window, double frame_time_s,
             double speed_m_per_s, std::vector<Eigen::Vector3d>* slow_m) {
  for (Eigen::Index t = 0; t < path_m.cols(); ++t)
    if (Speed_m_per_s(path_m, t, half_window, frame_time_s) < speed_m_per_s)
      slow_m->push_back(path_m.col(t));
}

std::vector<bool> ContactsOf(const Eigen::Matrix3Xd& path_m, const Eigen::Vector3d& floor,
                             double frame_time_s, const FootContactOptions::Thresholds& thresholds,
                             const FootContactOptions& options) {
  const Eigen::Index half_window = HalfWindow(options, frame_time_s);
  std::vector<bool> contact(static_cast<size_t>(path_m.cols()), false);
  bool stands = false;
  for (Eigen::Index t = 0; t < path_m.cols(); ++t) {
    const double height_m = HeightAbove_m(floor, path_m.col(t));
    const double speed = Speed_m_per_s(path_m, t, half_window, frame_time_s);
    // False for NaN.
    stands = stands ? height_m <= thresholds.off_height_m && speed <= thresholds.off_speed_m_per_s
                    : height_m < thresholds.on_height_m && speed < thresholds.on_speed_m_per_s;
    contact[static_cast<size_t>(t)] = stands;
  }
  for (const FrameSpan& span : SpansOf(contact))
    if (span.NumFrames() * frame_time_s < options.min_contact_s)
      std::fill_n(contact.begin() + span.first, span.NumFrames(), false);
  return contact;
}

std::vector<bool> Either(std::vector<bool> a, const std::vector<bool>& b) {
  for (size_t t = 0; t < a.size(); ++t) a[t] = a[t] || b[t];
  return a;
}

}  // namespace

std::string FootContactOptions::Validate() const {
  for (const Thresholds& t : {ankle, ball})
    if (!(t.on_height_m > 0.0 && t.off_height_m >= t.on_height_m && t.on_speed_m_per_s > 0.0 &&
          t.off_speed_m_per_s >= t.on_speed_m_per_s))
      return fmt::format(
          "FootContactOptions: thresholds of {} and {} m, {} and {} m/s, wanted 0 < on <= off",
          t.on_height_m, t.off_height_m, t.on_speed_m_per_s, t.off_speed_m_per_s);
  if (!(speed_window_s > 0.0 && min_contact_s >= 0.0))
    return fmt::format(
        "FootContactOptions: speed_window_s = {}, min_contact_s = {}, wanted above 0 and 0 or more",
        speed_window_s, min_contact_s);
  return "";
}

std::vector<bool> FootContacts::Left() const { return Either(joints[0], joints[1]); }
std::vector<bool> FootContacts::Right() const { return Either(joints[2], joints[3]); }

FootContacts FindFootContacts(const Motion& motion, const FootContactOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  const Articulation body(motion.skeleton);
  RequireLegs(body);
  const FootPaths paths_m = PathsOf(motion, body);
  FootContacts contacts;
  contacts.leg_length_m = LegLength_m(body);
  const std::array kinds = {ForLeg(options.ankle, contacts.leg_length_m),
                            ForLeg(options.ball, contacts.leg_length_m)};
  const double frame_time_s = motion.frame_time_s;
  for (size_t kind = 0; kind < kinds.size(); ++kind) {
    std::vector<Eigen::Vector3d> slow_m;
    for (const size_t k : {kind, kind + 2})
      AddSlow(paths_m[k], HalfWindow(options, frame_time_s), frame_time_s,
              kinds[kind].on_speed_m_per_s, &slow_m);
    contacts.floors[kind] = FitFloor(slow_m);
    for (const size_t k : {kind, kind + 2})
      contacts.joints[k] =
          ContactsOf(paths_m[k], contacts.floors[kind], frame_time_s, kinds[kind], options);
  }
  return contacts;
}

double FootSlide_mm(const Motion& motion, const FootContacts& contacts) {
  const FootPaths paths_m = PathsOf(motion, Articulation(motion.skeleton));
  double squares_m2 = 0.0;
  int count = 0;
  for (size_t k = 0; k < kFootJoints.size(); ++k)
    for (const FrameSpan& span : SpansOf(contacts.joints[k])) {
      const auto steps_m = paths_m[k].middleCols(span.first, span.NumFrames());
      const Eigen::Vector3d mean_m = steps_m.rowwise().mean();
      const Eigen::Matrix3Xd off_m = steps_m.colwise() - mean_m;
      squares_m2 += off_m.row(0).squaredNorm() + off_m.row(2).squaredNorm();
      count += span.NumFrames();
    }
  return count > 0 ? 1e3 * std::sqrt(squares_m2 / count) : -1.0;
}

}  // namespace poselift
