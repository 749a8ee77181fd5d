// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/body_segments.h"

#include <algorithm>
#include <array>

#include "src/io/text_scanner.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr std::array kSegments = {
    BodySegment{"pelvis", "root"},
    BodySegment{"waist", "lowerback"},
    BodySegment{"belly", "upperback"},
    BodySegment{"chest", "thorax"},
    BodySegment{"neck", "lowerneck"},
    BodySegment{"head", "head"},
    BodySegment{"left_thigh", "lfemur"},
    BodySegment{"left_shin", "ltibia"},
    BodySegment{"left_foot", "lfoot"},
    BodySegment{"right_thigh", "rfemur"},
    BodySegment{"right_shin", "rtibia"},
    BodySegment{"right_foot", "rfoot"},
    BodySegment{"left_collar", "lclavicle"},
    BodySegment{"left_upper_arm", "lhumerus"},
    BodySegment{"left_forearm", "lradius"},
    BodySegment{"left_hand", "lwrist"},
    BodySegment{"right_collar", "rclavicle"},
    BodySegment{"right_upper_arm", "rhumerus"},
    BodySegment{"right_forearm", "rradius"},
    BodySegment{"right_hand", "rwrist"},
};

}  // namespace

std::span<const BodySegment> BodySegments() { return kSegments; }

std::optional<std::string> FindBodyBone(std::string_view name) {
  for (const BodySegment& segment : kSegments)
    if (segment.name == name) return std::string(segment.cmu_bone);
  for (const JointInfo& joint : Joints())
    if (EqualsIgnoringCase(joint.cmu_bone, name)) return std::string(joint.cmu_bone);
  return std::nullopt;
}

std::string SegmentName(std::string_view cmu_bone) {
  const auto* const found =
      std::find_if(kSegments.begin(), kSegments.end(),
                   [&](const BodySegment& segment) { return segment.cmu_bone == cmu_bone; });
  return std::string(found == kSegments.end() ? cmu_bone : found->name);
}

}  // namespace poselift
