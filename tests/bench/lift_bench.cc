// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <benchmark/benchmark.h>

#include <filesystem>
#include <numeric>
#include <random>

#include "lift/dictionary_file.h"
#include "lift/lift_photo.h"
#include "lift/lifter.h"
#include "src/forward_kinematics.h"
#include "tests/support/random_dictionary.h"

namespace poselift {
namespace {

// Poses (69 x count) of a made-up body, every angle anywhere in the middle half
// of its range.
Eigen::MatrixXd RandomPoses(const Skeleton& skeleton, int count, std::mt19937_64* rng) {
  std::uniform_real_distribution<double> share(0.25, 0.75);
  Eigen::MatrixXd poses(3 * kNumJoints, count);
  SkeletonPose pose = SkeletonPose::Rest(skeleton);
  for (int i = 0; i < count; ++i) {
    int dof = 0;
    for (const Bone& bone : skeleton.bones)
      for (const Dof& range : bone.dofs)
        pose.dofs[dof++] = range.lower + share(*rng) * (range.upper - range.lower);
    poses.col(i) = Stacked(JointPositions(skeleton, pose));
  }
  return poses;
}

// Atoms that look like poses, as those of a trained dictionary do, with a prior.
Dictionary PoseDictionary(int num_atoms, std::mt19937_64* rng) {
  Dictionary dictionary = testing::RandomDictionary(1, rng);
  const Eigen::MatrixXd poses = RandomPoses(dictionary.skeleton, num_atoms, rng);
  dictionary.atoms = poses.colwise().normalized();
  dictionary.typical_norm_m = poses.colwise().norm().mean();
  dictionary.prior = LearnPosePrior(poses);
  return dictionary;
}

// A picture of a pose with half a pixel to a pixel of noise: body15.
Observation Picture(const Skeleton& skeleton, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  const Pose3 pose = Unstacked(RandomPoses(skeleton, 1, rng).col(0));
  WeakCamera camera{CamFromBody({0.1, 0.8, -0.05}), 200.0, {320.0, 240.0}};
  const Eigen::Matrix2Xd joints_px = camera.Project(camera.cam_from_body * pose);
  PersonLabels labels;
  const Layout& layout = *FindLayout("body15");
  for (const Landmark& landmark : layout.landmarks) {
    const Eigen::Vector2d noise_px(normal(*rng), normal(*rng));
    labels.landmarks.push_back(
        {std::string(landmark.name), joints_px.col(landmark.parts[0].joint) + noise_px});
  }
  return Observe(labels, layout);
}

void LiftPhotoBench(benchmark::State& state) {
  std::mt19937_64 rng(1);
  const Dictionary dictionary = PoseDictionary(static_cast<int>(state.range(0)), &rng);
  const Observation observation = Picture(dictionary.skeleton, &rng);
  const Lifter lifter(dictionary, {});
  for (auto _ : state) {
    auto solutions = lifter.Solve(observation);
    benchmark::DoNotOptimize(solutions.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(LiftPhotoBench)
    ->Name("lift_photo")
    ->ArgName("random")
    ->Arg(1024)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// The whole lift of one person, joint angles and alternatives included, with the
// dictionary that ships.
void LiftPhotoDefaultBench(benchmark::State& state) {
  const Dictionary dictionary =
      ReadDictionary(std::filesystem::path(POSELIFT_SOURCE_DIR) / "data/default.pldict");
  std::mt19937_64 rng(1);
  const Observation observation = Picture(dictionary.skeleton, &rng);
  const PhotoLifter lifter(dictionary);
  for (auto _ : state) {
    auto result = lifter.LiftPhoto(observation);
    benchmark::DoNotOptimize(result.poses.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(LiftPhotoDefaultBench)
    ->Name("lift_photo/default")
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// OMP over the rows that are left of 69 with 30 % of the joints hidden, the same
// joints in every pose.
void OmpMaskedBench(benchmark::State& state) {
  constexpr int kPoses = 64;
  const auto num_atoms = static_cast<int>(state.range(0));
  std::mt19937_64 rng(1);
  const Dictionary dictionary = PoseDictionary(num_atoms, &rng);
  const Eigen::MatrixXd poses = RandomPoses(dictionary.skeleton, kPoses, &rng);
  std::vector<int> rows(3 * kNumJoints);
  std::iota(rows.begin(), rows.end(), 0);
  for (int hidden = 0; hidden < kNumJoints * 3 / 10; ++hidden) {
    const auto joint = std::uniform_int_distribution<int>(0, kNumJoints - 1 - hidden)(rng);
    rows.erase(rows.begin() + 3 * joint, rows.begin() + 3 * joint + 3);
  }
  const Eigen::MatrixXd atoms = dictionary.atoms(rows, Eigen::all);
  const Eigen::MatrixXd targets = poses(rows, Eigen::all);
  const Eigen::VectorXd squared_norms = atoms.colwise().squaredNorm();

  const OmpOptions options{.max_atoms = static_cast<int>(state.range(1))};
  OmpSolver solver;
  SparseCode code;
  for (auto _ : state)
    for (int i = 0; i < kPoses; ++i) {
      solver.Solve(atoms, squared_norms, targets.col(i), options, &code);
      benchmark::DoNotOptimize(code.coefficients.data());
    }
  state.SetItemsProcessed(state.iterations() * kPoses);
}
BENCHMARK(OmpMaskedBench)->Name("omp_masked")->ArgNames({"K", "atoms"})->Args({256, 8});

}  // namespace
}  // namespace poselift
