// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The cost functions on the made-up CMU skeleton at random poses: analytic
// Jacobians against central differences along the quaternion's manifold, residuals against their
// formulas written out.
#include "lift/ik/pose_costs.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <cmath>

#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/jacobian_check.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectJacobianAgrees;
using testing::MatrixNear;
using testing::RandomMatrix;
using testing::RandomPoseWithinLimits;
using testing::SomeRelations;
using testing::TestRng;
using testing::TrimmedCmuLikeSkeleton;

struct Blocks {
  SkeletonPose pose;
  Eigen::Vector3d camera;

  std::vector<double*> Pointers(size_t count) {
    std::vector<double*> all = {pose.root_in_world_m.data(), pose.world_from_root.coeffs().data(),
                                pose.dofs.data(), camera.data()};
    all.resize(count);
    return all;
  }
};

Blocks RandomBlocks(const Articulation& body, std::mt19937_64* rng) {
  return {RandomPoseWithinLimits(body.skeleton, 0.9, rng), {std::log(180.0), 310.0, 250.0}};
}

// Single joints and a sum of joints, with unequal weights.
std::vector<TargetPoint> SomePoints() {
  return {{{{joint::kLeftHand, 1.0}}, {0.3, -0.2, 0.9}, 2.0},
          {{{joint::kLeftHip, 0.5}, {joint::kRightHip, 0.5}}, {0.1, 0.4, -0.5}, 0.5},
          {{{joint::kRightFoot, 1.0}}, {-0.7, 0.8, 0.2}, 1.0},
          {{{joint::kUpperNeck, 0.4}, {joint::kHeadTop, 0.6}}, {0.0, -0.6, 0.3}, 3.0}};
}

// Two tags, turned and beside their bones, not where a pose has them.
std::vector<ObservedBonePose> SomeTags(std::mt19937_64* rng) {
  std::vector<ObservedBonePose> tags;
  for (const char* bone : {"lradius", "rtibia"}) {
    ObservedBonePose tag{.name = "tag", .bone = bone, .sigma_m = 0.7, .sigma_rad = 0.3};
    for (Eigen::Isometry3d* pose : {&tag.bone_from_tag, &tag.cam_from_tag}) {
      const Eigen::Vector3d turn_rad = 0.6 * RandomMatrix(3, 1, rng);
      pose->linear() = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
      pose->translation() = 0.2 * RandomMatrix(3, 1, rng);
    }
    tags.push_back(tag);
  }
  return tags;
}

// Where the pose has the tag.
Eigen::Isometry3d WorldFromTag(const Articulation& body, const SkeletonPose& pose,
                               const ObservedBonePose& tag) {
  BoneFrames frames;
  ForwardKinematics(body.skeleton, pose, &frames);
  const int bone = *body.skeleton.FindBone(tag.bone);
  return WorldFromBone(frames, bone) * tag.bone_from_tag;
}

void ExpectJacobiansAgree(const ceres::CostFunction& cost, Blocks blocks) {
  const std::vector<double*> pointers = blocks.Pointers(cost.parameter_block_sizes().size());
  for (size_t b = 0; b < pointers.size(); ++b) {
    if (b == 1)
      ExpectJacobianAgrees(cost, pointers, b, ceres::EigenQuaternionManifold());
    else
      ExpectJacobianAgrees(
          cost, pointers, b,
          ceres::EuclideanManifold<ceres::DYNAMIC>(cost.parameter_block_sizes()[b]));
  }
}

Eigen::VectorXd Residuals(const ceres::CostFunction& cost, Blocks blocks) {
  Eigen::VectorXd residuals(cost.num_residuals());
  cost.Evaluate(blocks.Pointers(cost.parameter_block_sizes().size()).data(), residuals.data(),
                nullptr);
  return residuals;
}

