// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "src/motion.h"

namespace poselift {

class BvhText;
class GrowingFile;

// Biovision hierarchy (.bvh): joints with offsets and channels, then one line of
// channel values a frame. For channels Z X Y the local rotation is Rz Rx Ry.
// Lengths have no unit in the file; angles are degrees.

struct BvhReadOptions {
  double metres_per_unit = 0.01;     // most files are in cm
  double frame_time_s = 1.0 / 30.0;  // for files that have no Frame Time
};

// A bone a joint: offset_m is its OFFSET, tip_m its End Site, or its only
// child's OFFSET, or the mean of its children's. Its dofs are its channels: any
// of the six in any order. Position channels take the place of the OFFSET (as
// in Blender and MotionBuilder), so a shift dof is the channel less the OFFSET.
// Throws InputError with file:line for anything malformed.
Motion ReadBvh(const std::filesystem::path& path, const BvhReadOptions& options = {});

struct BvhWriteOptions {
  double metres_per_unit = 0.01;  // cm
};

// Writes the motion on its BvhRig (bvh_rig.h: a T-pose at rest), in the form
// that the readers of Blender, MotionBuilder and others all take: a word group a
// line, root with 6 channels, other joints with 3 (Z X Y; 6 when they shift),
// End Sites at the leaves, plain unique names, fixed decimals, angles without
// jumps. Throws InputError for a NaN or a frame time that is not positive.
void WriteBvh(const Motion& motion, const std::filesystem::path& path,
              const BvhWriteOptions& options = {});

// The same file, pose after pose, whole at every moment (growing_file.h): the number of its
// frames in the header has a fixed width, padded with spaces, and changes with each line.
class GrowingBvh {
 public:
  // Throws InputError as above.
  GrowingBvh(const std::filesystem::path& path, const Skeleton& skeleton, double frame_time_s,
             const BvhWriteOptions& options = {});
  ~GrowingBvh();

  // Throws InputError when it cannot be written (the file is as before), std::invalid_argument
  // for an unknown pose (motion.h).
  void Add(const SkeletonPose& pose);
  void Close();

 private:
  std::unique_ptr<BvhText> text_;
  size_t count_place_ = 0;
  std::unique_ptr<GrowingFile> file_;
  int64_t num_frames_ = 0;
};

}  // namespace poselift
