// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Random round cones and rays. Checked against the definition: a point is inside when a
// sphere of the axis holds it, which a fine walk along axis and ray decides.
#include "src/testing/round_cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/support.h"

namespace poselift::testing {
namespace {

using Eigen::Vector3d;

struct Planted {
  RoundCone cone;
  Eigen::Isometry3d cam_from_cone = Eigen::Isometry3d::Identity();
};

Planted Plant(std::mt19937_64* rng) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return Vector3d(unit(*rng), unit(*rng), unit(*rng)); };
  Planted planted;
  planted.cone = {0.2 * vector(), 0.2 * vector(), 0.06 + 0.05 * unit(*rng),
                  0.06 + 0.05 * unit(*rng), Vector3d::Ones() + 0.5 * vector()};
  planted.cam_from_cone.linear() =
      Eigen::AngleAxisd(3.0 * unit(*rng), vector().normalized()).matrix();
  planted.cam_from_cone.translation() = Vector3d(0.3 * unit(*rng), 0.3 * unit(*rng), 2.0);
  return planted;
}

// Least distance from the spheres of the axis, in the space that is not stretched:
// negative inside.
double Outside(const Planted& planted, const Vector3d& x_in_cam_m) {
  const RoundCone& cone = planted.cone;
  const Vector3d x =
      (planted.cam_from_cone.inverse() * x_in_cam_m - cone.start_m).cwiseQuotient(cone.stretch);
  const Vector3d axis = (cone.tip_m - cone.start_m).cwiseQuotient(cone.stretch);
  constexpr int kSpheres = 4000;
  double outside = 1e9;
  for (int i = 0; i <= kSpheres; ++i) {
    const double share = static_cast<double>(i) / kSpheres;
    const double radius = (1.0 - share) * cone.start_radius_m + share * cone.tip_radius_m;
    outside = std::min(outside, (x - share * axis).norm() - radius);
  }
  return outside;
}

Ray Towards(const Planted& planted) {
  const Vector3d middle_m =
      planted.cam_from_cone * Vector3d(0.5 * (planted.cone.start_m + planted.cone.tip_m));
  return (middle_m.head<2>() / middle_m.z()).cast<float>();
}

Vector3d At(const Ray& ray, double depth_m) { return depth_m * Vector3d(ray.x(), ray.y(), 1.0); }

TEST(SeenRoundConeTest, RaysEnterWhereTheSpheresOfTheAxisBegin) {
  auto rng = TestRng();
  std::uniform_real_distribution<float> beside(-0.08f, 0.08f);
  int met = 0;
  for (int k = 0; k < 300; ++k) {
    const Planted planted = Plant(&rng);
    const SeenRoundCone seen(planted.cone, planted.cam_from_cone);
    const Ray ray = Towards(planted) + Ray(beside(rng), beside(rng));
    const float depth_m = seen.Depth_m(ray);
    if (std::isfinite(depth_m)) {
      ++met;
      EXPECT_NEAR(Outside(planted, At(ray, depth_m)), 0.0, 5e-5);
      EXPECT_TRUE(seen.Box().contains(At(ray, depth_m)));
    }
    const double until_m = std::min<double>(depth_m - 1e-3, 4.0);
    for (double z = 1.0; z < until_m; z += 0.02) EXPECT_GT(Outside(planted, At(ray, z)), 0.0);
  }
  EXPECT_GT(met, 60);
  EXPECT_LT(met, 240);
}

TEST(SeenRoundConeTest, NormalsAreTheSlopeOfTheDistance) {
  auto rng = TestRng();
  constexpr double kStep_m = 1e-4;
  for (int k = 0; k < 60; ++k) {
    const Planted planted = Plant(&rng);
    const SeenRoundCone seen(planted.cone, planted.cam_from_cone);
    const Ray ray = Towards(planted);
    const float depth_m = seen.Depth_m(ray);
    ASSERT_TRUE(std::isfinite(depth_m));
    Vector3d slope;
    for (int i = 0; i < 3; ++i) {
      const Vector3d step = kStep_m * Vector3d::Unit(i);
      slope[i] =
          Outside(planted, At(ray, depth_m) + step) - Outside(planted, At(ray, depth_m) - step);
    }
    EXPECT_TRUE(MatrixNear(seen.Normal(ray, depth_m).cast<double>(), slope.normalized(), 2e-2));
  }
}

// Less steep than the side: through either end or the side itself.
TEST(SeenRoundConeTest, RaysAlongTheAxisEnterThroughWhatComesFirst) {
  const RoundCone cone{{0, 0, 0}, {0, 0, 0.3}, 0.02, 0.12};
  for (const double turn_rad : {0.0, 3.14159265}) {
    Planted planted{cone, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 2))};
    planted.cam_from_cone.rotate(Eigen::AngleAxisd(turn_rad, Vector3d::UnitX()));
    const SeenRoundCone seen(planted.cone, planted.cam_from_cone);
    for (const float x : {0.0f, 0.008f, 0.02f, 0.035f, 0.05f}) {
      const float depth_m = seen.Depth_m({x, 0});
      ASSERT_TRUE(std::isfinite(depth_m)) << turn_rad << " " << x;
      EXPECT_NEAR(Outside(planted, At({x, 0}, depth_m)), 0.0, 5e-5) << turn_rad << " " << x;
      EXPECT_GT(Outside(planted, At({x, 0}, depth_m - 2e-3)), 0.0) << turn_rad << " " << x;
    }
    EXPECT_TRUE(std::isinf(seen.Depth_m({0.08f, 0})));
  }
}

TEST(SeenRoundConeTest, OneSphereInsideTheOtherIsTheOther) {
  const Eigen::Isometry3d cam_from_cone(Eigen::Translation3d(0, 0, 2));
  for (const double tip_m : {0.0, 0.02}) {
    const RoundCone cone{{0, 0, 0}, {tip_m, 0, 0}, 0.1, 0.05};
    EXPECT_NEAR(SeenRoundCone(cone, cam_from_cone).Depth_m({0, 0}), 1.9, 1e-5);
    const RoundCone turned{{tip_m, 0, 0}, {0, 0, 0}, 0.05, 0.1};
    EXPECT_NEAR(SeenRoundCone(turned, cam_from_cone).Depth_m({0, 0}), 1.9, 1e-5);
    EXPECT_TRUE(std::isinf(SeenRoundCone(turned, cam_from_cone).Depth_m({0.06f, 0})));
  }
}

TEST(SeenRoundConeTest, WhatIsBehindTheEyeIsNotSeen) {
  const RoundCone cone{{0, 0, 0}, {0.1, 0, 0}, 0.1, 0.05};
  const Eigen::Isometry3d cam_from_cone(Eigen::Translation3d(0, 0, -2));
  EXPECT_TRUE(std::isinf(SeenRoundCone(cone, cam_from_cone).Depth_m({0, 0})));
}

}  // namespace
}  // namespace poselift::testing
