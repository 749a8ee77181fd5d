// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Tags on the made-up CMU skeleton before a camera: residuals against where the pose has
// the tags, Jacobians against central differences, the whitening against drawn mounts.
#include "lift/tracking/tag_cost.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <random>

#include "lift/body_proportions.h"
#include "src/forward_kinematics.h"
#include "src/level_camera.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/jacobian_check.h"
#include "tests/support/planted_pose.h"
#include "tests/support/random_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::ExpectJacobianAgrees;
using testing::RandomMatrix;
using testing::RandomPoseWithinLimits;

class TagCostTest : public ::testing::Test {
 protected:
  TagCostTest()
      : body_(testing::TrimmedCmuLikeSkeleton()),
        rng_(testing::TestRng()),
        pose_(RandomPoseWithinLimits(body_.skeleton, 0.5, &rng_)) {
    pose_.root_in_world_m = {0.2, -0.1, -3.0};
    tag_.bone = *body_.skeleton.FindBone("lradius");
    tag_.bone_from_tag = Eigen::Translation3d(0.05, -0.1, 0.02) *
                         Eigen::AngleAxisd(1.2, Eigen::Vector3d(1.0, -2.0, 0.5).normalized());
    tag_.size_m = 0.07;
    tag_.corners_px = ProjectTag(view_, CamFromTag(), tag_.size_m);
    tag_.whitening = 3.0 * Eigen::Matrix<double, 8, 8>::Identity() +
                     Eigen::Matrix<double, 8, 8>(RandomMatrix(8, 8, &rng_));
  }

  Eigen::Isometry3d CamFromTag() const {
    BoneFrames frames;
    ForwardKinematics(body_.skeleton, pose_, &frames);
    return view_.cam_from_world * WorldFromBone(frames, tag_.bone) * tag_.bone_from_tag;
  }

  std::vector<double*> Blocks() {
    return {pose_.root_in_world_m.data(), pose_.world_from_root.coeffs().data(), pose_.dofs.data()};
  }

  void ExpectPoseJacobians(const ceres::CostFunction& cost, const std::vector<double*>& blocks) {
    ExpectJacobianAgrees(cost, blocks, 0, ceres::EuclideanManifold<3>());
    ExpectJacobianAgrees(cost, blocks, 1, ceres::EigenQuaternionManifold());
    ExpectJacobianAgrees(cost, blocks, 2, ceres::EuclideanManifold<ceres::DYNAMIC>(body_.num_dofs));
  }

  Articulation body_;
  std::mt19937_64 rng_;
  SkeletonPose pose_;
  TagView view_{1.0, Eigen::Isometry3d(kLevelFromCam)};  // in focal lengths
  TagInPicture tag_;
};

TEST_F(TagCostTest, IsNoughtWhereThePoseHasTheTag) {
  const auto cost = MakeTagCost(body_, view_, tag_);
  Eigen::VectorXd residuals(8);
  ASSERT_TRUE(cost->Evaluate(Blocks().data(), residuals.data(), nullptr));
  EXPECT_LT(residuals.norm(), 1e-12);
  tag_.corners_px(0, 2) += 0.25;
  ASSERT_TRUE(
      MakeTagCost(body_, view_, tag_)->Evaluate(Blocks().data(), residuals.data(), nullptr));
  EXPECT_LT((residuals + 0.25 * tag_.whitening.col(4)).norm(), 1e-12);
}

TEST_F(TagCostTest, JacobiansAreThoseOfTheResiduals) {
  tag_.corners_px.array() += 0.01;
  ExpectPoseJacobians(*MakeTagCost(body_, view_, tag_), Blocks());
}

TEST_F(TagCostTest, JacobiansOfMountLengthsAndLensAreThoseOfTheResiduals) {
  tag_.corners_px.array() += 0.01;
  const auto cost = MakeTagFitCost(body_, view_, tag_);
  Eigen::Vector3d t = tag_.bone_from_tag.translation();
  Eigen::Quaterniond R(tag_.bone_from_tag.linear());
  GroupVector ratios = 0.1 * RandomMatrix(kNumBoneGroups, 1, &rng_);
  std::vector<double*> blocks = Blocks();
  LensVector lens(0.1, -0.2);
  blocks.insert(blocks.end(), {t.data(), R.coeffs().data(), ratios.data(), lens.data()});
  ExpectPoseJacobians(*cost, blocks);
  ExpectJacobianAgrees(*cost, blocks, 3, ceres::EuclideanManifold<3>());
  ExpectJacobianAgrees(*cost, blocks, 4, ceres::EigenQuaternionManifold());
  ExpectJacobianAgrees(*cost, blocks, 5, ceres::EuclideanManifold<kNumBoneGroups>());
  ExpectJacobianAgrees(*cost, blocks, 6, ceres::EuclideanManifold<2>());
}

