// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The geometry of the views on random made-up poses: frames, floor, projection.
#include "src/draw/scene.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::Vector3d;
using testing::MatrixNear;

Pose3 RandomPose(std::mt19937_64* rng, double size_m) {
  std::normal_distribution<double> normal;
  return Pose3::NullaryExpr(3, kNumJoints, [&] { return size_m * normal(*rng); });
}

Vector3d RandomUp(std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  return {normal(*rng), normal(*rng), normal(*rng)};
}

// Along the axes of cam: one step to the right, down, forward from the center.
Vector3d Step(const View& view, const Vector3d& step_in_cam) {
  return view.view_from_cam * step_in_cam;
}

TEST(Scene, ViewsOfALevelCameraLookWhereTheirNamesSay) {
  auto rng = testing::TestRng();
  const Scene scene = MakeScene(RandomPose(&rng, 0.5), {}, -Vector3d::UnitY());
  const std::vector<View> views = StandardViews(scene);
  ASSERT_EQ(views.size(), 4u);
  const Vector3d right = Vector3d::UnitX(), down = Vector3d::UnitY(), forward = Vector3d::UnitZ();
  EXPECT_TRUE(MatrixNear(views[0].view_from_cam, Eigen::Matrix3d::Identity(), 1e-12));
  // From the camera's right: what is farther from the camera is to the right.
  EXPECT_TRUE(MatrixNear(Step(views[1], forward), Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(MatrixNear(Step(views[1], down), Vector3d(0, 1, 0), 1e-12));
  EXPECT_TRUE(MatrixNear(Step(views[1], right), Vector3d(0, 0, -1), 1e-12));
  // From above: what is farther from the camera is higher in the panel.
  EXPECT_TRUE(MatrixNear(Step(views[2], forward), Vector3d(0, -1, 0), 1e-12));
  EXPECT_TRUE(MatrixNear(Step(views[2], right), Vector3d(1, 0, 0), 1e-12));
  EXPECT_TRUE(MatrixNear(Step(views[2], down), Vector3d(0, 0, 1), 1e-12));
  // Between front and right, and from above: upright, both of them visible.
  EXPECT_GT(Step(views[3], down).y(), 0.9);
  EXPECT_GT(Step(views[3], right).x(), 0.5);
  EXPECT_GT(Step(views[3], forward).x(), 0.5);
  EXPECT_LT(Step(views[3], right).z(), 0.0);  // the camera's right is nearer
}

TEST(Scene, AnOrbitPassesTheStandardViews) {
  auto rng = testing::TestRng();
  const Scene level = MakeScene(RandomPose(&rng, 0.5), {}, -Vector3d::UnitY());
  const std::vector<View> views = StandardViews(level);
  const double quarter_rad = std::acos(0.0);
  EXPECT_TRUE(MatrixNear(OrbitView(level, 0.0, 0.0).view_from_cam, views[0].view_from_cam, 1e-12));
  EXPECT_TRUE(
      MatrixNear(OrbitView(level, quarter_rad, 0.0).view_from_cam, views[1].view_from_cam, 1e-12));
  EXPECT_TRUE(
      MatrixNear(OrbitView(level, 0.0, quarter_rad).view_from_cam, views[2].view_from_cam, 1e-12));
}

TEST(Scene, ViewsAreRotationsForAnyUp) {
  auto rng = testing::TestRng();
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d up = trial == 0   ? Vector3d::UnitZ()
                        : trial == 1 ? Vector3d(-Vector3d::UnitZ())
                                     : RandomUp(&rng);
    const Scene scene = MakeScene(RandomPose(&rng, 0.5), {}, up);
    for (const View& view : StandardViews(scene)) {
      EXPECT_TRUE(MatrixNear(view.view_from_cam * view.view_from_cam.transpose(),
                             Eigen::Matrix3d::Identity(), 1e-12));
      EXPECT_NEAR(view.view_from_cam.determinant(), 1.0, 1e-12);
    }
  }
}

TEST(Scene, FloorTouchesTheLowestJoint) {
  auto rng = testing::TestRng();
  for (int trial = 0; trial < 50; ++trial) {
    const Pose3 joints = RandomPose(&rng, 0.5);
    const Scene scene = MakeScene(joints, {}, RandomUp(&rng));
    const Pose3 shadow = scene.Shadow();
    const Eigen::RowVectorXd heights = scene.up.transpose() * (joints - shadow);
    EXPECT_NEAR(heights.minCoeff(), 0.0, 1e-12);
    const Eigen::RowVectorXd shadow_heights = scene.up.transpose() * shadow;
    EXPECT_NEAR(shadow_heights.maxCoeff(), shadow_heights.minCoeff(), 1e-12);
    EXPECT_TRUE(MatrixNear(shadow.col(joint::kPelvis), scene.base_in_cam_m, 1e-12));
  }
}

TEST(Scene, MiddlePlaneIsShownToScaleAndNearerThingsAreLarger) {
  auto rng = testing::TestRng();
  const Scene scene = MakeScene(RandomPose(&rng, 0.5), {}, -Vector3d::UnitY());
  for (const View& view : StandardViews(scene)) {
    const Projection projection = {view, scene.center_in_cam_m, 100.0, {250.0, 250.0}};
    const auto step_px = [&](double depth_m) {
      const Eigen::Matrix3d cam_from_view = view.view_from_cam.transpose();
      const Vector3d from = scene.center_in_cam_m + cam_from_view * Vector3d(0, 0, depth_m);
      return (projection.Flat(from + cam_from_view.col(0)) - projection.Flat(from)).norm();
    };
    EXPECT_NEAR(step_px(0.0), 100.0, 1e-9);
    if (view.eye_distance_m > 0.0) {
      EXPECT_GT(step_px(-0.5), 102.0);
      EXPECT_LT(step_px(0.5), 98.0);
    }
  }
}

TEST(Scene, NothingThatIsDrawnStandsBehindTheEye) {
  auto rng = testing::TestRng();
  for (const double size_m : {1e-6, 0.5, 3e3}) {
    const Scene scene = MakeScene(RandomPose(&rng, size_m), {}, RandomUp(&rng));
    const Pose3 shadow = scene.Shadow();
    for (const View& view : StandardViews(scene)) {
      if (view.eye_distance_m == 0.0) continue;
      const Projection projection = {view, scene.center_in_cam_m};
      EXPECT_GT(projection(scene.joints_in_cam_m).row(2).minCoeff(), -0.5 * view.eye_distance_m);
      EXPECT_GT(projection(shadow).row(2).minCoeff(), -0.5 * view.eye_distance_m);
    }
  }
}

TEST(Scene, GridHasFewLinesForAnySize) {
  auto rng = testing::TestRng();
  EXPECT_EQ(MakeScene(RandomPose(&rng, 0.5), {}, -Vector3d::UnitY()).grid_step_m, 0.5);
  for (const double size_m : {0.0, 10.0, 3e3}) {
    const Scene scene = MakeScene(RandomPose(&rng, size_m), {}, -Vector3d::UnitY());
    EXPECT_LE(scene.radius_m / scene.grid_step_m, 12.0);
  }
}

TEST(Scene, WildJointsAreLeftOut) {
  Pose3 joints = Pose3::Zero(3, kNumJoints);
  joints(0, 3) = 1e5;
  joints(1, 4) = std::numeric_limits<double>::infinity();
  joints(2, 5) = std::numeric_limits<double>::quiet_NaN();
  const Scene scene = MakeScene(joints, {joints}, -Vector3d::UnitY());
  for (const int j : {3, 4, 5}) {
    EXPECT_TRUE(scene.joints_in_cam_m.col(j).array().isNaN().all());
    EXPECT_TRUE(scene.others_in_cam_m[0].col(j).array().isNaN().all());
  }
  EXPECT_LT(scene.radius_m, 1.0);
  EXPECT_TRUE(scene.base_in_cam_m.isZero());
}

}  // namespace
}  // namespace poselift
