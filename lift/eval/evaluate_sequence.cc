// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/eval/evaluate_sequence.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <random>
#include <stdexcept>
#include <utility>

#include "lift/eval/pose_error.h"
#include "lift/eval/sequence_error.h"
#include "lift/eval/thread_time.h"
#include "lift/ik/inverse_kinematics.h"
#include "lift/normalize.h"
#include "src/joint_angles.h"
#include "src/level_camera.h"

namespace poselift {
namespace {

// A trial before its camera.
struct Case {
  const SequenceTrial* trial;
  double noise_px;
  SequenceView view;
  std::vector<Observation> observations;
};

Case MakeCase(const SequenceTrial& trial, double noise_px, const EvaluateSequenceOptions& options) {
  // The same view of a trial whatever the noise and the other trials.
  std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(options.seed),
                                      static_cast<std::uint32_t>(options.seed >> 32)};
  words.insert(words.end(), trial.name.begin(), trial.name.end());
  std::seed_seq seeds(words.begin(), words.end());
  std::mt19937_64 rng(seeds);
  SequenceViewOptions view = options.view;
  view.noise_px = noise_px;
  const Layout& layout = *FindLayout(options.layout);
  Case made{&trial, noise_px, MakeSequenceView(trial.own, layout, view, &rng), {}};
  for (const PersonLabels& labels : made.view.labels)
    made.observations.push_back(Observe(labels, layout));
  return made;
}

// On the standard skeleton, world being cam.
SkeletonPose TruePose(const Case& of, size_t frame) {
  SkeletonPose pose = of.trial->standard.frames[frame];
  pose.world_from_root = Eigen::Quaterniond(of.view.cam_from_world) * pose.world_from_root;
  return pose;
}

// The standard skeleton's pose in each frame, world being cam; one that cannot be
// found is that of the frame before.
std::vector<SkeletonPose> PosesOf(const std::vector<Pose3>& joints_in_cam_m,
                                  const InverseKinematics& ik) {
  const Skeleton& skeleton = ik.body().skeleton;
  const Eigen::VectorXd lengths_m = BoneLengths(skeleton);
  std::vector<SkeletonPose> poses;
  IkHints hints;
  for (const Pose3& joints : joints_in_cam_m) {
    const IkResult result = ik.Solve(NormalizePose(joints, lengths_m), hints);
    if (IsUsable(result.status)) hints.start = result.pose;
    poses.push_back(hints.start.value_or(SkeletonPose::Rest(skeleton)));
  }
  return poses;
}

// Of each bone, mean over the frames.
Eigen::VectorXd MeanLengths_m(const std::vector<Pose3>& joints_in_cam_m) {
  Eigen::VectorXd lengths_m = Eigen::VectorXd::Zero(kNumJoints);
  for (const Pose3& pose : joints_in_cam_m)
    for (int j = 1; j < kNumJoints; ++j)
      lengths_m[j] += (pose.col(j) - pose.col(Joints()[j].parent)).norm();
  return lengths_m / static_cast<double>(joints_in_cam_m.size());
}

GroupVector BoneErrors_percent(const std::vector<Pose3>& estimate,
                               const std::vector<Pose3>& truth) {
  const Eigen::VectorXd lengths_m = MeanLengths_m(truth);
  const GroupVector log_ratios = LogRatios(MeanLengths_m(estimate), lengths_m);
  return 100.0 * ((log_ratios.array() - LogStature(log_ratios, lengths_m)).exp() - 1.0);
}

// Of all frames' angles of limbs, or all others, the errors in standard deviations.
std::vector<double> ErrorsInSigmas(const SequenceEstimate& estimate, const Case& of, bool of_limb) {
  const JointAngleReader reader(of.trial->standard.skeleton);
  std::vector<double> errors;
  for (Eigen::Index t = 0; t < estimate.angles_deg.cols(); ++t) {
    const Eigen::VectorXd true_deg =
        reader.ReadDeg(LevelFromCam(TruePose(of, static_cast<size_t>(t))));
    for (Eigen::Index a = 0; a < true_deg.size(); ++a) {
      const double sigma_deg = estimate.angles_sigma_deg(a, t);
      if (IsOfLimb(JointAngles()[static_cast<size_t>(a)]) != of_limb || !std::isfinite(sigma_deg))
        continue;
      const double error_deg = std::remainder(estimate.angles_deg(a, t) - true_deg[a], 360.0);
      errors.push_back(std::abs(error_deg) / sigma_deg);
    }
  }
  return errors;
}

// The three numbers; NaN for a method that does not say how sure it is.
Eigen::Array3d Calibration(std::vector<double> errors_in_sigmas) {
  constexpr double kShareWithinOne = 0.6827;  // of a Gaussian
  if (errors_in_sigmas.empty()) return Eigen::Array3d::Constant(std::nan(""));
  std::sort(errors_in_sigmas.begin(), errors_in_sigmas.end());
  const auto count = static_cast<double>(errors_in_sigmas.size());
  const auto share_within = [&](double sigmas) {
    const auto end = std::upper_bound(errors_in_sigmas.begin(), errors_in_sigmas.end(), sigmas);
    return static_cast<double>(end - errors_in_sigmas.begin()) / count;
  };
  return {share_within(1.0), share_within(2.0),
          errors_in_sigmas[static_cast<size_t>(kShareWithinOne * count)]};
}

SequenceEvaluation Measure(std::string method, const SequenceEstimate& estimate, double ms,
                           const Case& of, const InverseKinematics& ik) {
  const std::vector<Pose3>& joints_in_cam_m = estimate.joints_in_cam_m;
  const std::vector<Pose3>& truth = of.view.joints_in_cam_m;
  if (joints_in_cam_m.size() != truth.size())
    throw std::invalid_argument("EvaluateSequences: " + method + " has not a pose for each frame");
  SequenceEvaluation row{std::move(method), of.trial->name, of.noise_px};
  row.poses = PosesOf(joints_in_cam_m, ik);
  for (size_t t = 0; t < truth.size(); ++t) {
    row.errors[measure::kCam_mm] += CamError_mm(joints_in_cam_m[t], truth[t]);
    row.errors[measure::kPa_mm] += PaError_mm(joints_in_cam_m[t], truth[t]);
    row.errors[measure::kRoot_mm] += RootError_mm(joints_in_cam_m[t], truth[t]);
    row.errors[measure::kAngle_deg] +=
        MeanAngle_deg(ik.body().skeleton, row.poses[t], TruePose(of, t));
  }
  row.errors[measure::kMsPerFrame] = ms;
  row.errors /= static_cast<double>(truth.size());
  row.errors[measure::kJitter_mm] = Jitter_mm(joints_in_cam_m, truth);
  row.bones_percent = BoneErrors_percent(joints_in_cam_m, truth);
  row.errors[measure::kBones_percent] = std::sqrt(row.bones_percent.squaredNorm() / kNumBoneGroups);
  row.errors[measure::kLag_frames] = Lag_frames(joints_in_cam_m, truth);
  row.errors.segment<3>(measure::kTrunkSigmas) = Calibration(ErrorsInSigmas(estimate, of, false));
  row.errors.segment<3>(measure::kLimbSigmas) = Calibration(ErrorsInSigmas(estimate, of, true));
  return row;
}

// The rows of one method and its filters.
std::vector<SequenceEvaluation> Run(const NamedSequenceMethod& method, const Case& of,
                                    const InverseKinematics& ik) {
  const double frame_time_s = of.trial->own.frame_time_s;
  const double start_ms = ThreadTime_ms();
  const SequenceEstimate lifted = method.lift(of.observations, frame_time_s);
  const double lift_ms = ThreadTime_ms() - start_ms;
  std::vector<SequenceEvaluation> rows = {Measure(method.name, lifted, lift_ms, of, ik)};
  for (const SequenceFilter& filter : method.filters) {
    const double filter_start_ms = ThreadTime_ms();
    const SequenceEstimate smoothed{filter.smooth(lifted.joints_in_cam_m, frame_time_s)};
    const double filter_ms = ThreadTime_ms() - filter_start_ms;
    rows.push_back(Measure(filter.name, smoothed, lift_ms + filter_ms, of, ik));
  }
  return rows;
}

void Require(const std::vector<SequenceTrial>& trials, const EvaluateSequenceOptions& options) {
  if (!FindLayout(options.layout)) throw std::invalid_argument("no layout " + options.layout);
  for (const SequenceTrial& trial : trials)
    if (trial.own.frames.size() < kFewestLagFrames ||
        trial.own.frames.size() != trial.standard.frames.size())
      throw std::invalid_argument("EvaluateSequences: the frames of " + trial.name);
}

}  // namespace

