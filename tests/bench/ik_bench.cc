// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <benchmark/benchmark.h>

#include "lift/ik/inverse_kinematics.h"
#include "lift/ik/pose_refinement.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/random_pose.h"

namespace poselift {
namespace {

// 100 poses within the inner part of the limits; the targets are exact.
std::vector<Pose3> Targets(const Articulation& body) {
  std::mt19937_64 rng(1);
  std::vector<Pose3> targets;
  for (int i = 0; i < 100; ++i)
    targets.push_back(
        JointPositions(body, testing::RandomPoseWithinLimits(body.skeleton, 0.3, &rng)));
  return targets;
}

// A whole pose from its 23 joints, without a start, limits kept.
void IkPose(benchmark::State& state) {
  const InverseKinematics ik(testing::TrimmedCmuLikeSkeleton());
  const std::vector<Pose3> targets = Targets(ik.body());
  size_t i = 0;
  for (auto _ : state) {
    const IkResult result = ik.Solve(targets[i++ % targets.size()]);
    benchmark::DoNotOptimize(result.rms_m);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(IkPose)->Name("ik_pose")->Unit(benchmark::kMicrosecond);

// Prior and all joints seen in the picture.
void RefinePose(benchmark::State& state) {
  const PoseRefinement refinement(testing::TrimmedCmuLikeSkeleton());
  std::vector<Pose3> targets = Targets(Articulation(testing::TrimmedCmuLikeSkeleton()));
  std::vector<Observation> seen;
  for (Pose3& target : targets) {
    target.colwise() -= Eigen::Vector3d(target.col(joint::kPelvis));
    Observation observation = ObservePose(200.0 * target, 2.0);
    for (ObservedPoint& point : observation.points) {
      point.kind = ObservedPoint::Kind::k2D;
      point.x.z() = 0.0;
    }
    seen.push_back(observation);
  }
  size_t i = 0;
  for (auto _ : state) {
    const RefinementResult result =
        refinement.Solve(targets[i % targets.size()], seen[i % targets.size()]);
    benchmark::DoNotOptimize(result.code_rms_m);
    ++i;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(RefinePose)->Name("refine_pose")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace poselift
