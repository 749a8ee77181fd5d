// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/layout.h"

#include "src/translated.h"

namespace poselift {
namespace {

using namespace joint;  // NOLINT(google-build-using-namespace): the tables below

// People label anatomy; the joints of the CMU skeleton lie elsewhere in places.
// Measured on the standard skeleton against a body of its size (1.75 m):
//  - its wrist joint is the end of the first of two forearm bones, two thirds
//    down; the wrist is the end of the second, the joint "hand";
//  - its thorax ends 5 cm below the shoulder joints; the base of the neck,
//    between the collar bones, lies 3 cm above them, on the lowerneck bone;
//  - its head bone ends in the middle of the head, 9 cm below the crown, as long
//    again as the bone; the ears are a little below its end, to either side.
const std::vector<Landmark::Part> kNeckBase = {{kThorax, 0.2}, {kLowerNeck, 0.8}};
const std::vector<Landmark::Part> kCrown = {{kUpperNeck, -0.9}, {kHeadTop, 1.9}};
// An ear stands out along the line of the shoulders, unless the head is turned.
constexpr double kEarOut = 0.19;  // of the shoulders' distance
constexpr double kEarSigma_m = 0.05;
constexpr double kToeSigma_m = 0.03;
constexpr double kMiddleSigma_m = 0.02;  // of a point between two joints

Landmark Joint(std::string_view name, int joint) { return {name, {{joint, 1.0}}}; }
Landmark LeftOut(std::string_view name) { return {name, {}}; }
Landmark Ear(std::string_view name, int near_shoulder, int far_shoulder) {
  return {name,
          {{kUpperNeck, 0.3}, {kHeadTop, 0.7}, {near_shoulder, kEarOut}, {far_shoulder, -kEarOut}},
          kEarSigma_m};
}
Landmark Neck(std::string_view name) {
  return {name, {{kLeftShoulder, 0.5}, {kRightShoulder, 0.5}}, kMiddleSigma_m};
}
Landmark Foot(std::string_view name, int foot) { return {name, {{foot, 1.0}}, kToeSigma_m}; }

Layout Body15() {
  return {"body15",
          {Joint("pelvis", kPelvis), Landmark{"neck", kNeckBase, kMiddleSigma_m},
           Landmark{ToTranslate("head_top"), kCrown, kMiddleSigma_m},
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
      {LeftOut("nose"), LeftOut("left_eye"), LeftOut("right_eye"),
       Ear("left_ear", kLeftShoulder, kRightShoulder),
       Ear("right_ear", kRightShoulder, kLeftShoulder), Joint("left_shoulder", kLeftShoulder),
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
           Landmark{ToTranslate("mid_hip"), {{kLeftHip, 0.5}, {kRightHip, 0.5}}, kMiddleSigma_m},
           Joint("right_hip", kRightHip),
           Joint("right_knee", kRightKnee),
           Joint("right_ankle", kRightAnkle),
           Joint("left_hip", kLeftHip),
           Joint("left_knee", kLeftKnee),
           Joint("left_ankle", kLeftAnkle),
           LeftOut("right_eye"),
           LeftOut("left_eye"),
           Ear("right_ear", kRightShoulder, kLeftShoulder),
           Ear("left_ear", kLeftShoulder, kRightShoulder),
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
       LeftOut("right_eye"), LeftOut("left_eye"), Ear("right_ear", kRightShoulder, kLeftShoulder),
       Ear("left_ear", kLeftShoulder, kRightShoulder)}};
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