const std::array<std::string, measure::kNumMeasures>& MeasureNames() {
  static const std::array<std::string, measure::kNumMeasures> kNames = {"cam_mm",
                                                                        "pa_mm",
                                                                        "root_mm",
                                                                        "angle_deg",
                                                                        "jitter_mm",
                                                                        "lag_frames",
                                                                        "bones_percent",
                                                                        "ms_per_frame",
                                                                        "trunk_within_1_sigma",
                                                                        "trunk_within_2_sigma",
                                                                        "trunk_error_in_sigmas",
                                                                        "limb_within_1_sigma",
                                                                        "limb_within_2_sigma",
                                                                        "limb_error_in_sigmas"};
  return kNames;
}

std::vector<SequenceEvaluation> EvaluateSequences(const std::vector<NamedSequenceMethod>& methods,
                                                  const std::vector<SequenceTrial>& trials,
                                                  const EvaluateSequenceOptions& options,
                                                  const ProgressFn& progress) {
  Require(trials, options);
  if (trials.empty()) return {};
  const InverseKinematics ik(trials.front().standard.skeleton);
  // A part is one case and one method; the parts of a case come one after another.
  const size_t per_case = methods.size() + 1;
  const size_t count = options.noises_px.size() * trials.size() * per_case;
  std::vector<std::vector<SequenceEvaluation>> parts(count);
  std::exception_ptr error;
  std::atomic<size_t> done = 0;
#pragma omp parallel for schedule(dynamic)
  for (size_t i = 0; i < count; ++i) try {
      const size_t m = i % per_case;
      const Case of = MakeCase(trials[i / per_case % trials.size()],
                               options.noises_px[i / per_case / trials.size()], options);
      parts[i] = m == 0 ? std::vector{Measure(kTrueJoints, {of.view.joints_in_cam_m}, 0.0, of, ik)}
                        : Run(methods[m - 1], of, ik);
      const size_t now = ++done;
      if (progress) progress(static_cast<double>(now) / static_cast<double>(count));
    } catch (...) {
#pragma omp critical
      error = std::current_exception();
    }
  if (error) std::rethrow_exception(error);
  std::vector<SequenceEvaluation> rows;
  for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(rows));
  return rows;
}

}  // namespace poselift
