// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lifted_files.h"

#include "src/io/angles_csv.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"

namespace poselift {
namespace {

bool AnyUsable(const LiftedLabels& lifted) {
  for (const auto& people : lifted.results)
    for (const LiftResult& result : people)
      if (result.IsUsable()) return true;
  return false;
}

}  // namespace

double FrameTime_s(const Labels& labels, double fps) {
  const auto& frames = labels.frames;
  const bool timed = frames.size() > 1 && frames.front().time_s && frames.back().time_s &&
                     *frames.back().time_s > *frames.front().time_s;
  if (!timed) return 1.0 / fps;
  return (*frames.back().time_s - *frames.front().time_s) / static_cast<double>(frames.size() - 1);
}

void WriteLifted(const LiftedLabels& lifted, const Labels& labels, const Skeleton& skeleton,
                 bool is_motion, double fps, const std::filesystem::path& folder) {
  WritePosesJson(lifted.poses, folder / "poses.json");
  WriteAnglesCsv(lifted.poses, folder / "angles.csv");
  if (is_motion) WriteAnglesSigmaCsv(lifted.poses, folder / "angles_sigma.csv");
  if (!AnyUsable(lifted)) return;
  const Motion motion = is_motion ? ToMotionOverTime(lifted, skeleton)
                                  : ToMotion(lifted, skeleton, FrameTime_s(labels, fps));
  if (motion.frames.empty()) return;
  WriteMotion(motion, folder / "poses.bvh");
  WriteMotion(motion, folder / "poses.amc");
}

}  // namespace poselift
