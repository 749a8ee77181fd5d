// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/body_shape.h"

#include <string>

#include "src/input_error.h"

namespace poselift::testing {
namespace {

const Eigen::Vector3f kSkin(0.42f, 0.52f, 0.68f), kHair(0.10f, 0.12f, 0.15f),
    kShirt(0.42f, 0.36f, 0.32f), kTrousers(0.34f, 0.25f, 0.20f), kShoe(0.14f, 0.14f, 0.16f);

// An end of a part: so much of the bone's length from its start, and a step from there,
// of the left side. The radius is before stretching.
struct End {
  double share;
  Eigen::Vector3d step_m;
  double radius_m;
};

struct Row {
  const char* bone;  // without l and r
  End start, tip;
  Eigen::Vector3d stretch;
  const Eigen::Vector3f& albedo_bgr;
};

// Of a person whose thigh and shin are 0.85 m long.
constexpr double kLegOfTable_m = 0.85;

const std::vector<Row>& Table() {
  static const std::vector<Row> kRows = {
      {"root", {0, {0.06, -0.06, 0}, 0.10}, {0, {-0.06, -0.06, 0}, 0.10}, {1.1, 1, 1}, kTrousers},
      {"lowerback", {0, {0, 0, 0}, 0.105}, {1, {0, 0, 0}, 0.105}, {1.25, 1, 1}, kShirt},
      {"upperback", {0, {0, 0, 0}, 0.105}, {1, {0, 0, 0}, 0.115}, {1.25, 1, 1}, kShirt},
      {"thorax", {0, {0, 0, 0}, 0.115}, {0.9, {0, 0, 0}, 0.075}, {1.25, 1, 1}, kShirt},
      {"clavicle", {0.3, {0, -0.03, 0}, 0.07}, {0.95, {0, -0.01, 0}, 0.065}, {1, 1, 1}, kShirt},
      {"lowerneck", {0, {0, 0, 0}, 0.06}, {1, {0, 0, 0}, 0.055}, {1, 1, 1}, kSkin},
      {"upperneck", {0, {0, 0, 0}, 0.055}, {1, {0, 0, 0.01}, 0.055}, {1, 1, 1}, kSkin},
      {"head", {0.1, {0, 0, 0.025}, 0.07}, {0.6, {0, 0, 0.015}, 0.09}, {0.9, 1, 1.1}, kSkin},
      {"head", {0.5, {0, 0, -0.012}, 0.088}, {0.65, {0, 0, 0}, 0.098}, {0.9, 1, 1.1}, kHair},
      {"humerus", {0, {0, 0, 0}, 0.06}, {1, {0, 0, 0}, 0.044}, {1, 1, 1}, kShirt},
      {"radius", {0, {0, 0, 0}, 0.044}, {1, {0, 0, 0}, 0.033}, {1, 1, 1}, kSkin},
      {"wrist", {0, {0, 0, 0}, 0.033}, {1, {0, 0, 0}, 0.027}, {1, 1, 1}, kSkin},
      {"hand", {0, {0, 0, 0}, 0.032}, {2.5, {0, 0, 0}, 0.026}, {1, 0.6, 1.3}, kSkin},
      {"hipjoint", {0.7, {0, 0, 0}, 0.085}, {1, {0, 0, 0}, 0.085}, {1, 1, 1}, kTrousers},
      {"femur", {0, {0, 0, 0}, 0.085}, {1, {0, 0, 0}, 0.058}, {1, 1, 1}, kTrousers},
      {"tibia", {0, {0, 0, 0}, 0.056}, {1, {0, 0, 0}, 0.04}, {1, 1, 1}, kTrousers},
      {"tibia", {0.1, {0, 0, -0.012}, 0.05}, {0.5, {0, 0, -0.015}, 0.05}, {1, 1, 1}, kTrousers},
      {"foot", {0, {0, -0.03, -0.03}, 0.042}, {1, {0, 0, 0}, 0.036}, {1.1, 1, 1}, kShoe},
      {"toes", {0, {0, 0, 0}, 0.036}, {1, {0, -0.005, 0}, 0.028}, {1.2, 1, 1}, kShoe},
  };
  return kRows;
}

double LegLength_m(const Skeleton& skeleton) {
  double length_m = 0.0;
  for (const char* name : {"lfemur", "ltibia"})
    if (const auto bone = skeleton.FindBone(name)) length_m += skeleton.bones[*bone].tip_m.norm();
  return length_m;
}

RoundCone ConeOf(const Row& row, const Bone& bone, double side, double scale) {
  const Eigen::Vector3d mirror(side * scale, scale, scale);
  return {row.start.share * bone.tip_m + mirror.cwiseProduct(row.start.step_m),
          row.tip.share * bone.tip_m + mirror.cwiseProduct(row.tip.step_m),
          scale * row.start.radius_m, scale * row.tip.radius_m, row.stretch};
}

}  // namespace

std::vector<BodyPart> BodyAround(const Skeleton& skeleton) {
  const double scale = LegLength_m(skeleton) / kLegOfTable_m;
  std::vector<BodyPart> parts;
  for (const Row& row : Table()) {
    for (const auto& [prefix, side] : {std::pair{"l", 1.0}, {"r", -1.0}, {"", 1.0}}) {
      const auto bone = skeleton.FindBone(std::string(prefix) + row.bone);
      if (bone && scale > 0.0)
        parts.push_back({*bone, ConeOf(row, skeleton.bones[*bone], side, scale), row.albedo_bgr});
    }
  }
  if (parts.empty())
    throw InputError("found no leg of the CMU skeleton in '" + skeleton.name +
                     "', wanted its bones' names (lfemur, ltibia, ...)");
  return parts;
}

}  // namespace poselift::testing
