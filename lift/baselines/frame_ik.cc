// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/frame_ik.h"

#include <ceres/cost_function.h>

#include <stdexcept>

#include "lift/ik/pose_problem.h"

namespace poselift {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kFunctionTolerance = 1e-5;

}  // namespace

FrameIk::FrameIk(const Skeleton& skeleton, double frame_time_s, const FeatureVector& sigmas)
    : body_(skeleton), frame_time_s_(frame_time_s) {
  last_.whitening = sigmas.cwiseInverse().asDiagonal();
}

void FrameIk::Begin(const std::vector<SkeletonPose>& first) {
  if (first.empty()) throw std::invalid_argument("FrameIk: no first pose");
  last_.pose = first.back();
}

SkeletonPose FrameIk::Next(const std::vector<TargetPoint>& observed) {
  const DofLimits none(body_, /*enforce=*/false);
  PoseProblem problem(body_, last_.pose,
                      {.limits = none, .rest = Eigen::VectorXd::Zero(body_.num_dofs)});
  problem.AddPoseTerm(MakePredictionCost(last_, frame_time_s_));
  if (!observed.empty()) problem.AddPoseTerm(MakeSpaceCost(body_, observed, false));
  if (IsUsable(problem.Solve(kMaxIterations, kFunctionTolerance).status))
    last_.pose = problem.pose();
  return last_.pose;
}

}  // namespace poselift
