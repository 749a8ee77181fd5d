// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Sequences of a made-up walk with noise, with the models that ship; items are
// frames, or moments that are looked up.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>

#include "lift/dictionary_file.h"
#include "lift/lift_sequence.h"
#include "lift/model_smoother.h"
#include "lift/online_smoothing.h"
#include "lift/temporal/motion_codebook_file.h"
#include "lift/temporal/path_reconstruction.h"
#include "src/forward_kinematics.h"
#include "src/level_camera.h"
#include "tests/support/planted_walk.h"

namespace poselift {
namespace {

constexpr double kFrameTime_s = 1.0 / 30.0, kDepthWeight = 0.4;
constexpr int kNeighbours = 50;

const std::filesystem::path kData = std::filesystem::path(POSELIFT_SOURCE_DIR) / "data";

struct Models {
  Dictionary dictionary = ReadDictionary(kData / "default.pldict");
  std::shared_ptr<const MotionCodebook> codebook = std::make_shared<MotionCodebook>(
      WithMirrored(ReadMotionCodebook(kData / "default.plmotion")));
};

// 30 Hz, from the side, as a level camera has it.
Motion WalkInCam(const Models& models, int num_frames) {
  Motion walk = OnStandardSkeleton(testing::PlantWalk(2 * num_frames, 0.6, 0.0).motion,
                                   models.dictionary.skeleton, kFrameTime_s);
  const Eigen::Quaterniond side(Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitY()));
  for (SkeletonPose& pose : walk.frames) {
    pose.world_from_root = side * pose.world_from_root;
    pose.root_in_world_m = side * pose.root_in_world_m;
    pose = LevelFromCam(pose);
  }
  return walk;
}

// body15 with two pixels of noise.
std::vector<Observation> Pictures(const Motion& walk) {
  std::mt19937_64 rng(1);
  std::normal_distribution<double> noise(0.0, 2.0);
  std::vector<Observation> frames;
  for (const SkeletonPose& pose : walk.frames) {
    const Pose3 joints_px = 180.0 * JointPositions(walk.skeleton, pose);
    Observation& frame = frames.emplace_back();
    for (const Landmark& landmark : FindLayout("body15")->landmarks) {
      ObservedPoint& point = frame.points.emplace_back(std::string(landmark.name), landmark.parts);
      point.x =
          SumOfJoints(landmark.parts, joints_px) + Eigen::Vector3d(noise(rng), noise(rng), 0.0);
      point.x.z() = 0.0;
      point.sigma = 4.0;
    }
  }
  return frames;
}

std::vector<std::vector<Landmark::Part>> Body15() {
  std::vector<std::vector<Landmark::Part>> points;
  for (const Landmark& landmark : FindLayout("body15")->landmarks) points.push_back(landmark.parts);
  return points;
}

// The walk about each of its frames, at the codebook's samples.
std::vector<SegmentViews::Query> Moments(const Motion& walk, const MotionCodebook& codebook) {
  const auto points = Body15();
  const auto step = std::lround(codebook.sample_time_s / walk.frame_time_s);
  const auto last = static_cast<long>(walk.frames.size()) - 1;
  std::vector<SegmentViews::Query> queries;
  for (long t = 0; t <= last; ++t) {
    auto& query = queries.emplace_back(3, kSegmentSamples * static_cast<long>(points.size()));
    Eigen::Index column = 0;
    for (long k = 0; k < kSegmentSamples; ++k) {
      const long at = std::clamp(t + (k - kMiddleSample) * step, 0L, last);
      const Pose3 joints_m =
          JointPositions(walk.skeleton, LevelFromCam(walk.frames[static_cast<size_t>(at)]));
      for (const auto& parts : points) query.col(column++) = SumOfJoints(parts, joints_m);
    }
  }
  return queries;
}

void LiftSequenceBench(benchmark::State& state) {
  const Models models;
  const PhotoLifter photo_lifter(models.dictionary);
  const SequenceLifter lifter(photo_lifter, *models.codebook);
  const std::vector<Observation> frames = Pictures(WalkInCam(models, 60));
  for (auto _ : state) {
    auto lifted = lifter.LiftSequence(frames, kFrameTime_s);
    benchmark::DoNotOptimize(lifted.frames.data());
  }
  state.SetItemsProcessed(state.iterations() * std::ssize(frames));
}
BENCHMARK(LiftSequenceBench)
    ->Name("lift_sequence/default")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

// The MAP of five seconds alone, from the true poses, with its covariances.
void RefineSequence(benchmark::State& state) {
  const Models models;
  const Motion walk = WalkInCam(models, 150);
  const std::vector<Observation> pictures = Pictures(walk);
  const auto views = SegmentViews(*models.codebook, Body15())
                         .FindNearest(Moments(walk, *models.codebook), kDepthWeight, kNeighbours);
  std::vector<FrameEvidence> frames;
  for (size_t t = 0; t < walk.frames.size(); ++t) {
    FrameEvidence& frame = frames.emplace_back();
    frame.observation = pictures[t];
    frame.start = walk.frames[t];
    frame.start.root_in_world_m.setZero();
    frame.camera.scale_px_per_m = 180.0;
    frame.lifted_in_cam_m = JointPositions(walk.skeleton, frame.start);
    frame.local = MakeLocalPose(*models.codebook, views[t], kDepthWeight);
  }
  const SequenceRefinement refinement(walk.skeleton, models.dictionary.prior);
  for (auto _ : state) {
    auto refined = refinement.Solve(frames, kFrameTime_s);
    benchmark::DoNotOptimize(refined.data());
  }
  state.SetItemsProcessed(state.iterations() * std::ssize(frames));
}
BENCHMARK(RefineSequence)->Name("refine_sequence")->Unit(benchmark::kMillisecond);

void FindViews(benchmark::State& state) {
  const Models models;
  const SegmentViews views(*models.codebook, Body15());
  const auto moments = Moments(WalkInCam(models, 64), *models.codebook);
  for (auto _ : state) {
    auto nearest = views.FindNearest(moments, kDepthWeight, kNeighbours);
    benchmark::DoNotOptimize(nearest.data());
  }
  state.SetItemsProcessed(state.iterations() * std::ssize(moments));
}
BENCHMARK(FindViews)->Name("segment_views")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

Motion NoisyWalk(const Models& models, int num_frames) {
  Motion walk = WalkInCam(models, num_frames);
  std::mt19937_64 rng(1);
  std::normal_distribution<double> noise_rad(0.0, 0.03);
  for (SkeletonPose& pose : walk.frames) {
    pose = LevelFromCam(pose);
    for (double& dof : pose.dofs) dof += noise_rad(rng);
  }
  return walk;
}

void Smooth(benchmark::State& state, const Motion& motion, const MotionSmoother& smoother) {
  for (auto _ : state) {
    Motion smooth = smoother(motion, 0);
    benchmark::DoNotOptimize(smooth.frames.data());
  }
  state.SetItemsProcessed(state.iterations() * std::ssize(motion.frames));
}

Motion AsItIs(const Motion& motion, int /*max_gap_frames*/) { return motion; }

void SmoothByModel(benchmark::State& state) {
  const Models models;
  Smooth(state, NoisyWalk(models, 150), SmootherByModel(models.codebook, AsItIs));
}
BENCHMARK(SmoothByModel)
    ->Name("smooth_motion/model")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void SmoothAsAStream(benchmark::State& state) {
  const Models models;
  Smooth(state, NoisyWalk(models, 150), SmootherOnline(models.codebook, AsItIs));
}
BENCHMARK(SmoothAsAStream)->Name("smooth_motion/online")->Unit(benchmark::kMillisecond);

// A step with both hands and both ankles seen, over eight walks of five seconds; m
// poses are given.
void PathStep(benchmark::State& state) {
  constexpr int kWalks = 8, kFrames = 300;
  MotionDatabase database{{}, 1.0 / 60.0, {}, {}};
  for (int i = 0; i < kWalks; ++i) {
    const Motion walk = testing::PlantWalk(kFrames, 0.55 + 0.015 * i, 0.0).motion;
    database.skeleton = walk.skeleton;
    database.Append("walk", MotionFeatures(walk));
  }
  const PathSearch search(database, {.num_nearest = static_cast<int>(state.range(0))});
  const Motion walk = testing::PlantWalk(kFrames, 0.604, 0.0).motion;
  const auto num_first = static_cast<size_t>(state.range(1));
  PathReconstruction method(database, search);
  size_t t = walk.frames.size();
  std::vector<TargetPoint> observed;
  for (auto _ : state) {
    state.PauseTiming();
    if (t == walk.frames.size()) {
      t = num_first;
      method.Begin({walk.frames.begin(), walk.frames.begin() + state.range(1)});
    }
    const Pose3 joints_m = JointPositions(walk.skeleton, walk.frames[t++]);
    observed.clear();
    for (const int j : {joint::kLeftHand, joint::kRightHand, joint::kLeftAnkle, joint::kRightAnkle})
      observed.push_back({{{j, 1.0}}, joints_m.col(j), 200.0});
    state.ResumeTiming();
    benchmark::DoNotOptimize(method.Next(observed));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(PathStep)
    ->Name("path_step")
    ->ArgNames({"K", "m"})
    ->Args({100, 3})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace poselift
