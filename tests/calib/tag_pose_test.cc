// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: IPPE of OpenCV, the lens model. Made up: planted poses, corners with normal noise.
// Checked: poses over angles and distances through distortion, both minima, the covariance's
// coverage, that the flag says when corners do not tell, and that hints then choose rightly.
#include "calib/tag_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "src/input_error.h"
#include "src/tag_detection.h"
#include "src/units.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

constexpr double kSize_m = 0.08;

Camera Webcam() {
  return {.width_px = 1280,
          .height_px = 720,
          .fx_px = 930,
          .fy_px = 925,
          .cx_px = 648,
          .cy_px = 352,
          .distortion = {.k1 = -0.21, .k2 = 0.07, .p1 = 0.0012, .p2 = -0.0008, .k3 = -0.01}};
}

// Turned about its normal, then tilted about an axis in the picture.
Eigen::Isometry3d View(double tilt_deg, double azimuth_deg, double turn_deg,
                       const Eigen::Vector3d& place_m) {
  const double azimuth = azimuth_deg * kRadFromDeg;
  Eigen::Isometry3d cam_from_tag = Eigen::Isometry3d::Identity();
  cam_from_tag.translation() = place_m;
  cam_from_tag.rotate(Eigen::AngleAxisd(tilt_deg * kRadFromDeg,
                                        Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0)));
  cam_from_tag.rotate(Eigen::AngleAxisd(turn_deg * kRadFromDeg, Eigen::Vector3d::UnitZ()));
  return cam_from_tag;
}

Eigen::Matrix<double, 2, 4> Seen(const Eigen::Isometry3d& cam_from_tag) {
  Eigen::Matrix<double, 2, 4> corners_px;
  for (int i = 0; i < 4; ++i)
    corners_px.col(i) = Webcam().Project(cam_from_tag * TagCorners_m(kSize_m).col(i));
  return corners_px;
}

Eigen::Matrix<double, 2, 4> Noisy(Eigen::Matrix<double, 2, 4> corners_px, double sigma_px,
                                  std::mt19937_64* rng) {
  std::normal_distribution<double> noise(0.0, sigma_px);
  for (double& coordinate : corners_px.reshaped()) coordinate += noise(*rng);
  return corners_px;
}

double Angle(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

TEST(TagPoseTest, PlantedPosesAreFoundThroughTheLens) {
  for (const double distance_m : {0.4, 1.0, 3.0})
    for (const double tilt_deg : {15.0, 35.0, 70.0})
      for (const double azimuth_deg : {0.0, 80.0, 205.0})
        for (const double side : {-0.3, 0.0, 0.25}) {
          const Eigen::Isometry3d truth = View(tilt_deg, azimuth_deg, 33.0 + azimuth_deg,
                                               distance_m * Eigen::Vector3d(side, 0.5 * side, 1.0));
          const TagPoses found = FindTagPoses(Webcam(), Seen(truth), kSize_m);
          ASSERT_FALSE(found.poses.empty());
          const TagPose& best = found.poses[0];
          EXPECT_TRUE(testing::MatrixNear(best.cam_from_tag.matrix(), truth.matrix(), 1e-6));
          EXPECT_LT(best.rms_px, 1e-6);
          EXPECT_TRUE(found.poses.size() == 1 || found.poses[1].rms_px > best.rms_px);
        }
}

TEST(TagPoseTest, AnUprightTagBeforeTheCameraHasTheCamerasAxes) {
  const Eigen::Isometry3d truth = View(0, 0, 0, {0, 0, 1});
  const TagPoses found = FindTagPoses(Webcam(), Seen(truth), kSize_m);
  ASSERT_FALSE(found.poses.empty());
  EXPECT_TRUE(testing::MatrixNear(found.poses[0].cam_from_tag.matrix(), truth.matrix(), 1e-3));
  const Eigen::Isometry3d ros = CamFromRosTag(truth);
  EXPECT_TRUE(testing::MatrixNear(ros * Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 1), 0.0));
  EXPECT_TRUE(testing::MatrixNear(ros * Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, 0), 0.0));
}

TEST(TagPoseTest, BothPosesAreMinimaOfTheReprojectionError) {
  std::mt19937_64 rng = testing::TestRng();
  const Eigen::Isometry3d truth = View(25, 60, 10, {0.2, -0.1, 2.5});
  const Eigen::Matrix<double, 2, 4> corners_px = Noisy(Seen(truth), 0.1, &rng);
  const TagPoses found = FindTagPoses(Webcam(), corners_px, kSize_m);
  ASSERT_EQ(found.poses.size(), 2U);
  EXPECT_GT(Angle(found.poses[0].cam_from_tag, found.poses[1].cam_from_tag), 0.5);
  std::normal_distribution<double> unit;
  for (const TagPose& pose : found.poses) {
    const double error = (Seen(pose.cam_from_tag) - corners_px).squaredNorm();
    EXPECT_NEAR(std::sqrt(error / 8.0), pose.rms_px, 1e-12);
    for (int k = 0; k < 50; ++k) {
      Eigen::Isometry3d moved = pose.cam_from_tag;
      moved.translation() += 1e-5 * Eigen::Vector3d(unit(rng), unit(rng), unit(rng));
      moved.rotate(Eigen::AngleAxisd(
          1e-3 * unit(rng), Eigen::Vector3d(unit(rng), unit(rng), unit(rng)).normalized()));
      EXPECT_GT((Seen(moved) - corners_px).squaredNorm(), error);
    }
  }
}

