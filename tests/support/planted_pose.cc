// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/planted_pose.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lift/rotation.h"

namespace poselift::testing {
namespace {

double Uniform(double low, double high, std::mt19937_64* rng) {
  return std::uniform_real_distribution<double>(low, high)(*rng);
}

Observation Observe(const Eigen::Matrix3Xd& x, ObservedPoint::Kind kind, double sigma) {
  Observation observation;
  for (int j = 0; j < kNumJoints; ++j)
    observation.points.push_back(
        {std::string(Joints()[j].name), {{j, 1.0}}, kind, x.col(j), sigma});
  return observation;
}

}  // namespace

Eigen::MatrixXd RandomMatrix(Eigen::Index rows, Eigen::Index cols, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(*rng); });
}

Eigen::MatrixXd RandomAtoms(Eigen::Index rows, Eigen::Index cols, std::mt19937_64* rng) {
  return RandomMatrix(rows, cols, rng).colwise().normalized();
}

SparseCode RandomCode(Eigen::Index num_atoms, int size, std::mt19937_64* rng) {
  SparseCode code;
  code.atoms.resize(static_cast<size_t>(num_atoms));
  std::iota(code.atoms.begin(), code.atoms.end(), 0);
  std::shuffle(code.atoms.begin(), code.atoms.end(), *rng);
  code.atoms.resize(static_cast<size_t>(size));
  code.coefficients.resize(size);
  for (double& x : code.coefficients)
    x = std::copysign(Uniform(0.5, 1.5, rng), Uniform(-1, 1, rng));
  return code;
}

Pose3 PlantedPose::JointsInCam_m() const {
  return camera.cam_from_body * Unstacked(pose_in_body_m);
}

PlantedPose PlantPose(const Dictionary& dictionary, int num_atoms, std::mt19937_64* rng) {
  PlantedPose planted;
  planted.code = RandomCode(dictionary.NumAtoms(), num_atoms, rng);
  planted.code.coefficients =
      planted.code.coefficients.cwiseAbs() * (dictionary.typical_norm_m / std::sqrt(num_atoms));
  planted.pose_in_body_m = Synthesize(dictionary.atoms, planted.code);
  planted.tau_rad << Uniform(-0.5, 0.5, rng), Uniform(-M_PI, M_PI, rng), Uniform(-0.5, 0.5, rng);
  planted.camera = {CamFromBody(planted.tau_rad), Uniform(100, 300, rng), {320.0, 240.0}};
  return planted;
}

Observation ObserveInPicture(const PlantedPose& planted, double sigma_px) {
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, kNumJoints);
  x.topRows<2>() = planted.camera.Project(planted.JointsInCam_m());
  return Observe(x, ObservedPoint::Kind::k2D, sigma_px);
}

Observation ObserveInSpace(const PlantedPose& planted, double sigma_m) {
  return Observe(planted.JointsInCam_m(), ObservedPoint::Kind::k3D, sigma_m);
}

Observation Masked(Observation observation, double hidden_share, std::mt19937_64* rng) {
  auto& points = observation.points;
  std::shuffle(points.begin(), points.end(), *rng);
  points.resize(points.size() - static_cast<size_t>(hidden_share * points.size()));
  return observation;
}

Observation RandomMixture(std::mt19937_64* rng) {
  Observation observation;
  for (int i = 0; i < 7; ++i) {
    ObservedPoint point;
    point.kind = i % 2 == 0 ? ObservedPoint::Kind::k3D : ObservedPoint::Kind::k2D;
    const int joint = static_cast<int>(Uniform(0, kNumJoints - 1, rng));
    const double share = i < 3 ? 1.0 : Uniform(0, 1, rng);
    point.parts = {{joint, share}, {joint + 1, 1.0 - share}};
    point.x = RandomMatrix(3, 1, rng);
    if (point.kind == ObservedPoint::Kind::k2D)
      point.x = 200.0 * Eigen::Vector3d(point.x.x(), point.x.y(), 0);
    point.sigma = Uniform(0.1, 3.0, rng);
    observation.points.push_back(point);
  }
  return observation;
}

std::vector<JointRelation> SomeRelations() {
  const Layout& layout = *FindLayout("body15");
  const std::vector<LabelHint> hints = {{LabelHint::Kind::kNearer, "left_wrist", "neck"},
                                        {LabelHint::Kind::kNearer, "neck", "left_wrist", 0.3},
                                        {LabelHint::Kind::kAwayFromCamera, "right_knee"},
                                        {LabelHint::Kind::kOnFloor, "left_ankle"},
                                        {LabelHint::Kind::kOnFloor, "right_hand"},
                                        {LabelHint::Kind::kPin, "left_elbow", "", {}, {1, 2, 3}}};
  return RelationsOf(hints, layout);
}

}  // namespace poselift::testing
