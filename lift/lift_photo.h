// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lift/dictionary.h"
#include "lift/ik/pose_refinement.h"
#include "lift/lifter.h"
#include "lift/sparse_code.h"
#include "lift/weak_camera.h"
#include "src/observation.h"
#include "src/pose3.h"
#include "src/skeleton.h"

namespace poselift {

struct LiftPhotoOptions {
  LifterOptions lifter;
  RefinementOptions refinement;
  int max_solutions = 4;  // distinct poses that are carried to the end
  // How often the points are set right for the depths found last, where the
  // camera is known.
  int perspective_rounds = 3;

  std::string Validate() const;
};

// A pose that explains the points.
struct LiftedPose {
  SkeletonPose pose;      // joint angles; its world is cam, the root at the origin
  Pose3 joints_in_cam_m;  // 3 x 23, pelvis at the origin, bone lengths of the skeleton
  WeakCamera camera;      // scale 0 without 2D points
  // Where a known camera (Observation::pinhole) has the pelvis, at the size of
  // the skeleton; NaN without one.
  Eigen::Vector3d pelvis_in_cam_m = Eigen::Vector3d::Constant(std::nan(""));
  // How sure each of JointAngles() is: one standard deviation, degrees. Empty for a
  // frame by itself.
  Eigen::VectorXd angles_sigma_deg;
  SparseCode code;  // x: metres
  // Where (P1) ended: the camera of the code's pose, whose bones are not quite the skeleton's.
  Eigen::Vector3d code_tau_rad = Eigen::Vector3d::Zero();
  double code_scale_px_per_m = 1.0;
  // How much larger the person is than the skeleton, where a hint says how tall they are.
  double size = 1.0;
  std::vector<int> unmet_hints;  // of PersonLabels::hints
  // What is left to explain, in squared standard deviations: the points', the
  // pose's and the rotation's, and the hints'.
  double cost = -1.0;
  Eigen::VectorXd point_errors;       // of each observed point, px or m
  double reprojection_rms_px = -1.0;  // over the 2D points; -1 without any
};

// The shift of the body that suits the 3D points best; 0 without any.
Eigen::Vector3d MeanShift_m(const Observation& observation, const Pose3& joints_in_cam_m);

// Sets point_errors and reprojection_rms_px.
void MeasureErrors(const Observation& observation, LiftedPose* lifted);

enum class LiftStatus { kNotRun, kOk, kCannotLift, kFailed };

struct LiftResult {
  LiftStatus status = LiftStatus::kNotRun;
  std::string message = "the lift was not run";
  std::vector<LiftedPose> poses;  // the best first, its alternatives behind it

  bool IsUsable() const { return status == LiftStatus::kOk; }
  std::string BriefReport() const;
};

// How much larger the person is than the skeleton; 1 where nothing is said of it.
double SizeOf(const Observation& observation, const Skeleton& skeleton);

// From the observed points of one person to poses with joint angles; in true
// perspective where the camera is known, else in weak perspective.
class PhotoLifter {
 public:
  // The dictionary must outlive the lifter. Throws std::invalid_argument when
  // the options are invalid.
  explicit PhotoLifter(const Dictionary& dictionary, const LiftPhotoOptions& options = {});

  // Several threads may call at once.
  // Hints that contradict each other, or the picture, give a pose all the same, which
  // says which it does not meet.
  LiftResult LiftPhoto(const Observation& observation) const;

  // The pose that `start`, of about the same points, becomes, for answers while a point is dragged:
  // a step of (P1) and the refinement from there alone. No other views are looked at, so that it
  // may be another minimum than the best. LiftPhoto where that gives nothing: a start that was not
  // lifted, or of a picture where there is none.
  LiftResult LiftPhotoFrom(const Observation& observation, const LiftedPose& start) const;

  const Dictionary& dictionary() const { return dictionary_; }

 private:
  LiftResult LiftAtSkeletonSize(const Observation& observation) const;
  // Nothing when no pose of the skeleton fits.
  std::optional<LiftedPose> Finish(const LiftSolution& solution, const Observation& observation,
                                   const std::optional<SkeletonPose>& start = std::nullopt) const;
  std::optional<LiftedPose> FinishInPerspective(const LiftSolution& solution,
                                                const Observation& observation) const;
  std::optional<LiftedPose> Follow(const LiftedPose& start, const Observation& observation) const;
  // Sets errors, cost and the hints that are not met.
  void Judge(const Observation& observation, LiftedPose* lifted) const;
  double Cost(const LiftedPose& lifted, const Observation& observation) const;

  const Dictionary& dictionary_;
  LiftPhotoOptions options_;
  Lifter lifter_;
  PoseRefinement refinement_;
  Eigen::VectorXd bone_lengths_m_;
};

}  // namespace poselift
