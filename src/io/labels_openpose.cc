// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// OpenPose's JSON output (doc/02_output.md): people[].pose_keypoints_2d is
// x0 y0 c0 x1 ...; 0 0 0 is a point that was not found.
#include <fmt/core.h>

#include <algorithm>

#include "src/io/labels_formats.h"

namespace poselift {
namespace {

constexpr double kLargestScore = 10.0;  // heat maps overshoot 1 a little

const JsonValue* FindKeypoints(const JsonValue& person) {
  const JsonValue* keypoints = person.Find("pose_keypoints_2d");
  return keypoints ? keypoints : person.Find("pose_keypoints");  // version 1.0
}

// The layout by the number of values; BODY_25 has 75, COCO-18 54.
const Layout* LayoutOf(const JsonValue& keypoints, const Layout* layout) {
  const size_t count = keypoints.Items().size();
  if (!layout && count == 75) layout = FindLayout("openpose25");
  if (!layout && count == 54) layout = FindLayout("openpose18");
  if (!layout) throw keypoints.Unwanted("75 values (BODY_25) or 54 (COCO-18)");
  if (count != 3 * layout->landmarks.size())
    throw keypoints.Unwanted(
        fmt::format("{} values (layout {})", 3 * layout->landmarks.size(), layout->name));
  return layout;
}

PersonLabels ReadPerson(const JsonValue& keypoints, const Layout& layout, int id) {
  PersonLabels person{id, {}};
  const std::vector<JsonValue>& values = keypoints.Items();
  for (size_t k = 0; k < layout.landmarks.size(); ++k) {
    const auto coordinate = [&](size_t i) {
      return values[i].Number(-kLargestCoordinate_px, kLargestCoordinate_px);
    };
    const Eigen::Vector2d x_px(coordinate(3 * k), coordinate(3 * k + 1));
    const double score = values[3 * k + 2].Number(0.0, kLargestScore);
    person.landmarks.push_back(LandmarkFromScore(layout.landmarks[k].name, x_px, score));
  }
  return person;
}

}  // namespace

bool IsOpenPose(const JsonValue& root) {
  return root.Is(JsonValue::Kind::kObject) && root.Find("people");
}

FrameLabels ReadOpenPoseFrame(const JsonValue& root, const Layout** layout) {
  FrameLabels frame;
  const std::vector<JsonValue>& people = root.At("people").Items();
  for (size_t i = 0; i < people.size(); ++i) {
    const JsonValue* keypoints = FindKeypoints(people[i]);
    if (!keypoints)
      throw people[i].Error("found no \"pose_keypoints_2d\" or \"pose_keypoints\", wanted one");
    // A person known by hands or face alone has an empty body.
    if (keypoints->Items().empty()) continue;
    *layout = LayoutOf(*keypoints, *layout);
    frame.people.push_back(ReadPerson(*keypoints, **layout, static_cast<int>(i)));
  }
  return frame;
}

void RefuseRelativeScale(const Labels& labels, const std::string& file) {
  double largest = 0.0;
  bool any_negative = false, any = false;
  for (const FrameLabels& frame : labels.frames)
    for (const PersonLabels& person : frame.people)
      for (const LandmarkLabel& landmark : person.landmarks) {
        if (landmark.state == LabelState::kAbsent) continue;
        any = true;
        largest = std::max(largest, landmark.x_px.cwiseAbs().maxCoeff());
        any_negative = any_negative || landmark.x_px.minCoeff() < 0.0;
      }
  if (!any || largest > 1.0) return;
  throw InputError(file,
                   fmt::format("found all coordinates between {} and 1 (--keypoint_scale {}), "
                               "wanted pixels; let OpenPose write them with --keypoint_scale 0",
                               any_negative ? -1 : 0, any_negative ? 4 : 3));
}

}  // namespace poselift
