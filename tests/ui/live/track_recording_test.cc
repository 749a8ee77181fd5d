// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Recordings of a planted walk, read back with our own readers: whole ones, with gaps, and by
// a child that writes as fast as it can and is killed at random moments.
#include "ui/live/track_recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/joint_angles.h"
#include "src/motion.h"
#include "src/pose_between.h"
#include "src/retarget.h"
#include "tests/support/child.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/mutation.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;
using testing::Child;
using testing::FileText;
using testing::MatrixNear;
using testing::PlantWalk;
using testing::ScratchDir;

constexpr double kFrameTime_s = 1.0 / 60.0;

FramePoses FrameOf(const SkeletonPose& pose, double time_s) {
  static const JointAngleReader reader(testing::TrimmedCmuLikeSkeleton());
  PersonPose person;
  person.status = "ok";
  person.tags = {{7, 0.41, true, false}};
  const Eigen::VectorXd angles_deg = reader.ReadDeg(pose);
  for (Eigen::Index a = 0; a < angles_deg.size(); ++a) {
    person.angles_deg.emplace_back(JointAngles()[static_cast<size_t>(a)].name, angles_deg[a]);
    person.angles_sigma_deg.emplace_back(person.angles_deg.back().first, 2.5);
  }
  person.joints_in_cam_m = JointPositions(testing::TrimmedCmuLikeSkeleton(), pose);
  return {"", time_s, {person}};
}

FramePoses UnknownFrame(double time_s) {
  PersonPose person;
  person.status = "not known";
  return {"", time_s, {person}};
}

std::vector<std::string> Rows(const fs::path& csv) {
  std::vector<std::string> rows;
  std::istringstream text(FileText(csv));
  for (std::string row; std::getline(text, row);) {
    EXPECT_TRUE(row.ends_with('\r'));
    rows.push_back(row);
  }
  EXPECT_TRUE(FileText(csv).ends_with("\r\n"));
  return rows;
}

long NumFields(const std::string& row) { return 1 + std::count(row.begin(), row.end(), ','); }

TEST(TrackRecording, IsReadBack) {
  const Motion walk = PlantWalk(60, 0.6, 0.3).motion;
  const Skeleton& skeleton = walk.skeleton;
  const fs::path dir = ScratchDir() / "new/run";
  TrackRecording recording(dir, skeleton, kFrameTime_s);
  // Nobody at first; then a frame in three is lost, and of frames 31 to 35 nothing is known.
  recording.Add({"", 99.9, {}}, {}, 99.9);
  recording.Add(UnknownFrame(99.99), UnknownPose(skeleton), 99.99);
  int num_added = 2;
  for (int f = 0; f < 60; ++f) {
    const double time_s = 100.0 + f * kFrameTime_s;
    if (f % 3 == 1) continue;
    ++num_added;
    const bool is_known = f <= 30 || f >= 36;
    const SkeletonPose& pose = walk.frames[static_cast<size_t>(f)];
    if (is_known)
      recording.Add(FrameOf(pose, time_s), pose, time_s);
    else
      recording.Add(UnknownFrame(time_s), {}, time_s);
  }
  recording.Close();
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), {}), 4);

  const Poses poses = ReadPosesJson(dir / "poses.json");
  ASSERT_EQ(poses.frames.size(), static_cast<size_t>(num_added));
  EXPECT_TRUE(poses.frames[0].people.empty());
  EXPECT_EQ(poses.frames[2].people[0].tags[0].id, 7);
  ASSERT_EQ(poses.bodies.size(), 1u);
  EXPECT_TRUE(MatrixNear(poses.bodies[0].lengths_m, BoneLengths(skeleton), 1e-6));

  for (const char* name : {"angles.csv", "angles_sigma.csv"}) {
    const auto rows = Rows(dir / name);
    ASSERT_EQ(rows.size(), static_cast<size_t>(num_added) + 1);
    const long num_fields = 2 + static_cast<long>(JointAngles().size());
    for (const std::string& row : rows) EXPECT_EQ(NumFields(row), num_fields);
    EXPECT_EQ(rows[0].find("frame,time_s," + JointAngles()[0].name + ","), 0u);
    const std::string empty(JointAngles().size(), ',');
    EXPECT_EQ(rows[1], "0,99.9" + empty + "\r");
    EXPECT_EQ(rows[2], "1,99.99" + empty + "\r");
    EXPECT_EQ(rows[3].find(",,"), std::string::npos);
  }

  const Motion bvh = ReadBvh(dir / "poses.bvh");
  EXPECT_NEAR(bvh.frame_time_s, kFrameTime_s, 1e-9);
  ASSERT_EQ(bvh.frames.size(), 60u);
  const Motion back = RebaseMotion(bvh, skeleton);
  const double floor_m = JointPositions(skeleton, walk.frames[0]).row(1).minCoeff();
  Eigen::Vector3d origin_m = walk.frames[0].root_in_world_m;
  origin_m.y() = floor_m;
  for (size_t f = 0; f < 60; ++f) {
    SkeletonPose wanted = walk.frames[f >= 31 && f < 36 ? 30 : f];
    if (f % 3 == 1 && (f < 31 || f > 36))  // lost: between its neighbours
      wanted = PoseBetween(skeleton, walk.frames[f - 1], walk.frames[f + 1], 0.5);
    wanted.root_in_world_m -= origin_m;
    EXPECT_TRUE(MatrixNear(JointPositions(skeleton, back.frames[f]),
                           JointPositions(skeleton, wanted), 1e-6))
        << f;
  }
}

