// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/sequence_methods.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include "lift/baselines/butterworth.h"
#include "lift/baselines/one_euro.h"
#include "lift/baselines/savitzky_golay.h"
#include "lift/lift_photo.h"
#include "lift/lift_sequence.h"
#include "lift/online_smoothing.h"
#include "lift/person_ik.h"
#include "lift/point_curves.h"
#include "lift/rotation.h"
#include "src/forward_kinematics.h"
#include "src/joint_angles.h"
#include "src/level_camera.h"

namespace poselift::cli {
namespace {

using Sequence = std::vector<Observation>;

// Every frame on its own, its best pose; the pose before where it cannot be lifted
// (the rest pose before any).
std::vector<Pose3> LiftFrames(const PhotoLifter& lifter, const Sequence& sequence) {
  const Skeleton& skeleton = lifter.dictionary().skeleton;
  Pose3 last =
      CamFromBody(Eigen::Vector3d::Zero()) * JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  std::vector<Pose3> poses;
  for (const Observation& observation : sequence) {
    const LiftResult result = lifter.LiftPhoto(observation);
    if (result.IsUsable()) last = result.poses.front().joints_in_cam_m;
    poses.push_back(last);
  }
  return poses;
}

// The first pose of each frame of LiftSequence; as above where there is none.
SequenceEstimate LiftTogether(const SequenceLifter& lifter, const JointAngleReader& angles,
                              const Sequence& sequence, double frame_time_s) {
  const LiftedSequence lifted = lifter.LiftSequence(sequence, frame_time_s);
  SequenceEstimate estimate;
  auto& joints_in_cam_m = estimate.joints_in_cam_m;
  estimate.angles_deg =
      Eigen::MatrixXd::Constant(std::ssize(JointAngles()), std::ssize(lifted.frames), std::nan(""));
  estimate.angles_sigma_deg = estimate.angles_deg;
  for (size_t t = 0; t < lifted.frames.size(); ++t) {
    const LiftResult& frame = lifted.frames[t];
    if (!frame.IsUsable()) {
      joints_in_cam_m.push_back(joints_in_cam_m.empty() ? Pose3::Zero(3, kNumJoints)
                                                        : joints_in_cam_m.back());
      continue;
    }
    const LiftedPose& lifted_pose = frame.poses.front();
    joints_in_cam_m.push_back(lifted_pose.joints_in_cam_m);
    if (lifted_pose.angles_sigma_deg.size() == 0) continue;
    const auto column = static_cast<Eigen::Index>(t);
    estimate.angles_deg.col(column) = angles.ReadDeg(LevelFromCam(lifted_pose.pose));
    estimate.angles_sigma_deg.col(column) = lifted_pose.angles_sigma_deg;
  }
  return estimate;
}

// A filter of the joints' curves, each coordinate on its own.
using CurveFilter = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&, double frame_rate_hz)>;

SequenceFilter OfJoints(std::string name, const CurveFilter& filter) {
  return {std::move(name), [filter](const std::vector<Pose3>& poses, double frame_time_s) {
            Eigen::MatrixXd curves_m(3 * kNumJoints, static_cast<Eigen::Index>(poses.size()));
            for (size_t t = 0; t < poses.size(); ++t)
              curves_m.col(static_cast<Eigen::Index>(t)) = Stacked(poses[t]);
            curves_m = filter(curves_m, 1.0 / frame_time_s);
            std::vector<Pose3> smoothed;
            for (Eigen::Index t = 0; t < curves_m.cols(); ++t)
              smoothed.push_back(Unstacked(curves_m.col(t)));
            return smoothed;
          }};
}

SequenceFilter Butterworth(std::string name, double cutoff_hz) {
  return OfJoints(std::move(name), [cutoff_hz](const Eigen::MatrixXd& curves, double rate_hz) {
    return ButterworthLowPass(curves, rate_hz, {.cutoff_hz = cutoff_hz});
  });
}

SequenceFilter SavitzkyGolayOf(int window_frames) {
  return OfJoints(fmt::format("Savitzky-Golay {} frames", window_frames),
                  [window_frames](const Eigen::MatrixXd& curves, double) {
                    return SavitzkyGolay(curves, {.window_frames = window_frames});
                  });
}

SequenceFilter OneEuro(double min_cutoff_hz, double beta) {
  return OfJoints(fmt::format("One Euro {:g} Hz, beta {:g}", min_cutoff_hz, beta),
                  [=](const Eigen::MatrixXd& curves, double rate_hz) {
                    return SmoothOneEuro(curves, rate_hz,
                                         {.min_cutoff_hz = min_cutoff_hz, .beta = beta});
                  });
}

// As a stream of poses would be smoothed.
SequenceFilter Online(const Skeleton& skeleton,
                      const std::shared_ptr<const MotionCodebook>& codebook, double latency_s) {
  return {fmt::format("online, {:g} s late", latency_s),
          [=](const std::vector<Pose3>& poses, double frame_time_s) {
            PersonIk ik(skeleton);
            Motion motion{skeleton, frame_time_s, {}};
            for (const Pose3& pose : poses) {
              PersonPose person;
              person.joints_in_cam_m = pose;
              motion.frames.push_back(ik.Solve(person, {}));
            }
            const MotionSmoother as_it_is = [](const Motion& plain, int) { return plain; };
            const Motion smooth =
                SmootherOnline(codebook, as_it_is, {.latency_s = latency_s})(motion, 0);
            std::vector<Pose3> smoothed;
            for (const SkeletonPose& pose : smooth.frames)
              smoothed.push_back(kLevelFromCam.toRotationMatrix() * JointPositions(skeleton, pose));
            return smoothed;
          }};
}

}  // namespace

