// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string_view>

#include "lift/temporal/pose_grid.h"
#include "src/io/angles_csv.h"
#include "src/io/bvh.h"
#include "src/io/poses_json.h"
#include "src/poses.h"
#include "src/skeleton.h"

namespace poselift {

// What `track` writes while it runs: poses.json, angles.csv, angles_sigma.csv, poses.bvh.
// Each is whole at every moment (growing_file.h) and has all frames that were added.
//
// poses.json names the bones of person 0, those of the skeleton, under bodies.
// poses.bvh has a frame every frame_time_s from the first known pose on (pose_grid.h): y up,
// the lowest joint of that pose on the floor and its pelvis above the origin.
class TrackRecording {
 public:
  // What it was made from, in poses.json: what a camera gave cannot be had again.
  static constexpr std::string_view kCamera = "camera", kFiles = "files";

  // Makes the folder. Throws InputError when a file cannot be written.
  TrackRecording(const std::filesystem::path& dir, const Skeleton& skeleton, double frame_time_s,
                 std::string_view source = kCamera);

  // pose_in_world: of the skeleton, y up; nothing when it is not known.
  // Waits for the disk when the disk is busy: not for the thread that empties the camera's buffers.
  // Throws InputError when a file cannot be written further, or when time does not go on.
  void Add(const FramePoses& frame, const std::optional<SkeletonPose>& pose_in_world,
           double time_s);

  void Close();

 private:
  std::optional<SkeletonPose> OnFloor(std::optional<SkeletonPose> pose_in_world);

  const Skeleton skeleton_;
  GrowingPosesJson poses_;
  GrowingAnglesCsv angles_, sigmas_;
  GrowingBvh bvh_;
  PoseGrid grid_;
  std::optional<Eigen::Vector3d> origin_in_world_m_;  // of the BVH
};

}  // namespace poselift
