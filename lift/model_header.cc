// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/model_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace poselift {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kDofKinds = {"rx", "ry", "rz", "tx", "ty", "tz"};
constexpr double kLargestExactWhole = 9007199254740992.0;  // 2^53

Json ToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// JSON has no infinity: null says that there is no limit.
Json LimitToJson(double limit) { return std::isfinite(limit) ? Json(limit) : Json(nullptr); }

Json ToJson(const Bone& bone) {
  Json dofs = Json::array();
  for (const Dof& dof : bone.dofs)
    dofs.push_back({{"kind", kDofKinds[static_cast<size_t>(dof.kind)]},
                    {"lower", LimitToJson(dof.lower)},
                    {"upper", LimitToJson(dof.upper)}});
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(ToJson(bone.rest_from_axis.row(i).transpose()));
  return {{"name", bone.name},
          {"parent", bone.parent},
          {"offset_m", ToJson(bone.offset_m)},
          {"tip_m", ToJson(bone.tip_m)},
          {"rest_from_axis", std::move(rows)},
          {"dofs", std::move(dofs)}};
}

Eigen::Vector3d ReadVector3(const JsonValue& value) {
  const auto& items = ReadItems(value, 3, "a list of 3 numbers");
  return {items[0].Number(), items[1].Number(), items[2].Number()};
}

Dof ReadDof(const JsonValue& value) {
  const JsonValue& kind = value.At("kind");
  Dof dof;
  const auto found = std::find(kDofKinds.begin(), kDofKinds.end(), kind.String());
  if (found == kDofKinds.end()) throw kind.Unwanted("rx, ry, rz, tx, ty or tz");
  dof.kind = static_cast<Dof::Kind>(found - kDofKinds.begin());
  if (const JsonValue* lower = value.Find("lower")) dof.lower = lower->Number();
  if (const JsonValue* upper = value.Find("upper")) dof.upper = upper->Number();
  return dof;
}

Bone ReadBone(const JsonValue& value) {
  Bone bone;
  bone.name = value.At("name").String();
  bone.parent = value.At("parent").Integer(-1, kNumJoints - 1);
  bone.offset_m = ReadVector3(value.At("offset_m"));
  bone.tip_m = ReadVector3(value.At("tip_m"));
  const auto& rows = ReadItems(value.At("rest_from_axis"), 3, "a list of 3 rows");
  for (int i = 0; i < 3; ++i) bone.rest_from_axis.row(i) = ReadVector3(rows[i]).transpose();
  for (const JsonValue& dof : value.At("dofs").Items()) bone.dofs.push_back(ReadDof(dof));
  return bone;
}

}  // namespace

int ReadWhole(const JsonValue& value) { return value.Integer(0, std::numeric_limits<int>::max()); }

std::int64_t ReadLargeWhole(const JsonValue& value) {
  const double number = value.Number(0.0, kLargestExactWhole);
  if (number != std::floor(number)) throw value.Unwanted("a whole number");
  return static_cast<std::int64_t>(number);
}

const std::vector<JsonValue>& ReadItems(const JsonValue& value, size_t count, const char* wanted) {
  if (value.Items().size() != count) throw value.Unwanted(wanted);
  return value.Items();
}

Json SeedToJson(unsigned long seed) { return std::to_string(seed); }

unsigned long ReadSeed(const JsonValue& value) {
  const std::string& digits = value.String();
  unsigned long seed = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, seed);
  if (error != std::errc() || stop != end) throw value.Unwanted("a whole number in quotes");
  return seed;
}

Json SkeletonToJson(const Skeleton& skeleton) {
  Json bones = Json::array();
  for (const Bone& bone : skeleton.bones) bones.push_back(ToJson(bone));
  return {{"name", skeleton.name}, {"bones", std::move(bones)}};
}

Skeleton ReadSkeleton(const JsonValue& value) {
  Skeleton skeleton;
  skeleton.name = value.At("name").String();
  for (const JsonValue& bone : ReadItems(value.At("bones"), kNumJoints, "a list of 23 bones"))
    skeleton.bones.push_back(ReadBone(bone));
  return skeleton;
}

}  // namespace poselift
