// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/motion_codebook.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kRateFrames = 2;
constexpr double kTimeTolerance = 1e-6;  // of a frame
// A mean of lever arms does not change by more of them.
constexpr Eigen::Index kLeverArmPoses = 500;

int FramesIn(double time_s, double frame_time_s) {
  const double frames = time_s / frame_time_s;
  const double whole = std::round(frames);
  if (!(whole >= 1.0) || std::abs(frames - whole) > kTimeTolerance)
    throw InputError(
        fmt::format("found motions of {:g} frames a second, wanted so many that {:g} "
                    "s are a whole number of frames",
                    1.0 / frame_time_s, time_s));
  return static_cast<int>(whole);
}

// The features of a trial with the root's path in place of its velocity: rows
// 43..45 are x, z and yaw in the world in which the body begins at the origin.
FeatureMatrix WithPath(FeatureMatrix features, double frame_time_s) {
  SkeletonPose pose;
  double yaw_rad = 0.0;
  for (Eigen::Index t = 0; t < features.cols(); ++t) {
    auto column = features.col(t);
    pose = PoseFromFeatures(column, pose, frame_time_s);
    yaw_rad += frame_time_s * column[feature::kYawRate];
    column.tail<3>() << pose.root_in_world_m.x(), pose.root_in_world_m.z(), yaw_rad;
  }
  return features;
}

// x and z of R_yaw^T v.
Eigen::Vector2d InHeading(const Eigen::Vector2d& v, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

FeatureVector Change(const FeatureVector& from, const FeatureVector& to, double heading_rad) {
  FeatureVector change = to - from;
  change.segment<2>(segment_row::kPlace) =
      InHeading(change.segment<2>(segment_row::kPlace), heading_rad);
  return change;
}

// Per second, in the heading of frame t.
FeatureVector RateAt(const FeatureMatrix& path, int t, double frame_time_s) {
  return Change(path.col(t - kRateFrames), path.col(t + kRateFrames), path(segment_row::kYaw, t)) /
         (2.0 * kRateFrames * frame_time_s);
}

// The sample as seen from the middle one.
FeatureVector SeenFrom(const FeatureVector& middle, const FeatureVector& sample) {
  FeatureVector seen = sample;
  seen.tail<3>() = Change(middle, sample, middle[segment_row::kYaw]).tail<3>();
  return seen;
}

// Sign flips and swaps, so that a mirror image of a mirror image has the same bits.
Eigen::MatrixXf Mirrored(const Eigen::Ref<const Eigen::MatrixXf>& features,
                         const Skeleton& skeleton) {
  return MirroredFeatures(features.cast<double>(), skeleton).cast<float>();
}

// The pose and the rates of an input, each mirrored as what they are.
Eigen::MatrixXf MirroredInputs(const Eigen::Ref<const Eigen::MatrixXf>& inputs,
                               const Skeleton& skeleton) {
  Eigen::MatrixXf poses = Eigen::MatrixXf::Zero(kNumFeatures, inputs.cols());
  poses.topRows<kPoseRows>() = inputs.topRows<kPoseRows>();
  Eigen::MatrixXf mirrored(kAccelerationInputs, inputs.cols());
  mirrored << Mirrored(poses, skeleton).topRows<kPoseRows>(),
      Mirrored(inputs.bottomRows<kNumFeatures>(), skeleton);
  return mirrored;
}

AccelerationModels Mirrored(const AccelerationModels& models, const Skeleton& skeleton) {
  AccelerationModels mirrored = models;
  mirrored.means = Mirrored(Eigen::MatrixXf(models.means), skeleton);
  mirrored.deviations = Mirrored(Eigen::MatrixXf(models.deviations), skeleton).cwiseAbs();
  for (int r = 0; r < kAccelerationRank; ++r) {
    mirrored.directions.middleRows<kAccelerationInputs>(r * kAccelerationInputs) = MirroredInputs(
        models.directions.middleRows<kAccelerationInputs>(r * kAccelerationInputs), skeleton);
    mirrored.responses.middleRows<kNumFeatures>(r * kNumFeatures) =
        Mirrored(models.responses.middleRows<kNumFeatures>(r * kNumFeatures), skeleton);
  }
  return mirrored;
}

template <typename Matrix>
void AppendColumns(const Eigen::MatrixXf& columns, Matrix* matrix) {
  matrix->conservativeResize(Eigen::NoChange, matrix->cols() + columns.cols());
  matrix->rightCols(columns.cols()) = columns;
}

}  // namespace

AccelerationModels AccelerationModels::Zero(Eigen::Index num_segments) {
  AccelerationModels models;
  models.means.setZero(Eigen::NoChange, num_segments);
  models.directions.setZero(Eigen::NoChange, num_segments);
  models.responses.setZero(Eigen::NoChange, num_segments);
  models.deviations.setZero(Eigen::NoChange, num_segments);
  return models;
}

