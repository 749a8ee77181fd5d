// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/body_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "src/forward_kinematics.h"

namespace poselift {
namespace {

// Bones of the body, by the joint at their end.
constexpr std::array kNeededBones = {joint::kLeftKnee,   joint::kLeftAnkle, joint::kRightKnee,
                                     joint::kRightAnkle, joint::kLeftElbow, joint::kLeftWrist,
                                     joint::kRightElbow, joint::kRightWrist};
constexpr std::array kOtherBones = {joint::kLeftFoot, joint::kRightFoot, joint::kLeftHand,
                                    joint::kRightHand};
// With the bone that each begins on.
constexpr std::array kTrunk = {joint::kPelvis, joint::kLowerBack, joint::kUpperBack,
                               joint::kThorax};
constexpr std::array kNeck = {joint::kThorax, joint::kLowerNeck, joint::kUpperNeck,
                              joint::kHeadTop};

// Legs that stand are within 60 degrees of straight down.
constexpr double kLeastDown = 0.5;

// The source's bone that ends at a joint of the body, or -1.
int FindBoneTo(const JointSites& sites, int joint) {
  if (sites[joint].bone >= 0 && sites[joint].at_tip) return sites[joint].bone;
  const JointSite& start = sites[Joints()[joint].parent];
  return start.at_tip ? -1 : start.bone;
}

// The bone, its parent, ... and the root.
std::vector<int> WayToRoot(const Skeleton& skeleton, int bone) {
  std::vector<int> way;
  for (int b = bone; b >= 0; b = skeleton.bones[b].parent) way.push_back(b);
  return way;
}

// The last bone that carries both.
int FindCarrier(const Skeleton& skeleton, int a, int b) {
  const std::vector<int> of_a = WayToRoot(skeleton, a);
  for (const int bone : WayToRoot(skeleton, b))
    if (std::find(of_a.begin(), of_a.end(), bone) != of_a.end()) return bone;
  return 0;
}

// From a bone to one behind it, both among them; empty when it is not behind it.
std::vector<int> ChainTo(const Skeleton& skeleton, int from, int to) {
  std::vector<int> way = WayToRoot(skeleton, to);
  const auto found = std::find(way.begin(), way.end(), from);
  if (found == way.end()) return {};
  way.erase(found + 1, way.end());
  return {way.rbegin(), way.rend()};
}

// Where the k-th of `count` steps along one chain is on another.
BodyMap::Between PlaceOn(std::span<const int> chain, int k, int count) {
  const int steps = static_cast<int>(chain.size()) - 1;
  const int before = k * steps / count;
  const int rest = k * steps % count;
  return {chain[before], chain[rest == 0 ? before : before + 1], static_cast<double>(rest) / count};
}

void MapChain(std::span<const int> body, std::span<const int> source, BodyMap* map) {
  const int num_body = static_cast<int>(body.size()) - 1;
  const int num_source = static_cast<int>(source.size()) - 1;
  for (int k = 1; k <= num_body; ++k) map->source_of_body[body[k]] = PlaceOn(source, k, num_body);
  for (int k = 1; k <= num_source; ++k)
    map->body_of_source[source[k]] = PlaceOn(body, k, num_source);
}

void MapBone(int body, int source, BodyMap* map) {
  map->source_of_body[body] = {source, source};
  map->body_of_source[source] = {body, body};
}

std::string MissingJoints(const JointSites& sites) {
  std::string missing;
  for (const int joint : kNeededBones)
    if (FindBoneTo(sites, joint) < 0)
      missing.append(missing.empty() ? "" : ", ").append(Joints()[Joints()[joint].parent].name);
  return missing;
}

Eigen::Vector3d NearestAxis(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return std::copysign(1.0, direction[axis]) * Eigen::Vector3d::Unit(axis);
}

// A bone with two rotations about one axis, which no orientation tells apart.
const Bone* FindDoubleAxis(const Skeleton& source) {
  for (const Bone& bone : source.bones)
    for (size_t i = 0; i < bone.dofs.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (bone.dofs[i].IsRotation() && bone.dofs[j].kind == bone.dofs[i].kind) return &bone;
  return nullptr;
}

// Whether the source stands at rest; then its axes are the map's.
bool FindAxes(const Skeleton& source, BodyMap* map) {
  BoneFrames rest;
  ForwardKinematics(source, SkeletonPose::Rest(source), &rest);
  const auto start_m = [&](int joint) -> Eigen::Vector3d {
    return rest.start_in_world_m.col(map->source_of_body[joint].from);
  };
  const Eigen::Vector3d left_hip_m = start_m(joint::kLeftKnee);
  const Eigen::Vector3d right_hip_m = start_m(joint::kRightKnee);
  const Eigen::Vector3d left_shoulder_m = start_m(joint::kLeftElbow);
  const Eigen::Vector3d right_shoulder_m = start_m(joint::kRightElbow);
  const Eigen::Vector3d up =
      NearestAxis(left_shoulder_m + right_shoulder_m - left_hip_m - right_hip_m);
  const Eigen::Vector3d to_left = left_shoulder_m - right_shoulder_m + left_hip_m - right_hip_m;
  const Eigen::Vector3d left = NearestAxis(to_left - up.dot(to_left) * up);
  if (left.cross(up).isZero()) return false;
  map->body_from_source << left.transpose(), up.transpose(), left.cross(up).transpose();
  for (const int joint : {joint::kLeftKnee, joint::kRightKnee}) {
    const Eigen::Vector3d thigh_m = start_m(joint + 1) - start_m(joint);
    const Eigen::Vector3d& shank_m = source.bones[map->source_of_body[joint + 1].from].tip_m;
    for (const Eigen::Vector3d& bone_m : {thigh_m, shank_m})
      if (!(-up.dot(bone_m) > kLeastDown * bone_m.norm())) return false;
  }
  return true;
}

}  // namespace

BodyMap FindBody(const Skeleton& source) {
  const JointSites sites = FindJointSites(source);
  BodyMap map;
  map.body_of_source.resize(source.bones.size());
  if (const std::string missing = MissingJoints(sites); !missing.empty()) {
    map.flaw = "found no bone for " + missing;
    return map;
  }
  for (const int joint : kNeededBones) MapBone(joint, FindBoneTo(sites, joint), &map);
  for (const int joint : kOtherBones)
    if (const int bone = FindBoneTo(sites, joint); bone >= 0) MapBone(joint, bone, &map);

  const auto bone_to = [&](int joint) { return map.source_of_body[joint].from; };
  map.pelvis = FindCarrier(source, bone_to(joint::kLeftKnee), bone_to(joint::kRightKnee));
  const int chest = FindCarrier(source, bone_to(joint::kLeftElbow), bone_to(joint::kRightElbow));
  const int trunk = FindCarrier(source, map.pelvis, chest);
  MapChain(kTrunk, ChainTo(source, trunk, chest), &map);
  const int head = FindBoneTo(sites, joint::kHeadTop);
  if (const std::vector<int> neck = ChainTo(source, chest, head); neck.size() > 1)
    MapChain(kNeck, neck, &map);
  MapBone(joint::kPelvis, map.pelvis, &map);
  if (const Bone* bone = FindDoubleAxis(source)) {
    map.flaw = "found that the bone " + bone->name + " turns twice about the same axis";
    return map;
  }
  if (!FindAxes(source, &map)) map.flaw = "found a rest pose that does not stand on its legs";
  return map;
}

}  // namespace poselift
