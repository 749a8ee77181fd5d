// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The real files: every AMC and BVH of the motion capture data is read, and the
// AMC go to BVH and back (through files on the disk). Nothing is faked. The
// property: every bone has the same rotation and place in the world, and every
// angle that is not at a gimbal lock is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "src/dof_angles.h"
#include "src/forward_kinematics.h"
#include "src/io/amc.h"
#include "src/io/bvh.h"
#include "src/retarget.h"
#include "src/units.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ScratchDir;

std::vector<std::filesystem::path> FindFiles(const std::filesystem::path& dir,
                                             const std::string& ending) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dir))
    if (entry.path().extension() == ending) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::filesystem::path AsfOf(const std::filesystem::path& amc, const std::filesystem::path& data) {
  return amc.filename() == "golf.amc" ? data / "mocap/cmu/02/02.asf" : FindAsfOf(amc);
}

// POSELIFT_FRAME_STRIDE=1 takes every frame, which takes half a minute.
size_t FrameStride() {
  const char* stride = std::getenv("POSELIFT_FRAME_STRIDE");
  return stride ? std::max(1, std::atoi(stride)) : 5;
}

void KeepEvery(size_t stride, Motion* motion) {
  std::vector<SkeletonPose> kept;
  for (size_t f = 0; f < motion->frames.size(); f += stride) kept.push_back(motion->frames[f]);
  motion->frames = std::move(kept);
}

struct Worst {
  double rotation_deg = 0.0;
  double angle_deg = 0.0;
  double position_mm = 0.0;
  size_t num_angles = 0;
  size_t num_other_branch = 0;  // the same rotation by other angles

  std::string Text() const {
    return "rotation " + std::to_string(rotation_deg * 1e6) + "e-6 deg, angle " +
           std::to_string(angle_deg * 1e6) + "e-6 deg, position " +
           std::to_string(position_mm * 1e6) + " nm; " + std::to_string(num_other_branch) + " of " +
           std::to_string(num_angles) + " angles on the other branch or in gimbal lock";
  }
};

// Angles that turn the same whole way round are the same.
double AngleDifference_deg(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, 2 * std::numbers::pi)) * kDegFromRad;
}

// Whether small errors of the rotation are small errors of the angles.
bool IsFarFromGimbalLock(const Bone& bone, const double* angles_rad) {
  constexpr double kLeastCos = 0.05;
  return bone.dofs.size() < 3 || std::abs(std::cos(angles_rad[1])) > kLeastCos;
}

void CompareAngles(const Skeleton& skeleton, const SkeletonPose& a, const SkeletonPose& b,
                   Worst* worst) {
  int d = 0;
  for (const Bone& bone : skeleton.bones) {
    const bool is_far = IsFarFromGimbalLock(bone, a.dofs.data() + d);
    // The same rotation on the other Euler branch is checked as a rotation.
    const bool same_branch =
        bone.dofs.size() < 3 || std::cos(a.dofs[d + 1]) * std::cos(b.dofs[d + 1]) > 0;
    const bool is_same = is_far && same_branch;
    worst->num_angles += bone.dofs.size();
    if (!is_same) worst->num_other_branch += bone.dofs.size();
    for (size_t i = 0; i < bone.dofs.size(); ++i, ++d)
      if (is_same)
        worst->angle_deg = std::max(worst->angle_deg, AngleDifference_deg(a.dofs[d], b.dofs[d]));
  }
}

void CompareMotions(const Motion& a, const Motion& b, Worst* worst) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  BoneFrames frames_a, frames_b;
  for (size_t f = 0; f < a.frames.size(); ++f) {
    ForwardKinematics(a.skeleton, a.frames[f], &frames_a);
    ForwardKinematics(b.skeleton, b.frames[f], &frames_b);
    for (size_t bone = 0; bone < a.skeleton.bones.size(); ++bone)
      worst->rotation_deg =
          std::max(worst->rotation_deg, kDegFromRad * AngleBetween(frames_a.world_from_bone[bone],
                                                                   frames_b.world_from_bone[bone]));
    const double start_m =
        (frames_a.start_in_world_m - frames_b.start_in_world_m).colwise().norm().maxCoeff();
    const double tip_m =
        (frames_a.tip_in_world_m - frames_b.tip_in_world_m).colwise().norm().maxCoeff();
    worst->position_mm = std::max({worst->position_mm, 1e3 * start_m, 1e3 * tip_m});
    CompareAngles(a.skeleton, a.frames[f], b.frames[f], worst);
  }
}

TEST(MocapFiles, GoFromAmcToBvhAndBackUnchanged) {
  POSELIFT_DATA_OR_SKIP(data);
  const auto bvh_path = ScratchDir() / "there.bvh";
  const auto amc_path = ScratchDir() / "back.amc";
  Worst worst;
  size_t num_frames = 0;
  const auto amc_files = FindFiles(data / "mocap", ".amc");
  EXPECT_GT(amc_files.size(), 100u);
  for (const auto& path : amc_files) {
    SCOPED_TRACE(path.string());
    const AsfSkeleton asf = ReadAsfSkeleton(AsfOf(path, data));
    Motion original = ReadAmc(path, asf);
    KeepEvery(FrameStride(), &original);
    num_frames += original.frames.size();
    WriteBvh(original, bvh_path);
    RebaseReport report;
    const Motion on_asf = RebaseMotion(ReadBvh(bvh_path), asf.skeleton, &report);
    EXPECT_LT(report.worst_rotation_rad * kDegFromRad, 0.001) << report.worst_bone;
    WriteAmc(on_asf, asf, amc_path);
    CompareMotions(original, ReadAmc(amc_path, asf), &worst);
    ASSERT_LT(worst.rotation_deg, 0.001);
    ASSERT_LT(worst.angle_deg, 0.001);
    ASSERT_LT(worst.position_mm, 0.01);
  }
  RecordProperty("worst", worst.Text());
  RecordProperty("frames", static_cast<int>(num_frames));
}

TEST(MocapFiles, KeepTheirBonesWhenABvhIsWrittenAsBvhOrAmc) {
  POSELIFT_DATA_OR_SKIP(data);
  const auto files = FindFiles(data / "mocap", ".bvh");
  EXPECT_GE(files.size(), 13u);
  for (const auto& path : files) {
    SCOPED_TRACE(path.string());
    Motion original = ReadBvh(path);
    KeepEvery(FrameStride() * 2, &original);
    WriteBvh(original, ScratchDir() / "again.bvh");
    Worst worst;
    CompareMotions(original, ReadBvh(ScratchDir() / "again.bvh"), &worst);
    EXPECT_LT(worst.rotation_deg, 0.001);
    EXPECT_LT(worst.position_mm, 0.01);

    const AsfSkeleton asf = ToAsfSkeleton(original.skeleton);
    WriteAsf(asf, ScratchDir() / "own.asf");
    WriteAmc(original, asf, ScratchDir() / "own.amc");
    const Motion amc = ReadAmc(ScratchDir() / "own.amc", ReadAsfSkeleton(ScratchDir() / "own.asf"));
    Worst from_amc;
    CompareMotions({asf.skeleton, original.frame_time_s, original.frames}, amc, &from_amc);
    EXPECT_LT(from_amc.rotation_deg, 0.001);
    EXPECT_LT(from_amc.position_mm, 0.01);
  }
}

}  // namespace
}  // namespace poselift
