// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/reader_tables.h"

#include <cmath>

#include "src/forward_kinematics.h"
#include "src/io/amc.h"
#include "src/io/bvh.h"
#include "tests/support/made_up_asf.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

std::string FlawOf(const Motion& motion) {
  if (!(motion.frame_time_s > 0.0) || !std::isfinite(motion.frame_time_s)) return "a frame time";
  BoneFrames frames;
  for (const SkeletonPose& pose : motion.frames) {
    if (!pose.dofs.allFinite()) return "an angle that is not finite";
    ForwardKinematics(motion.skeleton, pose, &frames);
    if (!frames.tip_in_world_m.allFinite()) return "a place that is not finite";
  }
  return "";
}

const AsfSkeleton& SkeletonIn(const fs::path& dir) {
  static const AsfSkeleton kAsf = [&] {
    WriteBytes(dir / "made_up.asf", kMadeUpAsf);
    return ReadAsfSkeleton(dir / "made_up.asf");
  }();
  return kAsf;
}

Motion SomeMotion(const fs::path& dir) {
  std::mt19937_64 rng(1);
  return RandomMotion(SkeletonIn(dir).skeleton, 3, &rng);
}

std::string ReadsAsf(const fs::path& path) {
  const AsfSkeleton asf = ReadAsfSkeleton(path);
  return FlawOf({asf.skeleton, 1.0, {SkeletonPose::Rest(asf.skeleton)}});
}

std::string ReadsAmc(const fs::path& path) {
  return FlawOf(ReadAmc(path, SkeletonIn(path.parent_path())));
}

std::string ReadsBvh(const fs::path& path) { return FlawOf(ReadBvh(path)); }

}  // namespace

std::vector<Reader> MotionReaders() {
  return {
      {"asf", "a.asf", Text(std::string(kMadeUpAsf)), ReadsAsf},
      {"amc", "a.amc",
       [](const fs::path& dir) {
         WriteAmc(SomeMotion(dir), SkeletonIn(dir), dir / "whole.amc");
         return FileText(dir / "whole.amc");
       },
       ReadsAmc},
      {"bvh", "a.bvh",
       [](const fs::path& dir) {
         WriteBvh(SomeMotion(dir), dir / "whole.bvh");
         return FileText(dir / "whole.bvh");
       },
       ReadsBvh},
  };
}

}  // namespace poselift::testing
