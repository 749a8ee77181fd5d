// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "src/forward_kinematics.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/bvh.h"
#include "src/io/text_scanner.h"
#include "src/units.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {
namespace {

using Json = nlohmann::ordered_json;

// Whether one of the first lines begins with the word.
bool HasLine(std::string_view head, std::string_view word) {
  for (;;) {
    const size_t start = head.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return false;
    head.remove_prefix(start);
    if (EqualsIgnoringCase(head.substr(0, word.size()), word)) return true;
    head.remove_prefix(std::min(head.find('\n'), head.size()));
  }
}

Json Triple(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// The box around all joints and bone ends over all frames.
void AddExtent(const Motion& motion, Json* facts) {
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(HUGE_VAL);
  Eigen::Vector3d highest = -lowest;
  BoneFrames frames;
  for (const SkeletonPose& pose : motion.frames) {
    ForwardKinematics(motion.skeleton, pose, &frames);
    for (const Eigen::Matrix3Xd* points : {&frames.start_in_world_m, &frames.tip_in_world_m}) {
      lowest = lowest.cwiseMin(points->rowwise().minCoeff());
      highest = highest.cwiseMax(points->rowwise().maxCoeff());
    }
  }
  if (motion.frames.empty()) return;
  (*facts)["lowest_m"] = Triple(lowest);
  (*facts)["highest_m"] = Triple(highest);
}

void AddSkeleton(const Skeleton& skeleton, Json* facts) {
  const JointSites sites = FindJointSites(skeleton);
  int num_found = 0;
  for (const JointSite& site : sites) num_found += site.bone >= 0;
  (*facts)["bones"] = skeleton.bones.size();
  (*facts)["dofs"] = 6 + skeleton.NumDofs();
  (*facts)["known_joints"] = num_found;
  (*facts)["root"] = skeleton.bones[0].name;
}

Json DescribeMotion(const Motion& motion) {
  Json facts;
  AddSkeleton(motion.skeleton, &facts);
  facts["frames"] = motion.frames.size();
  facts["rate_hz"] = 1.0 / motion.frame_time_s;
  facts["duration_s"] = static_cast<double>(motion.frames.size()) * motion.frame_time_s;
  AddExtent(motion, &facts);
  return facts;
}

}  // namespace

bool IsBvh(const std::filesystem::path& path, std::string_view head) {
  return HasEnding(path, ".bvh") || HasLine(head, "HIERARCHY");
}

bool IsAsf(const std::filesystem::path& path, std::string_view head) {
  return HasEnding(path, ".asf") || HasLine(head, ":bonedata") ||
         (HasLine(head, ":root") && HasLine(head, ":units"));
}

bool IsAmc(const std::filesystem::path& path, std::string_view head) {
  return HasEnding(path, ".amc") || HasLine(head, ":FULLY-SPECIFIED");
}

Json DescribeBvh(const std::filesystem::path& path) {
  Json facts = DescribeMotion(ReadBvh(path));
  facts["units"] = "the file has no unit: cm assumed";
  return facts;
}

Json DescribeAmc(const std::filesystem::path& path) {
  const auto asf_path = FindAsfOf(path);
  const AsfSkeleton asf = ReadAsfSkeleton(asf_path);
  Json facts = DescribeMotion(ReadAmc(path, asf));
  facts["units"] = "the file has no rate: 120 Hz assumed";
  facts["metres_per_unit"] = asf.metres_per_unit;
  facts["skeleton"] = asf_path.string();
  return facts;
}

Json DescribeAsf(const std::filesystem::path& path) {
  const AsfSkeleton asf = ReadAsfSkeleton(path);
  Json facts;
  AddSkeleton(asf.skeleton, &facts);
  AddExtent({asf.skeleton, kCmuFrameTime_s, {SkeletonPose::Rest(asf.skeleton)}}, &facts);
  facts["units"] = asf.radians_per_unit == 1.0 ? "angles in radians" : "angles in degrees";
  facts["metres_per_unit"] = asf.metres_per_unit;
  return facts;
}

}  // namespace poselift::cli
