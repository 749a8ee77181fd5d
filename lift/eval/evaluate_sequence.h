// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lift/body_proportions.h"
#include "lift/eval/synthetic_view.h"
#include "src/motion.h"
#include "src/observation.h"
#include "src/pose3.h"
#include "src/progress.h"

namespace poselift {

// How far lifted sequences are from the truth: captured motions are seen by one
// fixed camera each, their noisy labels, of which some are missing, go to every
// method, and what it makes of them is compared with the motion. All methods get
// the same labels, and none is told how large the noise is.

// What is done to the poses of a method afterwards: a row of its own. The poses are
// lifted once for all filters of a method.
struct SequenceFilter {
  std::string name;  // of the row
  std::function<std::vector<Pose3>(const std::vector<Pose3>&, double frame_time_s)> smooth;
};

// What a method makes of a sequence.
struct SequenceEstimate {
  // For every frame: 23 joints in cam, pelvis at the origin, metres.
  std::vector<Pose3> joints_in_cam_m;
  // Of a method that says how sure it is: JointAngles() x frames, read in the world of a
  // level camera, and their standard deviations, NaN where there are none. Else empty.
  Eigen::MatrixXd angles_deg = {}, angles_sigma_deg = {};
};

struct NamedSequenceMethod {
  std::string name;
  // Called by several threads at once.
  std::function<SequenceEstimate(const std::vector<Observation>&, double frame_time_s)> lift;
  std::vector<SequenceFilter> filters = {};
};

// A motion on its subject's own skeleton, and the same frames on the standard one
// (OnStandardSkeleton), which says the true angles.
struct SequenceTrial {
  std::string name;
  Motion own;
  Motion standard;
};

// Means over the frames of a trial.
namespace measure {
inline constexpr int kCam_mm = 0,  // CamError_mm
    kPa_mm = 1,                    // PaError_mm
    kRoot_mm = 2,                  // RootError_mm: subjects and standard skeleton differ in size
    // MeanAngle_deg of the standard skeleton. Its pose is inverse kinematics of the
    // joints, for every method alike, also for those that have angles of their own.
    kAngle_deg = 3,
                     kJitter_mm = 4,  // Jitter_mm
    kLag_frames = 5,                  // Lag_frames
    // Root mean square of `bones` over the groups: proportions against the subject's.
    kBones_percent = 6,
                     kMsPerFrame = 7,  // of processor time, the lift before a filter included
    // Of methods that say how sure they are, else NaN, three each: the shares of the true
    // angles that are within one and within two standard deviations of those found, and
    // what two thirds (68.27 %) of the errors are within, in standard deviations.
    kTrunkSigmas = 8, kLimbSigmas = 11, kNumMeasures = 14;
}  // namespace measure
using SequenceErrors = Eigen::Array<double, measure::kNumMeasures, 1>;
const std::array<std::string, measure::kNumMeasures>& MeasureNames();  // "cam_mm", ...

struct SequenceEvaluation {
  std::string method, trial;
  double noise_px = 0.0;
  SequenceErrors errors = SequenceErrors::Zero();
  // Of each group's mean length over the frames, at equal stature: percent too long.
  GroupVector bones_percent = GroupVector::Zero();
  std::vector<SkeletonPose> poses;  // on the standard skeleton, world is cam
};

struct EvaluateSequenceOptions {
  std::string layout = "body15";
  SequenceViewOptions view{.missing_share = 0.1};  // but for the noise
  std::vector<double> noises_px = {2.0, 5.0};
  std::uint64_t seed = 1;  // with the trial's name: of camera, noise and what is missing
};

// The method whose answer is the truth: the errors of the measures themselves, above
// all of angles that joints do not show.
inline const std::string kTrueJoints = "true joints";

// A row for each noise, trial and method or filter, those of kTrueJoints among them.
// Throws std::invalid_argument for an unknown layout, trials of fewer frames than
// kFewestLagFrames or whose two motions differ, and for methods that return another
// number of poses; and what the methods throw.
std::vector<SequenceEvaluation> EvaluateSequences(const std::vector<NamedSequenceMethod>& methods,
                                                  const std::vector<SequenceTrial>& trials,
                                                  const EvaluateSequenceOptions& options,
                                                  const ProgressFn& progress);

}  // namespace poselift
