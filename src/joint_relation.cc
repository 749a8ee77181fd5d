// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/joint_relation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/input_error.h"
#include "src/nearest_names.h"
#include "src/translated.h"

namespace poselift {
namespace {

using Kind = LabelHint::Kind;
using Parts = std::vector<Landmark::Part>;

// Two of them: a hint of depth without a number is met where its sign is right.
constexpr double kMetWithin_sigmas = 2.0;
constexpr double kFarthest_m = 10.0;
constexpr double kLeastPinSigma_m = 1e-3;
constexpr double kLeastStature_m = 0.3, kLargestStature_m = 3.0;

bool IsOfBone(Kind kind) { return kind == Kind::kTowardsCamera || kind == Kind::kAwayFromCamera; }

// a - b.
Parts Difference(Parts a, const Parts& b) {
  for (const auto& [joint, weight] : b) a.push_back({joint, -weight});
  return a;
}

// How high a joint is over what its part of the body stands or lies on.
double HeightOverSole_m(const Parts& parts) {
  const auto height_m = [](int j) {
    switch (j) {
      case joint::kLeftAnkle:
      case joint::kRightAnkle:
        return 0.08;
      case joint::kLeftFoot:
      case joint::kRightFoot:
      case joint::kLeftHand:
      case joint::kRightHand:
        return 0.02;
      default:
        return 0.05;
    }
  };
  double sum_m = 0.0;
  for (const auto& [joint, weight] : parts) sum_m += weight * height_m(joint);
  return sum_m;
}

// All hints of the floor together: the first joint on it says where it is.
void AddFloor(const std::vector<LabelHint>& hints, const Layout& layout, double sigma_m,
              std::vector<JointRelation>* relations) {
  Parts first;
  int first_hint = 0;
  std::vector<bool> is_on_floor(kNumJoints, false);
  for (int i = 0; i < std::ssize(hints); ++i) {
    if (hints[static_cast<size_t>(i)].kind != Kind::kOnFloor) continue;
    const Parts parts = PartsNamed(hints[static_cast<size_t>(i)].joint, layout);
    for (const Landmark::Part& part : parts) is_on_floor[static_cast<size_t>(part.joint)] = true;
    if (first.empty()) {
      first = parts;
      first_hint = i;
    } else {
      relations->push_back({i, Difference(first, parts), Eigen::Vector3d::UnitY(),
                            HeightOverSole_m(parts) - HeightOverSole_m(first), sigma_m});
    }
  }
  if (first.empty()) return;
  for (int k = 0; k < kNumJoints; ++k)
    if (!is_on_floor[static_cast<size_t>(k)])
      relations->push_back({first_hint, Difference(first, {{k, 1.0}}), Eigen::Vector3d::UnitY(),
                            HeightOverSole_m({{k, 1.0}}) - HeightOverSole_m(first), sigma_m, true});
}

std::string UnknownJoint(const std::string& name, const Layout& layout) {
  std::vector<std::string> known;
  for (const Landmark& landmark : layout.landmarks) known.emplace_back(landmark.name);
  for (const JointInfo& joint : Joints()) known.emplace_back(joint.name);
  return fmt::format("found a hint of the unknown joint \"{}\", wanted perhaps \"{}\"", name,
                     NearestNames(name, known, 1).front());
}

}  // namespace

double JointRelation::Residual(const Pose3& joints_in_cam_m) const {
  const double residual =
      (axis_in_cam.dot(SumOfJoints(parts, joints_in_cam_m)) - bound_m) / sigma_m;
  return is_lower_bound ? std::min(0.0, residual) : residual;
}

std::string RelationOptions::Validate() const {
  if (!(sigma_m > 0.0)) return fmt::format("RelationOptions::sigma_m = {}, wanted > 0", sigma_m);
  if (!(least_depth_m >= 0.0))
    return fmt::format("RelationOptions::least_depth_m = {}, wanted >= 0", least_depth_m);
  if (!(floor_sigma_m > 0.0))
    return fmt::format("RelationOptions::floor_sigma_m = {}, wanted > 0", floor_sigma_m);
  return "";
}

Parts PartsNamed(const std::string& name, const Layout& layout) {
  if (const auto row = layout.Find(name); row && !layout.landmarks[*row].parts.empty())
    return layout.landmarks[*row].parts;
  if (const auto joint = FindJoint(name)) return {{*joint, 1.0}};
  return {};
}

std::string WhatIsWrongWith(const LabelHint& hint, const Layout& layout) {
  if (hint.kind == Kind::kHeight) {
    const double metres = hint.metres_m.value_or(std::nan(""));
    if (metres >= kLeastStature_m && metres <= kLargestStature_m) return "";
    return fmt::format("found a height of {} m, wanted {} to {}", metres, kLeastStature_m,
                       kLargestStature_m);
  }
  if (PartsNamed(hint.joint, layout).empty()) return UnknownJoint(hint.joint, layout);
  if (hint.kind == Kind::kNearer && PartsNamed(hint.other, layout).empty())
    return UnknownJoint(hint.other, layout);
  if (hint.kind == Kind::kNearer && hint.joint == hint.other)
    return fmt::format("found {} nearer than itself, wanted two joints", hint.joint);
  if (IsOfBone(hint.kind) && FindJoint(hint.joint).value_or(joint::kPelvis) == joint::kPelvis)
    return fmt::format(
        "found a bone that ends at \"{}\", wanted one of the 22 joints but the pelvis", hint.joint);
  if (hint.metres_m && hint.kind == Kind::kOnFloor)
    return fmt::format("found metres of {}, wanted none", Describe(hint));
  if (const double metres = hint.metres_m.value_or(0.0); !(metres >= 0.0 && metres <= kFarthest_m))
    return fmt::format("found {} m, wanted 0 to {}", metres, kFarthest_m);
  if (hint.kind == Kind::kPin && hint.metres_m && !(*hint.metres_m >= kLeastPinSigma_m))
    return fmt::format("found a pin known to {} m, wanted {} to {}", *hint.metres_m,
                       kLeastPinSigma_m, kFarthest_m);
  if (hint.kind == Kind::kPin &&
      !(hint.x_in_cam_m.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest_m))
    return fmt::format("found a pin at ({}, {}, {}), wanted metres from the pelvis up to {}",
                       hint.x_in_cam_m.x(), hint.x_in_cam_m.y(), hint.x_in_cam_m.z(), kFarthest_m);
  return "";
}

std::vector<JointRelation> RelationsOf(const std::vector<LabelHint>& hints, const Layout& layout,
                                       const RelationOptions& options) {
  std::vector<JointRelation> relations;
  for (int i = 0; i < std::ssize(hints); ++i) {
    const LabelHint& hint = hints[static_cast<size_t>(i)];
    if (const std::string error = WhatIsWrongWith(hint, layout); !error.empty())
      throw InputError(error);
    const auto add_depth = [&](const Parts& near, const Parts& far) {
      relations.push_back({i, Difference(far, near), Eigen::Vector3d::UnitZ(),
                           hint.metres_m.value_or(options.least_depth_m), options.sigma_m, true});
    };
    if (hint.kind == Kind::kNearer)
      add_depth(PartsNamed(hint.joint, layout), PartsNamed(hint.other, layout));
    if (IsOfBone(hint.kind)) {
      const int end = *FindJoint(hint.joint);
      const Parts start = {{Joints()[static_cast<size_t>(end)].parent, 1.0}};
      if (hint.kind == Kind::kTowardsCamera)
        add_depth({{end, 1.0}}, start);
      else
        add_depth(start, {{end, 1.0}});
    }
    if (hint.kind == Kind::kPin)
      for (int axis = 0; axis < 3; ++axis)
        relations.push_back({i, Difference(PartsNamed(hint.joint, layout), {{joint::kPelvis, 1.0}}),
                             Eigen::Vector3d::Unit(axis), hint.x_in_cam_m[axis],
                             hint.metres_m.value_or(options.sigma_m)});
  }
  AddFloor(hints, layout, options.floor_sigma_m, &relations);
  return relations;
}

std::vector<int> UnmetHints(const std::vector<JointRelation>& relations,
                            const Pose3& joints_in_cam_m) {
  std::vector<int> unmet;
  for (const JointRelation& relation : relations)
    if (!(std::abs(relation.Residual(joints_in_cam_m)) <= kMetWithin_sigmas))
      unmet.push_back(relation.hint);
  std::sort(unmet.begin(), unmet.end());
  unmet.erase(std::unique(unmet.begin(), unmet.end()), unmet.end());
  return unmet;
}

HintWords WordsOf(const LabelHint& hint) {
  switch (hint.kind) {
    case Kind::kNearer:
      return {ToTranslate("{} nearer than {}"), hint.joint, hint.other};
    case Kind::kTowardsCamera:
      return {ToTranslate("the bone to {} towards the camera"), hint.joint};
    case Kind::kAwayFromCamera:
      return {ToTranslate("the bone to {} away from the camera"), hint.joint};
    case Kind::kOnFloor:
      return {ToTranslate("{} on the floor"), hint.joint};
    case Kind::kHeight:
      return {ToTranslate("{} m tall"), fmt::format("{}", hint.metres_m.value_or(0.0))};
    case Kind::kPin:
      return {ToTranslate("{} pinned"), hint.joint};
  }
  return {};
}

std::string Describe(const LabelHint& hint) {
  const HintWords words = WordsOf(hint);
  return fmt::format(fmt::runtime(words.english), words.first, words.second);
}

}  // namespace poselift
