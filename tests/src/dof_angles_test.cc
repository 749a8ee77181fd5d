// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Angles from rotations, checked by making the rotation again: every order and
// subset of axes, gimbal lock, and curves over time.
#include "src/dof_angles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::TestRng;

// All orders of all subsets of the three axes.
std::vector<std::vector<Dof>> AllDofLists() {
  std::vector<std::vector<Dof>> lists;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int count = 0; count <= 3; ++count) {
      std::vector<Dof> dofs;
      for (int i = 0; i < count; ++i) dofs.push_back({static_cast<Dof::Kind>(order[i])});
      lists.push_back(dofs);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return lists;
}

TEST(FitDofAngles, MakesTheRotationAgainForEveryDofList) {
  auto rng = TestRng();
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  for (const auto& dofs : AllDofLists())
    for (int trial = 0; trial < 20; ++trial) {
      const double truth[3] = {angle(rng), angle(rng), angle(rng)};
      const Eigen::Matrix3d rotation = RotationOfDofs(dofs, truth);
      double found[3] = {};
      EXPECT_LT(FitDofAngles(rotation, dofs, found), 1e-14);
      double near[3] = {truth[0] + 0.1, truth[1] - 0.1, truth[2] + 0.1};
      FitDofAngles(rotation, dofs, near);
      for (size_t i = 0; i < dofs.size(); ++i)
        if (dofs.size() < 3 || std::abs(std::cos(truth[1])) > 0.3) {
          EXPECT_NEAR(near[i], truth[i], 1e-13);
        }
    }
}

TEST(FitDofAngles, ExpressesGimbalLockAndItsSurroundings) {
  const std::vector<Dof> xyz = {{Dof::Kind::kRx}, {Dof::Kind::kRy}, {Dof::Kind::kRz}};
  for (const double off : {0.0, 1e-16, 1e-12, 1e-9, 1e-8, 1e-7, 1e-4})
    for (const double side : {-1.0, 1.0}) {
      const double truth[3] = {0.4, side * (std::numbers::pi / 2 - off), -1.2};
      double found[3] = {0.3, 0.0, 0.0};
      EXPECT_LT(FitDofAngles(RotationOfDofs(xyz, truth), xyz, found), 1e-8) << off;
    }
}

TEST(FitDofAngles, FollowsACurveThroughWholeTurnsAndBothBranches) {
  const std::vector<Dof> zxy = {{Dof::Kind::kRy}, {Dof::Kind::kRx}, {Dof::Kind::kRz}};
  double found[3] = {};
  for (int f = 0; f < 2000; ++f) {
    const double truth[3] = {0.01 * f, 0.9 * std::sin(0.02 * f), -0.02 * f};
    FitDofAngles(RotationOfDofs(zxy, truth), zxy, found);
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(found[i], truth[i], 1e-12) << "frame " << f;
  }
}

TEST(FitDofAngles, ComesCloserThanAnyNeighbourWhereDofsAreMissing) {
  auto rng = TestRng();
  std::normal_distribution<double> normal;
  for (const auto& dofs : AllDofLists())
    for (int trial = 0; trial < 10 && dofs.size() < 3; ++trial) {
      const Eigen::Matrix3d rotation =
          Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng))
              .normalized()
              .toRotationMatrix();
      double found[3] = {};
      const double error = FitDofAngles(rotation, dofs, found);
      EXPECT_NEAR(error, AngleBetween(rotation, RotationOfDofs(dofs, found)), 1e-12);
      for (size_t i = 0; i < dofs.size(); ++i)
        for (const double step : {-1e-3, 1e-3}) {
          double moved[3] = {found[0], found[1], found[2]};
          moved[i] += step;
          EXPECT_LE(error, AngleBetween(rotation, RotationOfDofs(dofs, moved)) + 1e-12);
        }
    }
}

TEST(FitDofAngles, LeavesShiftsAlone) {
  const std::vector<Dof> dofs = {{Dof::Kind::kTx}, {Dof::Kind::kRy}};
  double values[2] = {7.0, 0.0};
  const double truth[2] = {0.0, 1.0};
  FitDofAngles(RotationOfDofs(dofs, truth), dofs, values);
  EXPECT_EQ(values[0], 7.0);
  EXPECT_NEAR(values[1], 1.0, 1e-15);
}

TEST(FitDofAngles, RefusesTwoDofsAboutOneAxis) {
  const std::vector<Dof> dofs = {{Dof::Kind::kRx}, {Dof::Kind::kRx}};
  double values[2] = {};
  EXPECT_THROW(FitDofAngles(Eigen::Matrix3d::Identity(), dofs, values), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