TEST(PoseCosts, JacobiansEqualDifferences) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  for (int trial = 0; trial < 3; ++trial) {
    const Blocks blocks = RandomBlocks(body, &rng);
    ExpectJacobiansAgree(*MakeSpaceCost(body, SomePoints(), false), blocks);
    ExpectJacobiansAgree(*MakeSpaceCost(body, SomePoints(), true), blocks);
    for (const bool up_to_translation : {false, true}) {
      ExpectJacobiansAgree(*MakeSpaceCost(body, {}, up_to_translation, SomeTags(&rng)), blocks);
      ExpectJacobiansAgree(*MakeSpaceCost(body, SomePoints(), up_to_translation, SomeTags(&rng)),
                           blocks);
    }
    ExpectJacobiansAgree(*MakeReprojectionCost(body, SomePoints()), blocks);
  }
}

TEST(PoseCosts, RelationResidualsAreThoseOfTheJoints) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const std::vector<JointRelation> relations = SomeRelations();
  Blocks blocks = RandomBlocks(body, &rng);
  const Eigen::VectorXd residuals = Residuals(*MakeRelationCost(body, relations), blocks);
  const Pose3 joints_m = JointPositions(body, blocks.pose);
  int num_held = 0;
  for (size_t i = 0; i < relations.size(); ++i) {
    const double expected = relations[i].Residual(joints_m);
    EXPECT_NEAR(residuals[static_cast<Eigen::Index>(i)], expected, 1e-12);
    num_held += expected == 0.0;
  }
  EXPECT_GT(num_held, 0);
  EXPECT_LT(num_held, std::ssize(relations));
}

TEST(PoseCosts, RelationJacobianEqualsDifferencesWhereBoundsHoldAndWhereNot) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  for (int trial = 0; trial < 3; ++trial)
    ExpectJacobiansAgree(*MakeRelationCost(body, SomeRelations()), RandomBlocks(body, &rng));
}

TEST(PoseCosts, SpringJacobianEqualsDifferencesInsideAndOutsideTheLimits) {
  const Articulation body(TrimmedCmuLikeSkeleton());
  DofSprings springs{.limits = DofLimits(body, true), .pull = 0.3, .stiffness = 7.0};
  springs.limits.lower = Eigen::Vector3d::Constant(-0.5);
  springs.limits.upper = Eigen::Vector3d::Constant(0.5);
  springs.rest = Eigen::Vector3d(0.1, 0.0, -0.2);
  const auto cost = MakeSpringCost(springs);
  Eigen::Vector3d dofs(0.2, 0.9, -0.8);
  const std::vector<double*> block = {dofs.data()};
  ExpectJacobianAgrees(*cost, block, 0, ceres::EuclideanManifold<3>());
  Eigen::Vector3d residuals;
  cost->Evaluate(block.data(), residuals.data(), nullptr);
  EXPECT_TRUE(MatrixNear(
      residuals, Eigen::Vector3d(0.3 * 0.1, 0.3 * 0.9 + 7 * 0.4, -0.3 * 0.6 - 7 * 0.3), 1e-14));
}

TEST(PoseCosts, PriorSeesTheJointsWithTheRootAtRest) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const PosePrior prior{RandomMatrix(69, 1, &rng), RandomMatrix(69, 69, &rng)};
  Blocks blocks = RandomBlocks(body, &rng);
  const auto cost = MakePriorCost(body, prior);
  const std::vector<double*> block = {blocks.pose.dofs.data()};
  ExpectJacobianAgrees(*cost, block, 0, ceres::EuclideanManifold<ceres::DYNAMIC>(body.num_dofs));
  Eigen::VectorXd residuals(69);
  cost->Evaluate(block.data(), residuals.data(), nullptr);
  const Pose3 in_body_m = JointPositions(body.skeleton, {.dofs = blocks.pose.dofs});
  EXPECT_TRUE(MatrixNear(residuals, prior.whitening * (Stacked(in_body_m) - prior.mean_m), 1e-12));
}

TEST(PoseCosts, SpaceResidualIsTheWeightedDifferenceOfTheSummedJoints) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const Blocks blocks = RandomBlocks(body, &rng);
  const Pose3 joints_m = JointPositions(body, blocks.pose);
  const Eigen::VectorXd residuals = Residuals(*MakeSpaceCost(body, SomePoints(), false), blocks);
  const Eigen::Vector3d mid_hip_m =
      0.5 * (joints_m.col(joint::kLeftHip) + joints_m.col(joint::kRightHip));
  EXPECT_TRUE(MatrixNear(residuals.segment<3>(3), 0.5 * (mid_hip_m - SomePoints()[1].x), 1e-14));
}