std::vector<NamedSequenceMethod> SequenceMethods(const Dictionary& dictionary,
                                                 const MotionCodebook& codebook,
                                                 const LiftSequenceOptions& options) {
  const auto shared = std::make_shared<const MotionCodebook>(codebook);
  const auto lifter = std::make_shared<PhotoLifter>(dictionary);
  const auto together = std::make_shared<SequenceLifter>(*lifter, codebook, options);
  LiftSequenceOptions standard = options;
  standard.find_proportions = false;
  const auto on_standard = std::make_shared<SequenceLifter>(*lifter, codebook, standard);
  const JointAngleReader angles(dictionary.skeleton);
  return {{"each frame alone",
           [lifter](const Sequence& sequence, double) {
             return SequenceEstimate{LiftFrames(*lifter, sequence)};
           },
           {Butterworth("Butterworth 1.5 Hz", 1.5), Butterworth("Butterworth 3 Hz", 3.0),
            Butterworth("Butterworth 6 Hz", 6.0), SavitzkyGolayOf(9), SavitzkyGolayOf(21),
            OneEuro(1.0, 3.0), OneEuro(0.5, 1.0), Online(dictionary.skeleton, shared, 0.0),
            Online(dictionary.skeleton, shared, 0.1)}},
          {"labels at 4 Hz",
           [lifter](const Sequence& sequence, double frame_time_s) {
             return SequenceEstimate{LiftFrames(
                 *lifter, SmoothPoints(sequence, frame_time_s, 4.0, /*max_gap_frames=*/1000))};
           },
           {Butterworth("labels at 4 Hz, poses at 3 Hz", 3.0)}},
          {"poselift, standard bones",
           [lifter, on_standard, angles](const Sequence& sequence, double frame_time_s) {
             return LiftTogether(*on_standard, angles, sequence, frame_time_s);
           },
           {}},
          {"poselift",
           [lifter, together, angles](const Sequence& sequence, double frame_time_s) {
             return LiftTogether(*together, angles, sequence, frame_time_s);
           },
           {}}};
}

}  // namespace poselift::cli
