// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Prints where the bones of a motion are, for tests that compare with other
// programs: bone_positions MOTION EVERY; per line
//   frame bone  start_x start_y start_z  tip_x tip_y tip_z        (metres)
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "src/forward_kinematics.h"
#include "src/io/motion_file.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bone_positions MOTION EVERY\n");
    return 2;
  }
  try {
    const poselift::Motion motion = poselift::ReadMotion(argv[1]);
    const size_t every = std::strtoul(argv[2], nullptr, 10);
    poselift::BoneFrames frames;
    for (size_t f = 0; f < motion.frames.size(); f += every) {
      poselift::ForwardKinematics(motion.skeleton, motion.frames[f], &frames);
      for (size_t b = 0; b < motion.skeleton.bones.size(); ++b) {
        const Eigen::Vector3d start = frames.start_in_world_m.col(static_cast<int>(b));
        const Eigen::Vector3d tip = frames.tip_in_world_m.col(static_cast<int>(b));
        std::printf("%zu %s %.9f %.9f %.9f %.9f %.9f %.9f\n", f,
                    motion.skeleton.bones[b].name.c_str(), start.x(), start.y(), start.z(), tip.x(),
                    tip.y(), tip.z());
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
