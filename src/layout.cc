// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/layout.h"

namespace poselift {
namespace {

using namespace joint;  // NOLINT(google-build-using-namespace): the tables below

// Heads: the crown, head_top, is the end of the CMU head bone, about a hand's
// breadth below the real crown's hair; the ears sit beside its middle.
const std::vector<Landmark::Part> kMidHead = {{kUpperNeck, 0.4}, {kHeadTop, 0.6}};
// Wrists: CMU splits the forearm in two bones and its wrist joint, the end of
// the first, lies two thirds down the forearm. The wrist that people label is
// the end of the second, the joint "hand".
constexpr double kHalfHead_m = 0.07;  // an ear lies this far beside the middle of the head
constexpr double kToe_m = 0.03;
constexpr double kMidHip_m = 0.02;

Landmark Joint(std::string_view name, int joint) { return {name, {{joint, 1.0}}}; }
Landmark LeftOut(std::string_view name) { return {name, {}}; }
Landmark Ear(std::string_view name) { return {name, kMidHead, kHalfHead_m}; }
Landmark Neck(std::string_view name) {
  return {name, {{kLeftShoulder, 0.5}, {kRightShoulder, 0.5}}, kMidHip_m};
}
Landmark Foot(std::string_view name, int foot) { return {name, {{foot, 1.0}}, kToe_m}; }

Layout Body15() {
  return {"body15",
          {Joint("pelvis", kPelvis), Joint("neck", kThorax), Joint("head_top", kHeadTop),
           Joint("left_shoulder", kLeftShoulder), Joint("right_shoulder", kRightShoulder),
           Joint("left_elbow", kLeftElbow), Joint("right_elbow", kRightElbow),
           Joint("left_wrist", kLeftHand), Joint("right_wrist", kRightHand),
           Joint("left_hip", kLeftHip), Joint("right_hip", kRightHip),
           Joint("left_knee", kLeftKnee), Joint("right_knee", kRightKnee),
           Joint("left_ankle", kLeftAnkle), Joint("right_ankle", kRightAnkle)}};
}

Layout Coco17() {
  return {
      "coco17",
      {LeftOut("nose"), LeftOut("left_eye"), LeftOut("right_eye"), Ear("left_ear"),
       Ear("right_ear"), Joint("left_shoulder", kLeftShoulder),
       Joint("right_shoulder", kRightShoulder), Joint("left_elbow", kLeftElbow),
       Joint("right_elbow", kRightElbow), Joint("left_wrist", kLeftHand),
       Joint("right_wrist", kRightHand), Joint("left_hip", kLeftHip), Joint("right_hip", kRightHip),
       Joint("left_knee", kLeftKnee), Joint("right_knee", kRightKnee),
       Joint("left_ankle", kLeftAnkle), Joint("right_ankle", kRightAnkle)}};
}

Layout OpenPose25() {
  return {"openpose25",
          {LeftOut("nose"),
           Neck("neck"),
           Joint("right_shoulder", kRightShoulder),
           Joint("right_elbow", kRightElbow),
           Joint("right_wrist", kRightHand),
           Joint("left_shoulder", kLeftShoulder),
           Joint("left_elbow", kLeftElbow),
           Joint("left_wrist", kLeftHand),
           Landmark{"mid_hip", {{kLeftHip, 0.5}, {kRightHip, 0.5}}, kMidHip_m},
           Joint("right_hip", kRightHip),
           Joint("right_knee", kRightKnee),
           Joint("right_ankle", kRightAnkle),
           Joint("left_hip", kLeftHip),
           Joint("left_knee", kLeftKnee),
           Joint("left_ankle", kLeftAnkle),
           LeftOut("right_eye"),
           LeftOut("left_eye"),
           Ear("right_ear"),
           Ear("left_ear"),
           Foot("left_big_toe", kLeftFoot),
           Foot("left_small_toe", kLeftFoot),
           LeftOut("left_heel"),
           Foot("right_big_toe", kRightFoot),
           Foot("right_small_toe", kRightFoot),
           LeftOut("right_heel")}};
}

Layout OpenPose18() {
  return {
      "openpose18",
      {LeftOut("nose"), Neck("neck"), Joint("right_shoulder", kRightShoulder),
       Joint("right_elbow", kRightElbow), Joint("right_wrist", kRightHand),
       Joint("left_shoulder", kLeftShoulder), Joint("left_elbow", kLeftElbow),
       Joint("left_wrist", kLeftHand), Joint("right_hip", kRightHip),
       Joint("right_knee", kRightKnee), Joint("right_ankle", kRightAnkle),
       Joint("left_hip", kLeftHip), Joint("left_knee", kLeftKnee), Joint("left_ankle", kLeftAnkle),
       LeftOut("right_eye"), LeftOut("left_eye"), Ear("right_ear"), Ear("left_ear")}};
}

Layout Joints23() {
  Layout layout{"joints23", {}};
  for (int j = 0; j < kNumJoints; ++j) layout.landmarks.push_back(Joint(Joints()[j].name, j));
  return layout;
}

}  // namespace

std::optional<int> Layout::Find(std::string_view landmark) const {
  for (size_t i = 0; i < landmarks.size(); ++i)
    if (landmarks[i].name == landmark) return static_cast<int>(i);
  return std::nullopt;
}

const std::vector<Layout>& AllLayouts() {
  static const std::vector<Layout> kLayouts = {Body15(), Coco17(), OpenPose25(), OpenPose18(),
                                               Joints23()};
  return kLayouts;
}

const Layout* FindLayout(std::string_view name) {
  for (const Layout& layout : AllLayouts())
    if (layout.name == name) return &layout;
  return nullptr;
}

}  // namespace poselift