MotionCodebook SegmentsOf(const MotionDatabase& database, int stride_frames) {
  MotionCodebook codebook;
  codebook.skeleton = database.skeleton;
  const double dt = database.frame_time_s;
  const int step = FramesIn(codebook.sample_time_s, dt);
  const int soon = FramesIn(kAccelerationTime_s, dt);
  const int before = std::max(kMiddleSample * step, kRateFrames);
  const int after = std::max((kSegmentSamples - 1 - kMiddleSample) * step, soon + kRateFrames);
  Eigen::Index count = 0;
  for (const Trial& trial : database.trials)
    if (const int middles = trial.num_frames - before - after; middles > 0)
      count += (middles + stride_frames - 1) / stride_frames;
  codebook.segments.resize(Eigen::NoChange, count);
  codebook.rates.resize(Eigen::NoChange, count);
  codebook.deviations.setZero(kNumFeatures, count);
  codebook.accelerations = AccelerationModels::Zero(count);

  Eigen::Index k = 0;
  for (const Trial& trial : database.trials) {
    const FeatureMatrix path = WithPath(
        database.features.middleCols(trial.first_frame, trial.num_frames).cast<double>(), dt);
    for (int t = before; t + after < trial.num_frames; t += stride_frames, ++k) {
      for (int s = 0; s < kSegmentSamples; ++s)
        codebook.segments.col(k).segment<kNumFeatures>(s * kNumFeatures) =
            SeenFrom(path.col(t), path.col(t + (s - kMiddleSample) * step)).cast<float>();
      const FeatureVector rate = RateAt(path, t, dt);
      codebook.rates.col(k) = rate.cast<float>();
      codebook.accelerations.means.col(k) =
          ((RateAt(path, t + soon, dt) - rate) / (soon * dt)).cast<float>();
    }
  }
  return codebook;
}

MotionCodebook WithMirrored(const MotionCodebook& codebook) {
  MotionCodebook both = codebook;
  const Eigen::Index count = codebook.segments.cols();
  Eigen::MatrixXf segments(kSegmentRows, count);
  for (int s = 0; s < kSegmentSamples; ++s)
    segments.middleRows<kNumFeatures>(s * kNumFeatures) =
        Mirrored(codebook.segments.middleRows<kNumFeatures>(s * kNumFeatures), codebook.skeleton);
  AppendColumns(segments, &both.segments);
  AppendColumns(Mirrored(codebook.rates, codebook.skeleton), &both.rates);
  AppendColumns(Mirrored(codebook.deviations, codebook.skeleton).cwiseAbs(), &both.deviations);
  const AccelerationModels models = Mirrored(codebook.accelerations, codebook.skeleton);
  AppendColumns(models.means, &both.accelerations.means);
  AppendColumns(models.directions, &both.accelerations.directions);
  AppendColumns(models.responses, &both.accelerations.responses);
  AppendColumns(models.deviations, &both.accelerations.deviations);
  return both;
}

Eigen::Matrix<float, kAccelerationInputs, Eigen::Dynamic> MotionCodebook::AccelerationInputs()
    const {
  Eigen::Matrix<float, kAccelerationInputs, Eigen::Dynamic> inputs(kAccelerationInputs,
                                                                   segments.cols());
  inputs << segments.middleRows<kPoseRows>(kMiddleSample * kNumFeatures), rates;
  return inputs;
}

FeatureVector LeverArms(const MotionCodebook& codebook) {
  const JointSites sites = FindJointSites(codebook.skeleton);
  const Eigen::Index stride = std::max<Eigen::Index>(1, codebook.segments.cols() / kLeverArmPoses);
  FeatureVector sum = FeatureVector::Zero();
  BoneFrames frames;
  Eigen::MatrixXd jacobian;
  double count = 0.0;
  for (Eigen::Index k = 0; k < codebook.segments.cols(); k += stride, ++count) {
    const SkeletonPose pose = PoseOfSample(codebook.segments.col(k)
                                               .segment<kNumFeatures>(kMiddleSample * kNumFeatures)
                                               .cast<double>());
    ForwardKinematics(codebook.skeleton, pose, &frames);
    JointJacobian(codebook.skeleton, sites, pose, frames, &jacobian);
    const Eigen::VectorXd moved_m =
        (jacobian.colwise().squaredNorm() / kNumJoints).cwiseSqrt().transpose();
    FeatureVector arms;  // the body heads for z: turns about x and z are its tilt
    arms << moved_m.tail<kNumAngles>(), moved_m[1], moved_m[3], moved_m[5], moved_m[0], moved_m[2],
        moved_m[4];
    sum += arms;
  }
  return sum / count;
}

SkeletonPose PoseOfSample(const FeatureVector& sample) {
  FeatureVector standing = sample;  // a yaw from nought within a second, and no velocity
  standing.segment<2>(segment_row::kPlace).setZero();
  SkeletonPose pose = PoseFromFeatures(standing, SkeletonPose{}, 1.0);
  pose.root_in_world_m.x() = sample[segment_row::kPlace];
  pose.root_in_world_m.z() = sample[segment_row::kPlace + 1];
  return pose;
}

}  // namespace poselift
