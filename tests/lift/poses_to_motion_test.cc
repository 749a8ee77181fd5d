// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up walk before a camera, written as poses and read back: the poses, the
// place in the picture and the times are known.
#include "lift/poses_to_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/joint_angles.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;
using testing::MatrixNear;

constexpr double kRate_hz = 60.0;

// Facing a level camera 4 m away, 1.2 m above the floor: 800 px focal length.
Poses PlantPoses(int num_frames, bool with_depth) {
  PosesMotion source;
  source.person_id = 3;
  source.motion = testing::PlantWalk(num_frames, 0.6, 0.0).motion;
  source.camera.world_in_level_cam_m = Eigen::Vector3d(0.3, -1.2, -4.0);
  source.camera.centre_px = {320.0, 240.0};
  source.camera.has_depth = with_depth;
  source.camera.focal_px = 800.0;
  for (int t = 0; t < num_frames; ++t) {
    source.camera.scale_px_per_m.push_back(200.0 + 0.1 * t);
    source.times_s.push_back(2.0 + t / kRate_hz);
    source.images.push_back("a" + std::to_string(t) + ".png");
  }
  return MotionToPoses(source.motion, source, std::vector<std::string>(num_frames, "ok"));
}

Pose3 RootCentred(const Motion& motion, size_t frame) {
  const Pose3 joints_m = JointPositions(motion.skeleton, motion.frames[frame]);
  return joints_m.colwise() - joints_m.col(joint::kPelvis);
}

TEST(PosesToMotion, AWalkBeforeAKnownCameraComesBack) {
  const Motion truth = testing::PlantWalk(60, 0.6, 0.0).motion;
  const PosesMotion back = PosesToMotion(PlantPoses(60, true), truth.skeleton);
  ASSERT_EQ(back.motion.frames.size(), 60u);
  EXPECT_NEAR(back.motion.frame_time_s, 1.0 / kRate_hz, 1e-9);
  EXPECT_EQ(back.person_id, 3);
  EXPECT_FALSE(back.is_resampled);
  EXPECT_LT(back.worst_ik_rms_m, 0.002);
  EXPECT_NEAR(back.camera.focal_px, 800.0, 1e-6);
  EXPECT_TRUE(MatrixNear(back.camera.centre_px, Eigen::Vector2d(320.0, 240.0), 1e-6));
  for (size_t t = 0; t < 60; ++t) {
    EXPECT_TRUE(MatrixNear(RootCentred(back.motion, t), RootCentred(truth, t), 0.01)) << t;
    // World starts below the first pelvis.
    const Eigen::Vector3d walked_m =
        truth.frames[t].root_in_world_m - truth.frames[0].root_in_world_m;
    const Eigen::Vector3d found_m =
        back.motion.frames[t].root_in_world_m - back.motion.frames[0].root_in_world_m;
    EXPECT_TRUE(MatrixNear(found_m, walked_m, 0.005)) << t;
  }
  EXPECT_NEAR(back.motion.frames[0].root_in_world_m.x(), 0.0, 0.005);
  EXPECT_NEAR(back.motion.frames[0].root_in_world_m.y(), truth.frames[0].root_in_world_m.y() - 0.02,
              0.03);  // the lowest joint, not the sole, is on the floor
}

TEST(PosesToMotion, WeakPerspectiveKeepsThePicturesPlaneAndTheWayBackThePixels) {
  const Poses poses = PlantPoses(60, false);
  const PosesMotion there = PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton());
  EXPECT_FALSE(there.camera.has_depth);
  for (const SkeletonPose& pose : there.motion.frames)
    EXPECT_NEAR(pose.root_in_world_m.z(), 0.0, 0.005);
  const Poses back = MotionToPoses(there.motion, there, std::vector<std::string>(60, "ok"));
  for (size_t f = 0; f < 60; ++f) {
    const PersonPose& a = poses.frames[f].people[0];
    const PersonPose& b = back.frames[f].people[0];
    EXPECT_EQ(back.frames[f].image, poses.frames[f].image);
    EXPECT_NEAR(*back.frames[f].time_s, *poses.frames[f].time_s, 1e-9);
    EXPECT_NEAR(b.scale_px_per_m, a.scale_px_per_m, 1e-9);
    for (int j = 0; j < kNumJoints; ++j) {
      const auto x_px = [j](const PersonPose& person) -> Eigen::Vector2d {
        return person.scale_px_per_m * person.joints_in_cam_m.col(j).head<2>() +
               person.translation_px;
      };
      EXPECT_TRUE(MatrixNear(x_px(b), x_px(a), 2.5)) << f << " " << j;
    }
    EXPECT_LT(b.rotation_cam_from_body.angularDistance(a.rotation_cam_from_body), 0.05);
    EXPECT_EQ(b.angles_deg.size(), 45u);
  }
}

TEST(PosesToMotion, WhoIsInNoPictureRestsOnTheFloor) {
  Poses poses = PlantPoses(20, false);
  for (FramePoses& frame : poses.frames) {
    PersonPose& person = frame.people.front();
    person.translation_px.setConstant(kUnknown);
    person.scale_px_per_m = kUnknown;
  }
  const PosesMotion there = PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton());
  for (const SkeletonPose& pose : there.motion.frames) {
    EXPECT_NEAR(JointPositions(there.motion.skeleton, pose).row(1).minCoeff(), 0.0, 1e-9);
    EXPECT_NEAR(pose.root_in_world_m.x(), 0.0, 0.005);
    EXPECT_NEAR(pose.root_in_world_m.z(), 0.0, 0.005);
  }
}

