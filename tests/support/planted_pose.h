// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "lift/dictionary.h"
#include "lift/sparse_code.h"
#include "lift/weak_camera.h"
#include "src/observation.h"

namespace poselift::testing {

// Independent Gaussians.
Eigen::MatrixXd RandomMatrix(Eigen::Index rows, Eigen::Index cols, std::mt19937_64* rng);
// With columns of unit norm.
Eigen::MatrixXd RandomAtoms(Eigen::Index rows, Eigen::Index cols, std::mt19937_64* rng);
// Different atoms, coefficients of 0.5 to 1.5 with either sign.
SparseCode RandomCode(Eigen::Index num_atoms, int size, std::mt19937_64* rng);

// A pose of a dictionary before a camera: the truth that a lift must find.
struct PlantedPose {
  SparseCode code;
  Eigen::VectorXd pose_in_body_m;
  Eigen::Vector3d tau_rad;
  WeakCamera camera;

  Pose3 JointsInCam_m() const;
};
// Any yaw, pitch and roll up to 0.5 rad. The coefficients are positive: -x with
// the roll turned by pi is the same picture.
PlantedPose PlantPose(const Dictionary& dictionary, int num_atoms, std::mt19937_64* rng);

// All 23 joints without noise, in the picture or in space.
Observation ObserveInPicture(const PlantedPose& planted, double sigma_px);
Observation ObserveInSpace(const PlantedPose& planted, double sigma_m);
// The observation without a share of its points.
Observation Masked(Observation observation, double hidden_share, std::mt19937_64* rng);

// Three points in the picture, four in space, some of them sums of joints, with
// sigmas that differ; no pose behind them.
Observation RandomMixture(std::mt19937_64* rng);

// Of hints of all kinds that contradict each other: some bounds hold in a pose, some do
// not.
std::vector<JointRelation> SomeRelations();

}  // namespace poselift::testing
