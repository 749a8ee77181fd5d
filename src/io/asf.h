// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "src/skeleton.h"
#include "src/units.h"

namespace poselift {

// Acclaim skeleton file (.asf), and what its motion files (.amc) need to know
// of it beside the skeleton: their units and the order of the root's channels.
//
//   metres = value (1 / length) 0.0254          length: of :units, CMU 0.45
//   offset of a bone = tip of its parent, tip = direction * length
//   rest_from_axis C = R(l3, c) R(l2, b) R(l1, a)        of "axis a b c l1l2l3"
//                    = Rz(c) Ry(b) Rx(a) for XYZ
// The root's rotation is world_from_root = C R C^T with C from `orientation`
// and `axis` of :root, R from the channels in `order`, the first innermost; its
// place is `position` + the channels.
struct AsfSkeleton {
  Skeleton skeleton;
  double metres_per_unit = kMetresPerInch / kCmuLength;
  double radians_per_unit = kRadFromDeg;
  std::vector<Dof> root_channels = {{Dof::Kind::kTx}, {Dof::Kind::kTy}, {Dof::Kind::kTz},
                                    {Dof::Kind::kRx}, {Dof::Kind::kRy}, {Dof::Kind::kRz}};
  Eigen::Vector3d root_position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d root_rest_from_axis = Eigen::Matrix3d::Identity();
};

// Bones come parents first, in the order of :hierarchy. Throws InputError with
// file:line for anything malformed and for the length channel `l`.
AsfSkeleton ReadAsfSkeleton(const std::filesystem::path& path);
Skeleton ReadAsf(const std::filesystem::path& path);

// Any skeleton as an ASF can say it, in the units of CMU. ASF bones begin at
// the end of their parent and the root has no length, so a bone that begins
// elsewhere gets a bone without dofs before it, "<name>joint" (CMU has lhipjoint
// for the same reason). Names are made plain (plain_names.h); the root is "root".
// The dofs and their order stay, so a SkeletonPose fits both.
AsfSkeleton ToAsfSkeleton(const Skeleton& skeleton);

// asf.skeleton must be one that an ASF can say (from one of the above).
void WriteAsf(const AsfSkeleton& asf, const std::filesystem::path& path);
void WriteAsf(const Skeleton& skeleton, const std::filesystem::path& path);

// "rx" ... "tz", in upper case for the root.
const char* DofName(Dof::Kind kind);

}  // namespace poselift