TEST(TagPoseTest, TheCovarianceCoversTheErrors) {
  std::mt19937_64 rng = testing::TestRng();
  const TagPoseOptions options{.corner_sigma_px = 0.2};
  int num_inside = 0, num_views = 0;
  double sum = 0.0;
  for (int k = 0; k < 400; ++k) {
    const Eigen::Isometry3d truth = View(40 + k % 20, 17 * k, 29 * k, {0.1, 0.0, 0.6});
    const TagPoses found = FindTagPoses(Webcam(), Noisy(Seen(truth), 0.2, &rng), kSize_m, options);
    ASSERT_FALSE(found.poses.empty());
    const TagPose& pose = found.poses[0];
    const Eigen::AngleAxisd turn(pose.cam_from_tag.linear() * truth.linear().transpose());
    Eigen::Matrix<double, 6, 1> off;
    off << turn.angle() * turn.axis(), pose.cam_from_tag.translation() - truth.translation();
    const double squared = off.dot(pose.covariance.ldlt().solve(off));
    sum += squared;
    num_inside += squared < 12.592 ? 1 : 0;  // 95 % of chi squared with 6 degrees of freedom
    ++num_views;
  }
  EXPECT_NEAR(sum / num_views, 6.0, 0.8);
  EXPECT_NEAR(static_cast<double>(num_inside) / num_views, 0.95, 0.03);
}

TEST(TagPoseTest, FarAndNearlyFrontalTagsAreAmbiguousAndTiltedNearOnesAreNot) {
  std::mt19937_64 rng = testing::TestRng();
  for (int k = 0; k < 20; ++k) {
    const Eigen::Isometry3d far = View(12, 40 * k, 13 * k, {0.2, 0.1, 3.0});
    EXPECT_TRUE(FindTagPoses(Webcam(), Noisy(Seen(far), 0.1, &rng), kSize_m).is_ambiguous);
    const Eigen::Isometry3d near = View(45, 40 * k, 13 * k, {0.1, 0.0, 0.4});
    EXPECT_FALSE(FindTagPoses(Webcam(), Noisy(Seen(near), 0.1, &rng), kSize_m).is_ambiguous);
  }
}

TEST(TagPoseTest, EachHintChoosesTheRightOneOfTwo) {
  std::mt19937_64 rng = testing::TestRng();
  int num_two = 0, num_wrong_by_corners = 0;
  for (int k = 0; k < 60; ++k) {
    const Eigen::Isometry3d truth = View(30, 37 * k, 3 * k, {0.3, 0.1, 3.5});
    const TagPoses found =
        FindTagPoses(Webcam(), Noisy(Seen(truth), 0.3, &rng), kSize_m, {.corner_sigma_px = 0.3});
    if (found.poses.size() < 2) continue;
    ++num_two;
    const double angles[] = {Angle(found.poses[0].cam_from_tag, truth),
                             Angle(found.poses[1].cam_from_tag, truth)};
    const size_t right = angles[0] < angles[1] ? 0 : 1;
    num_wrong_by_corners += right == 1 ? 1 : 0;
    const TagPoseHints last{
        .last = TagPoseHints::Pose{View(33, 37 * k + 4, 3 * k - 2, {0.31, 0.1, 3.52})}};
    const TagPoseHints body{
        .body = TagPoseHints::Orientation{
            Eigen::Quaterniond(View(22, 37 * k + 15, 3 * k, {0, 0, 1}).linear()), 0.3}};
    const TagPoseHints gravity{
        .gravity = TagPoseHints::Gravity{
            (truth.linear() * Eigen::Vector3d(0.1, 1.0, 0.0)).normalized(), {0, 1, 0}, 0.1}};
    EXPECT_EQ(ChooseTagPose(found, last, {.corner_sigma_px = 0.3}).index, right) << k;
    EXPECT_EQ(ChooseTagPose(found, body, {.corner_sigma_px = 0.3}).index, right) << k;
    // Tilts about the vertical itself keep it: there gravity cannot tell, and says so.
    const TagPoseChoice hung = ChooseTagPose(found, gravity, {.corner_sigma_px = 0.3});
    EXPECT_TRUE(hung.index == right || hung.is_ambiguous) << k;
    EXPECT_FALSE(ChooseTagPose(found, last, {.corner_sigma_px = 0.3}).is_ambiguous) << k;
  }
  EXPECT_GT(num_two, 40);
  EXPECT_GT(num_wrong_by_corners, 5);  // else nothing was tested
}

TEST(TagPoseTest, CornersThatAreNoSquareGiveNoPose) {
  Eigen::Matrix<double, 2, 4> corners_px = Eigen::Matrix<double, 2, 4>::Constant(300.0);
  EXPECT_TRUE(FindTagPoses(Webcam(), corners_px, kSize_m).poses.empty());
  corners_px(0, 0) = std::nan("");
  EXPECT_TRUE(FindTagPoses(Webcam(), corners_px, kSize_m).poses.empty());
  EXPECT_THROW(ChooseTagPose({}, {}), std::invalid_argument);
  EXPECT_THROW(FindTagPoses(Webcam(), corners_px, 0.0), std::invalid_argument);
  EXPECT_THROW(FindTagPoses(Webcam(), corners_px, kSize_m, {.corner_sigma_px = 0.0}), InputError);
}

}  // namespace
}  // namespace poselift
