// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/rig_skeleton.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "src/body_transfer.h"

namespace poselift::testing {
namespace {

const std::vector<Dof> kTurns = {{Dof::Kind::kRy}, {Dof::Kind::kRz}, {Dof::Kind::kRx}};
const std::vector<Dof> kMoves = {{Dof::Kind::kTx}, {Dof::Kind::kTy}, {Dof::Kind::kTz},
                                 {Dof::Kind::kRx}, {Dof::Kind::kRz}, {Dof::Kind::kRy}};

class RigMaker {
 public:
  explicit RigMaker(double unit) : unit_(unit) {
    rig_.name = "rig";
    rig_.bones = {{.name = "Armature"}};
  }

  // offset: from the parent's start; x left, y to the back, z up.
  int Add(const std::string& name, int parent, const Eigen::Vector3d& offset,
          const Eigen::Vector3d& tip, const std::vector<Dof>& dofs = kTurns) {
    Bone bone{.name = "rig:" + name,
              .parent = parent,
              .offset_m = unit_ * offset,
              .tip_m = unit_ * tip,
              .dofs = dofs};
    bone.rest_from_axis =
        Eigen::AngleAxisd(0.2 * static_cast<double>(rig_.bones.size()), Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    rig_.bones.push_back(bone);
    return static_cast<int>(rig_.bones.size()) - 1;
  }

  void AddSide(const std::string& side, double left, int hips, int chest) {
    const int thigh = Add(side + "UpLeg", hips, {0.1 * left, 0.0, -0.05}, {0.0, 0.0, -0.42});
    const int shank = Add(side + "Leg", thigh, {0.0, 0.0, -0.42}, {0.0, 0.0, -0.4});
    Add(side + "Foot", shank, {0.0, 0.0, -0.4}, {0.0, -0.15, -0.06});
    const int clavicle =
        Add(side + "Shoulder", chest, {0.03 * left, 0.0, 0.12}, {0.15 * left, 0.0, 0.0});
    const int upper = Add(side + "Arm", clavicle, {0.15 * left, 0.0, 0.0}, {0.28 * left, 0.0, 0.0});
    const int lower =
        Add(side + "ForeArm", upper, {0.28 * left, 0.0, 0.0}, {0.25 * left, 0.0, 0.0});
    const int hand = Add(side + "Hand", lower, {0.25 * left, 0.0, 0.0}, {0.09 * left, 0.0, 0.0});
    Add(side + "HandIndex1", hand, {0.09 * left, -0.02, 0.0}, {0.04 * left, 0.0, 0.0},
        {{Dof::Kind::kRz}});
    Add(side + "HandThumb1", hand, {0.03 * left, -0.03, 0.0}, {0.0, -0.05, 0.0});
  }

  Skeleton Make() {
    const int hips = Add("Hips", 0, {0.0, 0.0, 0.95}, {0.0, 0.0, 0.1}, kMoves);
    int spine = hips;
    for (const char* name : {"Spine", "Spine1", "Spine2", "Spine3"})
      spine = Add(name, spine, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.1});
    const int neck = Add("Neck", spine, {0.0, 0.0, 0.15}, {0.0, 0.0, 0.1});
    Add("Head", neck, {0.0, 0.0, 0.1}, {0.0, 0.0, 0.18});
    AddSide("Left", 1.0, hips, spine);
    AddSide("Right", -1.0, hips, spine);
    return rig_;
  }

 private:
  Skeleton rig_;
  double unit_;
};

}  // namespace

Skeleton RigSkeleton(double unit) { return RigMaker(unit).Make(); }

Motion OnRig(const Motion& walk, double unit) {
  Motion rest{RigSkeleton(unit), walk.frame_time_s, {}};
  rest.frames.assign(walk.frames.size(), SkeletonPose::Rest(rest.skeleton));
  const std::vector<int> first_dof = rest.skeleton.DofStarts();
  for (size_t t = 0; t < rest.frames.size(); ++t)
    for (size_t b = 0; b < rest.skeleton.bones.size(); ++b)
      if (rest.skeleton.bones[b].name.find("HandIndex") != std::string::npos)
        rest.frames[t].dofs[first_dof[b]] = 0.5 + 0.4 * std::sin(0.05 * static_cast<double>(t));
  return BodyTransfer(rest.skeleton, walk.skeleton).CarryBack(rest, walk);
}

}  // namespace poselift::testing
