// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/foot_lock.h"

#include <ceres/cost_function.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lift/frame_span.h"
#include "lift/ik/articulation.h"
#include "lift/ik/pose_problem.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kMaxIterations = 50;
constexpr double kFunctionTolerance = 1e-8;
// Beside pulls of 1 / dof_sigma this is as good as rigid.
constexpr double kLimitStiffness_per_rad = 1e3;

// Of one point: how far it is to go in each frame, and how much that counts.
struct Correction {
  Eigen::Matrix3Xd offset_m;
  Eigen::VectorXd strength;  // 0 no contact nearby, 1 in contact
};

double SmoothStep(double x) { return x * x * (3.0 - 2.0 * x); }

// Towards frame t from a contact's end `distance` frames away.
double Fade(double distance, double reach) {
  return distance < reach ? SmoothStep(1.0 - distance / reach) : 0.0;
}

Correction CorrectionOf(const Eigen::Matrix3Xd& path_m, const std::vector<bool>& contact,
                        double blend_frames) {
  Correction correction{Eigen::Matrix3Xd::Zero(3, path_m.cols()),
                        Eigen::VectorXd::Zero(path_m.cols())};
  const std::vector<FrameSpan> spans = SpansOf(contact);
  for (const FrameSpan& span : spans) {
    const auto steps_m = path_m.middleCols(span.first, span.NumFrames());
    const Eigen::Vector3d target_m = steps_m.rowwise().mean();
    correction.offset_m.middleCols(span.first, span.NumFrames()) = (-steps_m).colwise() + target_m;
    correction.strength.segment(span.first, span.NumFrames()).setOnes();
  }
  const auto fade_from = [&](int frame, int step, double reach) {
    for (int n = 1; n < reach; ++n) {
      const int t = frame + n * step;
      if (t < 0 || t >= path_m.cols()) break;
      const double part = Fade(n, reach);
      correction.offset_m.col(t) += part * correction.offset_m.col(frame);
      correction.strength[t] += part;
    }
  };
  // Two fades that share a gap add up to 1 in it.
  for (size_t i = 0; i <= spans.size(); ++i) {
    double reach = blend_frames + 1.0;
    if (i > 0 && i < spans.size())
      reach = std::min(reach, static_cast<double>(spans[i].first - spans[i - 1].last));
    if (i > 0) fade_from(spans[i - 1].last, 1, reach);
    if (i < spans.size()) fade_from(spans[i].first, -1, reach);
  }
  return correction;
}

class FrameLock {
 public:
  FrameLock(const Motion& motion, const FootContacts& contacts, const FootLockOptions& options)
      : motion_(motion), options_(options), body_(motion.skeleton), limits_(body_, true) {
    std::array<Eigen::Matrix3Xd, 4> paths_m;
    for (Eigen::Matrix3Xd& path_m : paths_m) path_m.resize(3, std::ssize(motion.frames));
    for (size_t t = 0; t < motion.frames.size(); ++t) {
      const Pose3 joints_m = JointPositions(body_, motion.frames[t]);
      for (size_t k = 0; k < kFootJoints.size(); ++k)
        paths_m[k].col(static_cast<Eigen::Index>(t)) = joints_m.col(kFootJoints[k]);
    }
    const double blend_frames = std::round(options.blend_s / motion.frame_time_s);
    for (size_t k = 0; k < kFootJoints.size(); ++k)
      corrections_[k] = CorrectionOf(paths_m[k], contacts.joints[k], blend_frames);
  }

  bool IsLocked(Eigen::Index t) const {
    return IsKnown(motion_.frames[static_cast<size_t>(t)]) &&
           std::any_of(corrections_.begin(), corrections_.end(),
                       [t](const Correction& c) { return c.strength[t] > 0.0; });
  }

  PoseProblemOutcome Solve(Eigen::Index t, SkeletonPose* pose) const {
    DofSprings springs{.limits = limits_,
                       .rest = pose->dofs,
                       .pull = 1.0 / options_.dof_sigma_rad,
                       .stiffness = kLimitStiffness_per_rad};
    springs.limits.lower = limits_.lower.cwiseMin(pose->dofs);
    springs.limits.upper = limits_.upper.cwiseMax(pose->dofs);
    PoseProblem problem(body_, *pose, springs);
    problem.AddPoseTerm(MakeSpaceCost(body_, Targets(t, *pose), false));
    const PoseProblemOutcome outcome = problem.Solve(kMaxIterations, kFunctionTolerance);
    if (IsUsable(outcome.status)) *pose = problem.pose();
    return outcome;
  }

 private:
  std::vector<TargetPoint> Targets(Eigen::Index t, const SkeletonPose& pose) const {
    const Pose3 joints_m = JointPositions(body_, pose);
    std::vector<TargetPoint> targets;
    for (int j = 0; j < kNumJoints; ++j) {
      if (!joints_m.col(j).allFinite()) continue;
      TargetPoint target{{{j, 1.0}}, joints_m.col(j), 1.0 / options_.joint_sigma_m};
      const auto* foot = std::find(kFootJoints.begin(), kFootJoints.end(), j);
      if (foot != kFootJoints.end()) {
        const Correction& correction = corrections_[foot - kFootJoints.begin()];
        target.x += correction.offset_m.col(t);
        target.root_weight *=
            std::pow(options_.joint_sigma_m / options_.contact_sigma_m, correction.strength[t]);
      }
      targets.push_back(std::move(target));
    }
    return targets;
  }

  const Motion& motion_;
  const FootLockOptions& options_;
  Articulation body_;
  DofLimits limits_;
  std::array<Correction, 4> corrections_;
};

}  // namespace

std::string FootLockOptions::Validate() const {
  if (!(blend_s >= 0.0 && blend_s <= 10.0))
    return fmt::format("FootLockOptions::blend_s = {}, wanted 0 to 10", blend_s);
  if (!(contact_sigma_m > 0.0 && joint_sigma_m >= contact_sigma_m && dof_sigma_rad > 0.0))
    return fmt::format(
        "FootLockOptions: contact_sigma_m = {}, joint_sigma_m = {}, dof_sigma_rad = {}, wanted "
        "above 0 and contact <= joint",
        contact_sigma_m, joint_sigma_m, dof_sigma_rad);
  return "";
}

LockedFeet LockFeet(const Motion& motion, const FootContacts& contacts,
                    const FootLockOptions& options, const ProgressFn& progress) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  for (const std::vector<bool>& contact : contacts.joints)
    if (contact.size() != motion.frames.size())
      throw std::invalid_argument("LockFeet: the contacts have another number of frames");
  const FrameLock lock(motion, contacts, options);
  LockedFeet locked{motion, 0, 0};
  std::atomic<int> num_locked = 0, num_failures = 0, done = 0;
#pragma omp parallel for schedule(dynamic, 16)
  for (Eigen::Index t = 0; t < std::ssize(motion.frames); ++t) {
    if (lock.IsLocked(t)) {
      ++num_locked;
      const auto outcome = lock.Solve(t, &locked.motion.frames[static_cast<size_t>(t)]);
      if (!IsUsable(outcome.status)) ++num_failures;
    }
    const int now = ++done;
    if (progress) progress(now / static_cast<double>(motion.frames.size()));
  }
  locked.num_locked_frames = num_locked;
  locked.num_failures = num_failures;
  return locked;
}

}  // namespace poselift
