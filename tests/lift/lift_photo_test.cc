// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the sample pictures' labels and the dictionary that ships. Checked of a lift that goes on
// from a pose: it stays where that is the answer, follows labels that move in small steps, and from
// anywhere ends in a pose of the skeleton.
#include "lift/lift_photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lift/body_proportions.h"
#include "lift/dictionary_file.h"
#include "lift/normalize.h"
#include "src/io/camera_file.h"
#include "src/io/labels.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::SourcePath;

const Dictionary& TheDictionary() {
  static const Dictionary kDictionary = ReadDictionary(SourcePath("data/default.pldict"));
  return kDictionary;
}

const PhotoLifter& TheLifter() {
  static const PhotoLifter kLifter(TheDictionary());
  return kLifter;
}

PersonLabels SampleLabels(const std::string& name) {
  return ReadLabels(SourcePath("samples/photo/" + name + ".labels.json")).frames[0].people[0];
}

Observation Seen(const PersonLabels& labels) { return Observe(labels, *FindLayout("body15")); }

// On the bones of the skeleton, within limits.
void ExpectPossible(const LiftedPose& lifted) {
  ASSERT_TRUE(lifted.joints_in_cam_m.allFinite());
  const Skeleton& skeleton = TheDictionary().skeleton;
  const Eigen::VectorXd lengths_m = BoneLengths(skeleton);
  for (int j = 1; j < kNumJoints; ++j) {
    const int parent = Joints()[static_cast<size_t>(j)].parent;
    const auto bone_m = lifted.joints_in_cam_m.col(j) - lifted.joints_in_cam_m.col(parent);
    EXPECT_NEAR(bone_m.norm(), lengths_m[j], 1e-6);
  }
  Eigen::Index d = 0;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) {
      EXPECT_GE(lifted.pose.dofs[d], dof.lower - 1e-6) << bone.name;
      EXPECT_LE(lifted.pose.dofs[d++], dof.upper + 1e-6) << bone.name;
    }
}

double RmsDistance_m(const LiftedPose& a, const LiftedPose& b) {
  return (a.joints_in_cam_m - b.joints_in_cam_m).norm() / std::sqrt(kNumJoints);
}

class LiftPhotoFrom : public ::testing::TestWithParam<const char*> {
 protected:
  PersonLabels labels_ = SampleLabels(GetParam());
  LiftResult full_ = TheLifter().LiftPhoto(Seen(labels_));
};
INSTANTIATE_TEST_SUITE_P(Samples, LiftPhotoFrom, ::testing::Values("kick", "reach", "throw"),
                         [](const auto& sample) { return std::string(sample.param); });

TEST_P(LiftPhotoFrom, TheAnswerItselfStaysWhereItIs) {
  const LiftResult again = TheLifter().LiftPhotoFrom(Seen(labels_), full_.poses.front());
  ASSERT_TRUE(again.IsUsable());
  ASSERT_EQ(again.poses.size(), 1U);
  EXPECT_LT(RmsDistance_m(again.poses.front(), full_.poses.front()), 0.01);
  EXPECT_LT(again.poses.front().cost, 1.01 * full_.poses.front().cost);
}

TEST_P(LiftPhotoFrom, LabelsThatMoveInSmallStepsAreFollowed) {
  LiftedPose pose = full_.poses.front();
  for (int step = 0; step < 15; ++step) {
    labels_.landmarks[7].x_px += Eigen::Vector2d(-2.0, 1.0);
    const LiftResult next = TheLifter().LiftPhotoFrom(Seen(labels_), pose);
    ASSERT_TRUE(next.IsUsable());
    pose = next.poses.front();
    ExpectPossible(pose);
  }
  const LiftResult best = TheLifter().LiftPhoto(Seen(labels_));
  EXPECT_LT(pose.reprojection_rms_px, best.poses.front().reprojection_rms_px + 1.0);
  EXPECT_LT(pose.cost, 1.1 * best.poses.front().cost);
}

TEST_P(LiftPhotoFrom, AnyStartEndsInAPoseOfTheSkeleton) {
  for (const char* other : {"kick", "reach", "throw"}) {
    LiftedPose start = TheLifter().LiftPhoto(Seen(SampleLabels(other))).poses.back();
    start.code_tau_rad += Eigen::Vector3d(0.5, 2.5, -1.0);
    start.code_scale_px_per_m *= 20.0;
    const LiftResult lifted = TheLifter().LiftPhotoFrom(Seen(labels_), start);
    ASSERT_TRUE(lifted.IsUsable()) << other;
    ExpectPossible(lifted.poses.front());
  }
}

TEST_P(LiftPhotoFrom, AKnownCameraIsReckonedWith) {
  Observation seen = Seen(labels_);
  const std::string file = std::string("samples/photo/") + GetParam() + ".camera.yaml";
  const Camera camera = ReadCamera(SourcePath(file));
  seen.pinhole = Pinhole{camera.fx_px, {camera.cx_px, camera.cy_px}};
  const LiftedPose best = TheLifter().LiftPhoto(seen).poses.front();
  const LiftResult again = TheLifter().LiftPhotoFrom(seen, best);
  ASSERT_TRUE(again.IsUsable());
  EXPECT_LT(RmsDistance_m(again.poses.front(), best), 0.02);
  EXPECT_LT((again.poses.front().pelvis_in_cam_m - best.pelvis_in_cam_m).norm(), 0.1);
}

TEST_P(LiftPhotoFrom, APersonOfAnotherSizeKeepsIt) {
  Observation seen = Seen(labels_);
  seen.stature_m = 1.2;
  const LiftedPose best = TheLifter().LiftPhoto(seen).poses.front();
  const LiftResult again = TheLifter().LiftPhotoFrom(seen, best);
  EXPECT_EQ(again.poses.front().size, best.size);
  EXPECT_LT(RmsDistance_m(again.poses.front(), best), 0.01);
}

TEST_P(LiftPhotoFrom, AStartThatSaysTooLittleIsNone) {
  LiftedPose without_code = full_.poses.back(), without_picture = full_.poses.back();
  without_code.code = {};
  without_picture.camera.scale_px_per_m = 0.0;
  for (const LiftedPose& start : {without_code, without_picture}) {
    const LiftResult lifted = TheLifter().LiftPhotoFrom(Seen(labels_), start);
    ASSERT_EQ(lifted.poses.size(), full_.poses.size());
    EXPECT_EQ(lifted.poses.front().joints_in_cam_m, full_.poses.front().joints_in_cam_m);
  }
}

TEST_P(LiftPhotoFrom, WhatCannotBeLiftedIsSaid) {
  labels_.landmarks.resize(2);
  const LiftResult lifted = TheLifter().LiftPhotoFrom(Seen(labels_), full_.poses.front());
  EXPECT_EQ(lifted.status, LiftStatus::kCannotLift);
  EXPECT_TRUE(lifted.poses.empty());
}

}  // namespace
}  // namespace poselift
