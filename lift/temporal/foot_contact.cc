// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/foot_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lift/frame_span.h"
#include "lift/ik/articulation.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kUsualLeg_m = 0.85;
constexpr int kUp = 1;  // y

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

double Level_m(const Eigen::Matrix3Xd& left_m, const Eigen::Matrix3Xd& right_m, double quantile) {
  std::vector<double> heights_m;
  for (Eigen::Index t = 0; t < left_m.cols(); ++t)
    if (left_m.col(t).allFinite()) heights_m.push_back(std::min(left_m(kUp, t), right_m(kUp, t)));
  if (heights_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto place = heights_m.begin() +
                     static_cast<ptrdiff_t>(quantile * static_cast<double>(heights_m.size() - 1));
  std::nth_element(heights_m.begin(), place, heights_m.end());
  return *place;
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

std::vector<bool> ContactsOf(const Eigen::Matrix3Xd& path_m, double level_m, double frame_time_s,
                             const FootContactOptions::Thresholds& thresholds,
                             const FootContactOptions& options) {
  const auto half_window =
      std::max<Eigen::Index>(1, std::lround(0.5 * options.speed_window_s / frame_time_s));
  std::vector<bool> contact(static_cast<size_t>(path_m.cols()), false);
  bool stands = false;
  for (Eigen::Index t = 0; t < path_m.cols(); ++t) {
    const double height_m = path_m(kUp, t) - level_m;
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
  if (!(level_quantile >= 0.0 && level_quantile <= 1.0))
    return fmt::format("FootContactOptions::level_quantile = {}, wanted 0 to 1", level_quantile);
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
  for (size_t k = 0; k < kFootJoints.size(); ++k) {
    contacts.levels_m[k] = Level_m(paths_m[k % 2], paths_m[k % 2 + 2], options.level_quantile);
    const auto thresholds =
        ForLeg(k % 2 == 0 ? options.ankle : options.ball, contacts.leg_length_m);
    contacts.joints[k] =
        ContactsOf(paths_m[k], contacts.levels_m[k], motion.frame_time_s, thresholds, options);
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
