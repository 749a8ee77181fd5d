// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/depth_mirror.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "lift/rotation.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Kind = LabelHint::Kind;
using ::testing::IsEmpty;
using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;

Pose3 RandomPose(std::mt19937_64* rng) {
  Pose3 pose = 0.4 * RandomMatrix(3, kNumJoints, rng);
  pose.col(joint::kPelvis).setZero();
  return pose;
}

Pose3 AtDepths(Pose3 pose, const Eigen::VectorXd& depths_m) {
  pose.row(2) = depths_m.transpose();
  return pose;
}

std::vector<int> Unmet(const std::vector<LabelHint>& hints, const Pose3& pose) {
  return UnmetHints(RelationsOf(hints, *FindLayout("joints23")), pose);
}

TEST(DepthMirror, OfTheAnglesIsTheMirrorImageOfABodyThatIsMirroredFrontToBack) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d tau = RandomMatrix(3, 1, &rng);
    const Pose3 pose = RandomPose(&rng);
    Pose3 front_to_back = pose;
    front_to_back.row(2) *= -1.0;
    Pose3 mirrored = CamFromBody(tau) * pose;
    mirrored.row(2) *= -1.0;
    EXPECT_TRUE(MatrixNear(CamFromBody(MirroredInDepth(tau)) * front_to_back, mirrored, 1e-12));
  }
}

TEST(DepthMirror, AreOfTheLimbsThatBreakAHint) {
  std::mt19937_64 rng = TestRng();
  Pose3 pose = RandomPose(&rng);
  pose(2, joint::kLeftWrist) = pose(2, joint::kLeftElbow) + 0.2;
  const std::vector<LabelHint> hints = {{Kind::kTowardsCamera, "left_wrist"}};
  const auto mirrors = MirrorsInDepth(RelationsOf(hints, *FindLayout("joints23")), pose);
  ASSERT_EQ(mirrors.size(), 3u);
  for (const DepthMirror& mirror : mirrors) {
    const Pose3 mirrored = AtDepths(pose, mirror.depths_m);
    EXPECT_THAT(Unmet(hints, mirrored), IsEmpty());
    EXPECT_EQ(mirrored(2, joint::kPelvis), 0.0);
    EXPECT_EQ(mirrored(2, joint::kRightKnee) == pose(2, joint::kRightKnee), !mirror.whole_body);
  }
  EXPECT_EQ(mirrors[0].depths_m[joint::kLeftShoulder], pose(2, joint::kLeftShoulder));
  EXPECT_EQ(mirrors[1].depths_m[joint::kLeftElbow], pose(2, joint::kLeftElbow));
}

TEST(DepthMirror, IsNothingForAPoseThatMeetsAll) {
  std::mt19937_64 rng = TestRng();
  Pose3 pose = RandomPose(&rng);
  pose(2, joint::kLeftWrist) = pose(2, joint::kLeftElbow) - 0.2;
  const std::vector<LabelHint> hints = {{Kind::kTowardsCamera, "left_wrist"}};
  EXPECT_TRUE(MirrorsInDepth(RelationsOf(hints, *FindLayout("joints23")), pose).empty());
  EXPECT_TRUE(MirrorsInDepth({}, pose).empty());
}

TEST(HintsToFlip, AreMetByTheMirrorImageAndNotByThePose) {
  std::mt19937_64 rng = TestRng();
  for (const Limb limb : {Limb::kLeftLeg, Limb::kRightLeg, Limb::kLeftArm, Limb::kRightArm}) {
    const Pose3 pose = RandomPose(&rng);
    const auto hints = HintsToFlip(limb, pose);
    EXPECT_EQ(Unmet(hints, pose).size(), hints.size());
    Pose3 flipped = pose;
    flipped.row(2) *= -1.0;
    for (const LabelHint& hint : hints) EXPECT_EQ(hint.metres_m, std::nullopt);
    EXPECT_THAT(Unmet(hints, flipped), IsEmpty());
  }
}

TEST(HintsToFlip, AreNoneForALimbInThePicturesPlane) {
  EXPECT_TRUE(HintsToFlip(Limb::kLeftArm, Pose3::Zero(3, kNumJoints)).empty());
}

TEST(HintsToChoose, AreMetByTheOneAndNotByTheOther) {
  std::mt19937_64 rng = TestRng();
  for (int trial = 0; trial < 20; ++trial) {
    const Pose3 wanted = RandomPose(&rng);
    Pose3 other = RandomPose(&rng);
    const auto hints = HintsToChoose(wanted, other);
    EXPECT_THAT(Unmet(hints, wanted), IsEmpty());
    EXPECT_EQ(Unmet(hints, other).size(), hints.size());
  }
  const Pose3 pose = RandomPose(&rng);
  EXPECT_TRUE(HintsToChoose(pose, pose).empty());
}

}  // namespace
}  // namespace poselift
