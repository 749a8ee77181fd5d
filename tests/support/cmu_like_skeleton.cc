// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/cmu_like_skeleton.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "src/units.h"

namespace poselift::testing {
namespace {

struct Limits {
  Dof::Kind kind;
  double lower_deg, upper_deg;
};

// A bone of the left side or the midline; the parent is named without its side.
struct Row {
  const char* name;
  const char* parent;
  Eigen::Vector3d direction;
  double length_m;
  Eigen::Vector3d axis_deg;
  std::vector<Limits> dofs;
};

constexpr auto kRx = Dof::Kind::kRx, kRy = Dof::Kind::kRy, kRz = Dof::Kind::kRz;

Eigen::Matrix3d RotationFromAxisAngles(const Eigen::Vector3d& axis_deg) {
  const Eigen::Vector3d a = kRadFromDeg * axis_deg;
  return (Eigen::AngleAxisd(a.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(a.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(a.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

const std::vector<Row>& SpineRows() {
  const std::vector<Limits> bends = {{kRx, -20, 45}, {kRy, -30, 30}, {kRz, -30, 30}};
  static const std::vector<Row> kRows = {
      {"lowerback", "root", {0, 1, -0.07}, 0.125, {0, 0, 0}, bends},
      {"upperback", "lowerback", {0, 1, -0.03}, 0.125, {0, 0, 0}, bends},
      {"thorax", "upperback", {0, 1, 0}, 0.13, {0, 0, 0}, bends},
      {"lowerneck", "thorax", {0, 1, 0.1}, 0.10, {0, 0, 0}, bends},
      {"upperneck", "lowerneck", {0, 1, -0.06}, 0.10, {0, 0, 0}, bends},
      {"head", "upperneck", {0, 1, -0.03}, 0.17, {0, 0, 0}, bends},
  };
  return kRows;
}

const std::vector<Row>& LegRows() {
  const double s = std::sin(20 * kRadFromDeg), c = std::cos(20 * kRadFromDeg);
  static const std::vector<Row> kRows = {
      {"hipjoint", "root", {0.65, -0.72, 0.25}, 0.14, {0, 0, 0}, {}},
      {"femur",
       "hipjoint",
       {s, -c, 0},
       0.43,
       {0, 0, 20},
       {{kRx, -160, 20}, {kRy, -70, 70}, {kRz, -60, 70}}},
      {"tibia", "femur", {s, -c, 0}, 0.42, {0, 0, 20}, {{kRx, -10, 170}}},
      {"foot",
       "tibia",
       {0.26 * s, -0.26 * c, 0.966},
       0.13,
       {-90, 0, 20},
       {{kRx, -45, 90}, {kRz, -70, 20}}},
      {"toes", "foot", {0, 0, 1}, 0.06, {-90, 0, 20}, {{kRx, -90, 20}}},
  };
  return kRows;
}

const std::vector<Row>& ArmRows() {
  static const std::vector<Row> kRows = {
      {"clavicle", "thorax", {0.97, 0.23, -0.06}, 0.20, {0, 0, 0}, {{kRy, -20, 10}, {kRz, 0, 20}}},
      {"humerus",
       "clavicle",
       {1, 0, 0},
       0.28,
       {180, -30, -90},
       {{kRx, -60, 90}, {kRy, -90, 90}, {kRz, -90, 90}}},
      {"radius", "humerus", {1, 0, 0}, 0.20, {180, -30, -90}, {{kRx, -10, 170}}},
      {"wrist", "radius", {1, 0, 0}, 0.10, {0, 90, 90}, {{kRy, -180, 0}}},
      {"hand", "wrist", {1, 0, 0}, 0.04, {0, 90, 90}, {{kRx, -90, 90}, {kRz, -45, 45}}},
      {"fingers", "hand", {1, 0, 0}, 0.03, {0, 90, 90}, {{kRx, 0, 90}}},
      {"thumb",
       "wrist",
       {0.7071, 0, 0.7071},
       0.045,
       {-90, 45, 0},
       {{kRx, -45, 45}, {kRz, -45, 45}}},
  };
  return kRows;
}

// Mirroring x keeps the sense of turning about x and changes that about y, z.
Limits Mirrored(const Limits& limits) {
  if (limits.kind == kRx) return limits;
  return {limits.kind, -limits.upper_deg, -limits.lower_deg};
}

void AddBone(const Row& row, const std::string& side, Skeleton* skeleton) {
  const bool right = side == "r";
  const Eigen::Vector3d mirror(right ? -1 : 1, 1, 1);
  Bone bone;
  bone.name = side + row.name;
  auto parent = skeleton->FindBone(side + row.parent);
  if (!parent) parent = skeleton->FindBone(row.parent);
  bone.parent = parent.value();
  bone.offset_m = skeleton->bones[bone.parent].tip_m;
  bone.tip_m = row.length_m * mirror.cwiseProduct(row.direction.normalized());
  const Eigen::Vector3d axis_mirror(1, right ? -1 : 1, right ? -1 : 1);
  bone.rest_from_axis = RotationFromAxisAngles(axis_mirror.cwiseProduct(row.axis_deg));
  for (const Limits& of_left : row.dofs) {
    const Limits limits = right ? Mirrored(of_left) : of_left;
    bone.dofs.push_back(
        {limits.kind, kRadFromDeg * limits.lower_deg, kRadFromDeg * limits.upper_deg});
  }
  skeleton->bones.push_back(std::move(bone));
}

std::string OtherSide(const std::string& bone) {
  static const std::vector<std::string> kMidline = {"root",      "lowerback", "upperback", "thorax",
                                                    "lowerneck", "upperneck", "head"};
  for (const std::string& name : kMidline)
    if (bone == name) return bone;
  std::string other = bone;
  other[0] = bone[0] == 'l' ? 'r' : 'l';
  return other;
}

}  // namespace

Skeleton CmuLikeSkeleton() {
  Skeleton skeleton;
  skeleton.name = "cmu_like";
  skeleton.bones.push_back({.name = "root"});
  for (const Row& row : LegRows()) AddBone(row, "l", &skeleton);
  for (const Row& row : LegRows()) AddBone(row, "r", &skeleton);
  for (const Row& row : SpineRows()) AddBone(row, "", &skeleton);
  for (const Row& row : ArmRows()) AddBone(row, "l", &skeleton);
  for (const Row& row : ArmRows()) AddBone(row, "r", &skeleton);
  return skeleton;
}

Skeleton TrimmedCmuLikeSkeleton() { return TrimToJoints(CmuLikeSkeleton()); }

SkeletonPose MirroredPose(const Skeleton& skeleton, const SkeletonPose& pose) {
  SkeletonPose mirrored = pose;
  mirrored.root_in_world_m.x() *= -1;
  mirrored.world_from_root.y() *= -1;
  mirrored.world_from_root.z() *= -1;
  const std::vector<int> starts = skeleton.DofStarts();
  for (size_t b = 0; b < skeleton.bones.size(); ++b) {
    const Bone& bone = skeleton.bones[b];
    const int other = skeleton.FindBone(OtherSide(bone.name)).value();
    for (size_t i = 0; i < bone.dofs.size(); ++i) {
      const double sign = bone.dofs[i].kind == kRx ? 1 : -1;
      mirrored.dofs[starts[other] + static_cast<int>(i)] =
          sign * pose.dofs[starts[b] + static_cast<int>(i)];
    }
  }
  return mirrored;
}

double& DofOf(const Skeleton& skeleton, std::string_view bone, Dof::Kind kind, SkeletonPose* pose) {
  const int b = skeleton.FindBone(bone).value();
  const std::vector<Dof>& dofs = skeleton.bones[b].dofs;
  for (size_t i = 0; i < dofs.size(); ++i)
    if (dofs[i].kind == kind) return pose->dofs[skeleton.DofStarts()[b] + static_cast<int>(i)];
  throw std::logic_error("no such dof: " + std::string(bone));
}

}  // namespace poselift::testing