TEST(PosesToMotion, FramesWithoutAPoseAreUnknown) {
  Poses poses = PlantPoses(20, true);
  poses.frames[4].people.clear();
  poses.frames[5].people[0].status = "failed";
  poses.frames[6].people[0].status = "filled";
  poses.frames.erase(poses.frames.begin() + 10, poses.frames.begin() + 12);  // times skip
  PosesMotion motion = PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton());
  ASSERT_EQ(motion.motion.frames.size(), 20u);
  for (int t = 0; t < 20; ++t) {
    const bool missing = (t >= 4 && t <= 6) || t == 10 || t == 11;
    EXPECT_EQ(IsKnown(motion.motion.frames[t]), !missing) << t;
  }
  EXPECT_EQ(motion.source_frames[11], -1);
  EXPECT_EQ(motion.source_frames[12], 10);
  motion = PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton(), {.with_filled = true});
  EXPECT_TRUE(IsKnown(motion.motion.frames[6]));
  EXPECT_TRUE(motion.is_filled[6]);
  EXPECT_FALSE(motion.is_filled[7]);
}

TEST(PosesToMotion, AnglesStayAsTheyAreNamedWhereTheirSigmasAreKnown) {
  Poses poses = PlantPoses(8, true);
  EXPECT_EQ(PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton()).angles_sigma_deg.size(), 0);
  poses.frames[3].people[0].angles_sigma_deg = {{"left_knee.flexion", 4.0}};
  poses.frames.erase(poses.frames.begin() + 1);  // a place without a frame
  const PosesMotion motion = PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton());
  ASSERT_EQ(motion.angles_sigma_deg.cols(), 8);
  const auto& names = JointAngles();
  for (Eigen::Index a = 0; a < motion.angles_deg.rows(); ++a) {
    EXPECT_EQ(motion.angles_deg(a, 3), poses.frames[2].people[0].angles_deg[a].second);
    EXPECT_TRUE(std::isnan(motion.angles_deg(a, 1)));
    EXPECT_TRUE(std::isnan(motion.angles_sigma_deg(a, 4)));
    if (names[a].name == "left_knee.flexion")
      EXPECT_EQ(motion.angles_sigma_deg(a, 3), 4.0);
    else
      EXPECT_TRUE(std::isnan(motion.angles_sigma_deg(a, 3)));
  }
}

TEST(PosesToMotion, UnevenTimesAreResampledAndSaidSo) {
  Poses poses = PlantPoses(40, true);
  for (size_t f = 0; f < 40; ++f) *poses.frames[f].time_s += (f % 3) * 0.003;
  const PosesMotion motion = PosesToMotion(poses, testing::TrimmedCmuLikeSkeleton());
  EXPECT_TRUE(motion.is_resampled);
  EXPECT_EQ(motion.times_s.size(), motion.motion.frames.size());
  for (const SkeletonPose& pose : motion.motion.frames) EXPECT_TRUE(IsKnown(pose));
}

TEST(PosesToMotion, TakesThePersonWhoIsAskedFor) {
  Poses poses = PlantPoses(5, true);
  for (FramePoses& frame : poses.frames) {
    frame.people.push_back(frame.people[0]);
    frame.people[1].id = 8;
    frame.people[1].pelvis_in_cam_m.x() += 1.0;
  }
  const Skeleton skeleton = testing::TrimmedCmuLikeSkeleton();
  EXPECT_EQ(PosesToMotion(poses, skeleton).person_id, 3);
  const PosesMotion other = PosesToMotion(poses, skeleton, {.person_id = 8});
  EXPECT_EQ(other.person_id, 8);
  EXPECT_NEAR(other.camera.world_in_level_cam_m.x(), 1.3, 0.01);
  try {
    PosesToMotion(poses, skeleton, {.person_id = 5});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no person 5, wanted one of 3, 8"));
  }
}

TEST(PosesToMotion, PosesWithoutTimesPeopleOrSkeletonAreRefused) {
  const Skeleton skeleton = testing::TrimmedCmuLikeSkeleton();
  EXPECT_THROW(PosesToMotion({}, skeleton), InputError);
  Poses poses = PlantPoses(5, true);
  poses.frames[2].time_s.reset();
  EXPECT_THROW(PosesToMotion(poses, skeleton), InputError);
  EXPECT_NEAR(PosesToMotion(poses, skeleton, {.frame_time_s = 0.1}).motion.frame_time_s, 0.1,
              1e-12);
  poses = PlantPoses(5, true);
  poses.frames[3].time_s = poses.frames[2].time_s;
  EXPECT_THROW(PosesToMotion(poses, skeleton), InputError);
  poses = PlantPoses(5, true);
  for (FramePoses& frame : poses.frames) frame.people[0].status = "failed";
  EXPECT_THROW(PosesToMotion(poses, skeleton), InputError);
  for (FramePoses& frame : poses.frames) frame.people.clear();
  EXPECT_THROW(PosesToMotion(poses, skeleton), InputError);
}

TEST(PosesToMotion, AFrameNotKnownIsWrittenWithoutAPose) {
  const PosesMotion motion = PosesToMotion(PlantPoses(3, true), testing::TrimmedCmuLikeSkeleton());
  const Poses poses =
      MotionToPoses(motion.motion, motion, {"ok", "filled", std::string(kUnknownStatus)});
  EXPECT_EQ(poses.frames[1].people[0].status, "filled");
  EXPECT_TRUE(poses.frames[1].people[0].joints_in_cam_m.allFinite());
  EXPECT_TRUE(poses.frames[2].people[0].joints_in_cam_m.array().isNaN().all());
  EXPECT_FALSE(poses.frames[2].people[0].message.empty());
  EXPECT_THROW(MotionToPoses(motion.motion, motion, {"ok"}), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
