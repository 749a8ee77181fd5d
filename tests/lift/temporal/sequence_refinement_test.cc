// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk of which tags alone are seen, without any prior but smoothness:
// what the tags hold, the sequence has.
#include "lift/temporal/sequence_refinement.h"

#include <gtest/gtest.h>

#include "src/dof_angles.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/made_up_gaits.h"
#include "tests/support/planted_tag.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr size_t kFrames = 20;

class TagsOverTime : public ::testing::Test {
 protected:
  TagsOverTime() : walk_(testing::MadeUpGaits().Gait(kFrames, 0.4)) {}

  // From rest, with the tags of these bones in every frame.
  std::vector<RefinedFrame> Refine(const std::vector<std::string>& bones) const {
    std::vector<FrameEvidence> evidence(kFrames);
    for (size_t t = 0; t < kFrames; ++t) {
      evidence[t].start = SkeletonPose::Rest(walk_.skeleton);
      evidence[t].camera.scale_px_per_m = 0.0;
      for (const std::string& bone : bones)
        evidence[t].observation.bone_poses.push_back(
            testing::PlantTag(walk_.skeleton, walk_.frames[t], bone));
    }
    SequenceRefinementOptions weak{.acceleration_sigma_rad = 1.0,
                                   .turn_sigma = 1.0,
                                   .path_sigma_m = 1.0,
                                   .function_tolerance = 1e-12,
                                   .max_iterations = 200};
    return SequenceRefinement(walk_.skeleton, {}, weak).Solve(evidence, walk_.frame_time_s);
  }

  Motion walk_;
};

TEST_F(TagsOverTime, TheSequenceFollowsThem) {
  const std::vector<std::string> bones = {"root", "lhumerus", "lradius"};
  const std::vector<RefinedFrame> refined = Refine(bones);
  const int elbow = walk_.skeleton.DofStarts()[*walk_.skeleton.FindBone("lradius")];
  BoneFrames truth, found;
  for (size_t t = 0; t < kFrames; ++t) {
    ForwardKinematics(walk_.skeleton, walk_.frames[t], &truth);
    ForwardKinematics(walk_.skeleton, refined[t].pose, &found);
    EXPECT_NEAR(refined[t].pose.dofs[elbow], walk_.frames[t].dofs[elbow], 2e-3);
    for (const std::string& name : bones) {
      const int bone = *walk_.skeleton.FindBone(name);
      EXPECT_LT(AngleBetween(truth.world_from_bone[bone], found.world_from_bone[bone]), 2e-3);
      EXPECT_TRUE(testing::MatrixNear(truth.start_in_world_m.col(bone),
                                      found.start_in_world_m.col(bone), 1e-3));
    }
  }
}

TEST_F(TagsOverTime, WithoutThemTheBodyStaysWhereItStarts) {
  for (const RefinedFrame& frame : Refine({})) EXPECT_LT(frame.pose.dofs.norm(), 1e-6);
}

}  // namespace
}  // namespace poselift
