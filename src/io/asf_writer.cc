// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/io/asf.h"
#include "src/io/atomic_file.h"
#include "src/io/number_text.h"
#include "src/io/plain_names.h"

namespace poselift {
namespace {

constexpr int kDigits = 12;
constexpr double kSamePlace_m = 1e-9;
const std::vector<Dof> kXyz = {{Dof::Kind::kRx}, {Dof::Kind::kRy}, {Dof::Kind::kRz}};

void AppendNumbers(std::initializer_list<double> numbers, std::string* text) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) throw InputError("found a skeleton with a NaN, wrote no ASF");
    *text += ' ';
    AppendGeneral(number, kDigits, text);
  }
}

void AppendAxis(const Eigen::Matrix3d& rest_from_axis, double radians_per_unit, std::string* text) {
  double angles_rad[3] = {};
  FitDofAngles(rest_from_axis, kXyz, angles_rad);
  AppendNumbers({angles_rad[0] / radians_per_unit, angles_rad[1] / radians_per_unit,
                 angles_rad[2] / radians_per_unit},
                text);
}

void AppendLimit(double limit, std::string* text) {
  if (std::isinf(limit))
    *text += limit < 0 ? "-inf" : "inf";
  else
    AppendGeneral(limit, kDigits, text);
}

void AppendDofs(const Bone& bone, const AsfSkeleton& asf, std::string* text) {
  if (bone.dofs.empty()) return;
  *text += "    dof";
  for (const Dof& dof : bone.dofs) (*text += ' ') += DofName(dof.kind);
  const char* before = "\n    limits (";
  for (const Dof& dof : bone.dofs) {
    const double unit = dof.IsRotation() ? asf.radians_per_unit : asf.metres_per_unit;
    *text += before;
    AppendLimit(dof.lower / unit, text);
    *text += ' ';
    AppendLimit(dof.upper / unit, text);
    *text += ')';
    before = "\n           (";
  }
  *text += '\n';
}

void AppendBone(const AsfSkeleton& asf, size_t b, std::string* text) {
  const Bone& bone = asf.skeleton.bones[b];
  const double length_m = bone.tip_m.norm();
  const Eigen::Vector3d direction =
      length_m > 0.0 ? Eigen::Vector3d(bone.tip_m / length_m) : Eigen::Vector3d::UnitY();
  *text += "  begin\n    id " + std::to_string(b) + "\n    name " + bone.name + "\n    direction";
  AppendNumbers({direction.x(), direction.y(), direction.z()}, text);
  *text += "\n    length";
  AppendNumbers({length_m / asf.metres_per_unit}, text);
  *text += "\n    axis";
  AppendAxis(bone.rest_from_axis, asf.radians_per_unit, text);
  *text += " XYZ\n";
  AppendDofs(bone, asf, text);
  *text += "  end\n";
}

void AppendHead(const AsfSkeleton& asf, std::string* text) {
  const auto& name = asf.skeleton.name;
  const bool has_name = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isgraph(c) && c != '#';
  });
  *text +=
      ":version 1.10\n:name " + (has_name ? name : "poselift") + "\n:units\n  mass 1.0\n  length";
  AppendNumbers({kMetresPerInch / asf.metres_per_unit}, text);
  *text += asf.radians_per_unit == 1.0 ? "\n  angle rad" : "\n  angle deg";
  *text += "\n:documentation\n  written by poselift\n:root\n  order";
  for (const Dof& dof : asf.root_channels) {
    *text += ' ';
    for (const char* c = DofName(dof.kind); *c; ++c)
      *text += static_cast<char>(std::toupper(static_cast<unsigned char>(*c)));
  }
  *text += "\n  axis XYZ\n  position";
  const Eigen::Vector3d position = asf.root_position_m / asf.metres_per_unit;
  AppendNumbers({position.x(), position.y(), position.z()}, text);
  *text += "\n  orientation";
  AppendAxis(asf.root_rest_from_axis, asf.radians_per_unit, text);
  *text += "\n";
}

}  // namespace

AsfSkeleton ToAsfSkeleton(const Skeleton& skeleton) {
  AsfSkeleton asf;
  asf.skeleton.name = skeleton.name;
  std::vector<Bone>& bones = asf.skeleton.bones;
  std::vector<int> index_in_asf;
  for (const Bone& bone : skeleton.bones) {
    Bone copy = bone;
    if (bone.parent < 0) {
      copy.offset_m.setZero();
      copy.tip_m.setZero();
    } else {
      copy.parent = index_in_asf[bone.parent];
      const Eigen::Vector3d& parent_tip_m = bones[copy.parent].tip_m;
      if ((bone.offset_m - parent_tip_m).norm() > kSamePlace_m) {
        bones.push_back({.name = bone.name + "joint",
                         .parent = copy.parent,
                         .offset_m = parent_tip_m,
                         .tip_m = bone.offset_m - parent_tip_m});
        copy.parent = static_cast<int>(bones.size()) - 1;
      }
      copy.offset_m = bones[copy.parent].tip_m;
    }
    index_in_asf.push_back(static_cast<int>(bones.size()));
    bones.push_back(std::move(copy));
  }
  const std::vector<std::string> names = PlainNames(asf.skeleton, "root");
  for (size_t b = 0; b < bones.size(); ++b) bones[b].name = names[b];
  return asf;
}

void WriteAsf(const AsfSkeleton& asf, const std::filesystem::path& path) {
  const std::vector<Bone>& bones = asf.skeleton.bones;
  std::string text;
  AppendHead(asf, &text);
  text += ":bonedata\n";
  for (size_t b = 1; b < bones.size(); ++b) AppendBone(asf, b, &text);
  text += ":hierarchy\n  begin\n";
  std::vector<std::string> children(bones.size());
  for (size_t b = 1; b < bones.size(); ++b) children[bones[b].parent] += " " + bones[b].name;
  for (size_t b = 0; b < bones.size(); ++b)
    if (!children[b].empty()) text += "    " + bones[b].name + children[b] + "\n";
  text += "  end\n";
  WriteFileAtomically(path, text);
}

void WriteAsf(const Skeleton& skeleton, const std::filesystem::path& path) {
  WriteAsf(ToAsfSkeleton(skeleton), path);
}

}  // namespace poselift