TEST(PoseCosts, TagResidualIsThePlaceAndTheRotationVectorOverTheirSigmas) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const Blocks blocks = RandomBlocks(body, &rng);
  ObservedBonePose tag = SomeTags(&rng)[0];
  tag.cam_from_tag = WorldFromTag(body, blocks.pose, tag);
  EXPECT_LT(Residuals(*MakeSpaceCost(body, {}, false, {tag}), blocks).norm(), 1e-12);
  const Eigen::Vector3d shift_m(0.01, -0.02, 0.03), turn_rad(0.5, 0.3, -0.2);
  tag.cam_from_tag.translation() -= shift_m;
  tag.cam_from_tag.linear() *=
      Eigen::AngleAxisd(-turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
  Eigen::VectorXd expected(6);
  expected << shift_m / tag.sigma_m, turn_rad / tag.sigma_rad;
  EXPECT_TRUE(
      MatrixNear(Residuals(*MakeSpaceCost(body, {}, false, {tag}), blocks), expected, 1e-12));
  // Behind the points, and without a common shift: as these alone, and the rotation.
  const Eigen::VectorXd all = Residuals(*MakeSpaceCost(body, SomePoints(), false, {tag}), blocks);
  EXPECT_TRUE(MatrixNear(all.tail(6), expected, 1e-12));
  const Eigen::VectorXd centred = Residuals(*MakeSpaceCost(body, {}, true, {tag}), blocks);
  EXPECT_LT(centred.head(3).norm(), 1e-12);
  EXPECT_TRUE(MatrixNear(centred.tail(3), expected.tail(3), 1e-12));
}

TEST(PoseCosts, TagsThatAreNoneAreRefused) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const ObservedBonePose good = SomeTags(&rng)[0];
  ObservedBonePose nowhere = good, sure = good, unknown = good;
  nowhere.bone = "wing";
  sure.sigma_rad = 0.0;
  unknown.cam_from_tag.translation().x() = std::nan("");
  for (const ObservedBonePose& bad : {nowhere, sure, unknown})
    EXPECT_THROW(MakeSpaceCost(body, {}, false, {good, bad}), std::invalid_argument);
}

TEST(PoseCosts, UpToTranslationIgnoresACommonShiftAndIsTheLeastOverShifts) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const Blocks blocks = RandomBlocks(body, &rng);
  std::vector<TargetPoint> shifted = SomePoints();
  for (TargetPoint& point : shifted) point.x += Eigen::Vector3d(3.0, -2.0, 5.0);
  const Eigen::VectorXd centred = Residuals(*MakeSpaceCost(body, SomePoints(), true), blocks);
  EXPECT_TRUE(MatrixNear(centred, Residuals(*MakeSpaceCost(body, shifted, true), blocks), 1e-12));
  // At the least over shifts, the weighted sum of the differences is zero.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < shifted.size(); ++i)
    sum += shifted[i].root_weight * centred.segment<3>(3 * i);
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST(PoseCosts, ReprojectionResidualIsTheWeakPerspectiveOne) {
  auto rng = TestRng();
  const Articulation body(TrimmedCmuLikeSkeleton());
  const Blocks blocks = RandomBlocks(body, &rng);
  const Pose3 joints_m = JointPositions(body, blocks.pose);
  const Eigen::VectorXd residuals = Residuals(*MakeReprojectionCost(body, SomePoints()), blocks);
  const Eigen::Vector2d hand_px =
      180.0 * joints_m.col(joint::kLeftHand).head<2>() + Eigen::Vector2d(310.0, 250.0);
  EXPECT_TRUE(
      MatrixNear(residuals.head<2>(), 2.0 * (hand_px - SomePoints()[0].x.head<2>()), 1e-10));
}

}  // namespace
}  // namespace poselift