TEST_F(TagCostTest, LengthsOfTheBonesBeforeTheTagMoveIt) {
  const auto cost = MakeTagFitCost(body_, view_, tag_);
  Eigen::Vector3d t = tag_.bone_from_tag.translation();
  Eigen::Quaterniond R(tag_.bone_from_tag.linear());
  GroupVector ratios = GroupVector::Zero();
  LensVector lens = LensVector::Zero();
  std::vector<double*> blocks = Blocks();
  blocks.insert(blocks.end(), {t.data(), R.coeffs().data(), ratios.data(), lens.data()});
  for (int g = 0; g < kNumBoneGroups; ++g) {
    ratios.setZero();
    ratios[g] = 0.2;
    Eigen::VectorXd residuals(8);
    ASSERT_TRUE(cost->Evaluate(blocks.data(), residuals.data(), nullptr));
    const std::string_view name = BoneGroupNames()[static_cast<size_t>(g)];
    const bool before = name == "trunk" || name == "shoulder" || name == "upper_arm";
    EXPECT_EQ(residuals.norm() > 1e-6, before) << name;
  }
}

TEST_F(TagCostTest, ATagBehindTheCameraCannotBeEvaluated) {
  pose_.root_in_world_m.z() = 3.0;
  Eigen::VectorXd residuals(8);
  EXPECT_FALSE(
      MakeTagCost(body_, view_, tag_)->Evaluate(Blocks().data(), residuals.data(), nullptr));
  EXPECT_FALSE(ProjectTag(view_, CamFromTag(), tag_.size_m).allFinite());
}

TEST_F(TagCostTest, WhitenedCornersOfLooseTagsAtGuessedDepthsHaveUnitVariance) {
  const TagView view{900.0, view_.cam_from_world};
  const Eigen::Isometry3d cam_from_tag = CamFromTag();
  constexpr double kSigma_px = 0.3, kSigma_m = 0.004, kSigma_rad = 0.03, kDepth = 0.02;
  const auto whitening =
      TagWhitening(view, cam_from_tag, tag_.size_m, {kSigma_px, kSigma_m, kSigma_rad, kDepth});
  const TagCorners mean_px = ProjectTag(view, cam_from_tag, tag_.size_m);
  constexpr int kDraws = 4000;
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Eigen::Vector3d(normal(rng_), normal(rng_), normal(rng_)); };
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Isometry3d moved = cam_from_tag;
    const Eigen::Vector3d turn = kSigma_rad * draw();
    moved = moved * Eigen::Translation3d(kSigma_m * draw()) *
            Eigen::AngleAxisd(turn.norm(), turn.normalized());
    Eigen::Matrix<double, 8, 1> off;
    Eigen::Map<TagCorners>(off.data()) = ProjectTag(view, moved, tag_.size_m) - mean_px;
    for (double& value : off) value += kSigma_px * normal(rng_);
    off += kDepth * normal(rng_) * Eigen::Map<const Eigen::Matrix<double, 8, 1>>(mean_px.data());
    const Eigen::Matrix<double, 8, 1> white = whitening * off;
    covariance += white * white.transpose() / kDraws;
  }
  EXPECT_LT((covariance - Eigen::Matrix<double, 8, 8>::Identity()).cwiseAbs().maxCoeff(), 0.15);
}

TEST_F(TagCostTest, APointInSpaceHasItsJacobians) {
  const PointInSpace point{
      tag_.bone, {0.1, -0.2, 0.05}, {0.3, 0.2, -2.5}, Eigen::Matrix3d(RandomMatrix(3, 3, &rng_))};
  ExpectPoseJacobians(*MakePointCost(body_, point), Blocks());
}

}  // namespace
}  // namespace poselift