TEST(TrackRecording, KilledAnywhereLosesNoFrameThatWasAdded) {
  const fs::path dir = ScratchDir();
  const Motion walk = PlantWalk(60, 0.6, 0.3).motion;
  std::vector<FramePoses> frames;
  for (const SkeletonPose& pose : walk.frames) frames.push_back(FrameOf(pose, 0.0));
  auto rng = testing::TestRng();
  for (int trial = 0; trial < 50; ++trial) {
    const Child child([&](Child::Shared* shared) {
      TrackRecording recording(dir, walk.skeleton, kFrameTime_s);
      for (int i = 0;; ++i) {
        FramePoses& frame = frames[static_cast<size_t>(i % 60)];
        frame.time_s = i * kFrameTime_s;
        recording.Add(frame, walk.frames[static_cast<size_t>(i % 60)], *frame.time_s);
        ++shared->added;
      }
    });
    while (child.shared().added < 2) ::usleep(100);
    ::usleep(static_cast<useconds_t>(rng() % 30000));
    child.Kill();
    ASSERT_TRUE(WIFSIGNALED(child.Wait()));
    const auto added = static_cast<size_t>(child.shared().added);
    for (const size_t found :
         {ReadPosesJson(dir / "poses.json").frames.size(), Rows(dir / "angles.csv").size() - 1,
          Rows(dir / "angles_sigma.csv").size() - 1, ReadBvh(dir / "poses.bvh").frames.size()}) {
      ASSERT_GE(found, added);
      ASSERT_LE(found, added + 1);
    }
    ASSERT_EQ(NumFields(Rows(dir / "angles.csv").back()),
              2 + static_cast<long>(JointAngles().size()));
  }
}

TEST(TrackRecording, IsReadWhileItGrows) {
  const fs::path dir = ScratchDir();
  const Motion walk = PlantWalk(5, 0.6, 0.3).motion;
  TrackRecording recording(dir, walk.skeleton, kFrameTime_s);
  EXPECT_TRUE(ReadPosesJson(dir / "poses.json").frames.empty());
  EXPECT_TRUE(ReadBvh(dir / "poses.bvh").frames.empty());
  for (size_t f = 0; f < 5; ++f) {
    const double time_s = static_cast<double>(f) * kFrameTime_s;
    recording.Add(FrameOf(walk.frames[f], time_s), walk.frames[f], time_s);
    EXPECT_EQ(ReadPosesJson(dir / "poses.json").frames.size(), f + 1);
    EXPECT_EQ(Rows(dir / "angles.csv").size(), f + 2);
    EXPECT_EQ(ReadBvh(dir / "poses.bvh").frames.size(), f + 1);
  }
  EXPECT_THROW(recording.Add(UnknownFrame(0.0), {}, 0.0), InputError);
}

TEST(TrackRecording, SaysWhyAFolderCannotBeMade) {
  const std::string file = testing::WriteScratch("file", "");
  EXPECT_THROW(TrackRecording(file, testing::TrimmedCmuLikeSkeleton(), kFrameTime_s), InputError);
  EXPECT_THROW(TrackRecording(ScratchDir() / "run", testing::TrimmedCmuLikeSkeleton(), 0.0),
               InputError);
}

}  // namespace
}  // namespace poselift::cli
