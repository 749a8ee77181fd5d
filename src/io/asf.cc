// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/asf.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr std::array<const char*, 6> kDofNames = {"rx", "ry", "rz", "tx", "ty", "tz"};

std::string Lower(std::string_view name) {
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

// Numbers as the file has them; units are known only at its end.
struct RawBone {
  std::string name;
  int line = 0;
  std::optional<Eigen::Vector3d> direction;
  std::optional<double> length;
  Eigen::Vector3d axis_angles = Eigen::Vector3d::Zero();
  std::vector<Dof> axis_order;
  std::vector<Dof> dofs;
  std::vector<double> limits;
};

class AsfReader {
 public:
  explicit AsfReader(const std::filesystem::path& path)
      : scanner_(path, {.comment = '#', .extra_blanks = "()"}) {}

  AsfSkeleton Read() {
    if (scanner_.PeekOnAnyLine().empty())
      throw InputError(scanner_.file(), "found nothing in it, wanted an ASF skeleton");
    for (bool more = !scanner_.AtLineEnd() || scanner_.NextLine(); more;) more = ReadSection();
    if (!has_bonedata_ || !has_hierarchy_)
      scanner_.FailAt(scanner_.line(),
                      "the file ends here, wanted the sections :bonedata and "
                      ":hierarchy of an ASF skeleton");
    return Build();
  }

 private:
  // Reads from the first word of a line; returns whether there is another.
  bool ReadSection() {
    const std::string_view key = scanner_.Word();
    if (!key.starts_with(':')) scanner_.Fail(key, "a section such as :units or :bonedata");
    if (EqualsIgnoringCase(key, ":units")) return ReadUnits();
    if (EqualsIgnoringCase(key, ":root")) return ReadRoot();
    if (EqualsIgnoringCase(key, ":bonedata")) return ReadBones();
    if (EqualsIgnoringCase(key, ":hierarchy")) return ReadHierarchy();
    if (EqualsIgnoringCase(key, ":name")) name_ = scanner_.Word();
    return SkipToSection();
  }

  bool AtSection() { return scanner_.PeekOnAnyLine().starts_with(':'); }

  // :documentation and the like hold free text.
  bool SkipToSection() {
    while (scanner_.NextLine())
      if (AtSection()) return true;
    return false;
  }

  bool ReadUnits() {
    while (scanner_.NextLine()) {
      if (AtSection()) return true;
      const std::string_view key = scanner_.Word();
      if (EqualsIgnoringCase(key, "length")) {
        const double length = scanner_.Number("the length unit as a number");
        if (length < 1e-6 || length > 1e6)
          scanner_.FailAt(scanner_.line(), "found a length unit of " + std::to_string(length) +
                                               ", wanted one between 1e-6 and 1e6 (CMU has 0.45)");
        asf_.metres_per_unit = kMetresPerInch / length;
      } else if (EqualsIgnoringCase(key, "angle")) {
        const std::string_view unit = scanner_.Word();
        const bool is_deg = EqualsIgnoringCase(unit, "deg");
        if (!is_deg && !EqualsIgnoringCase(unit, "rad")) scanner_.Fail(unit, "deg or rad");
        asf_.radians_per_unit = is_deg ? kRadFromDeg : 1.0;
      }
    }
    return false;
  }

  bool ReadRoot() {
    while (scanner_.NextLine()) {
      if (AtSection()) return true;
      const std::string_view key = scanner_.Word();
      if (EqualsIgnoringCase(key, "order")) {
        asf_.root_channels = ReadDofs();
      } else if (EqualsIgnoringCase(key, "axis")) {
        root_axis_order_ = ReadAxisOrder();
      } else if (EqualsIgnoringCase(key, "position")) {
        root_position_ = ReadVector("three numbers for the root's position");
      } else if (EqualsIgnoringCase(key, "orientation")) {
        root_orientation_ = ReadVector("three angles for the root's orientation");
      } else {
        scanner_.Fail(key, "order, axis, position or orientation");
      }
    }
    return false;
  }

  bool ReadBones() {
    has_bonedata_ = true;
    while (scanner_.NextLine()) {
      if (AtSection()) return true;
      const std::string_view key = scanner_.Word();
      if (!EqualsIgnoringCase(key, "begin")) scanner_.Fail(key, "begin of a bone");
      ReadBone();
    }
    return false;
  }

  void ReadBone() {
    RawBone bone;
    bone.line = scanner_.line();
    for (;;) {
      if (!scanner_.NextLine() || AtSection())
        scanner_.FailAt(bone.line, "found a bone without end, wanted a line \"end\"");
      const std::string_view key = scanner_.Word();
      if (EqualsIgnoringCase(key, "end")) break;
      ReadBoneLine(key, &bone);
    }
    CheckBone(bone);
    if (!bone_of_name_.emplace(Lower(bone.name), raw_.size()).second)
      scanner_.FailAt(bone.line,
                      "found a second bone " + Quoted(bone.name) + ", wanted every name once");
    raw_.push_back(std::move(bone));
  }

  void ReadBoneLine(std::string_view key, RawBone* bone) {
    if (EqualsIgnoringCase(key, "name")) {
      bone->name = scanner_.Word();
    } else if (EqualsIgnoringCase(key, "direction")) {
      bone->direction = ReadVector("three numbers for the bone's direction");
    } else if (EqualsIgnoringCase(key, "length")) {
      bone->length = scanner_.Number("the bone's length as a number");
      if (*bone->length < 0.0)
        scanner_.FailAt(scanner_.line(), "found a negative length, wanted 0 or more");
    } else if (EqualsIgnoringCase(key, "axis")) {
      bone->axis_angles = ReadVector("three angles for the bone's axis");
      bone->axis_order = ReadAxisOrder();
    } else if (EqualsIgnoringCase(key, "dof")) {
      bone->dofs = ReadDofs();
    } else if (EqualsIgnoringCase(key, "limits")) {
      ReadLimits(bone);
    }
    // id, bodymass, cofmass: of no use here.
  }

  void CheckBone(const RawBone& bone) {
    const std::string wanted = bone.name.empty() ? "name"
                               : !bone.direction ? "direction"
                                                 : "length";
    if (bone.name.empty() || !bone.direction || !bone.length)
      scanner_.FailAt(bone.line,
                      "found a bone without " + wanted + ", wanted name, direction and length");
    if (EqualsIgnoringCase(bone.name, "root"))
      scanner_.FailAt(bone.line, "found a bone named root, wanted that name for :root alone");
    if (*bone.length > 0.0 && bone.direction->norm() < 1e-9)
      scanner_.FailAt(bone.line, "found a bone with a length but the direction 0 0 0");
    if (!bone.limits.empty() && bone.limits.size() != 2 * bone.dofs.size())
      scanner_.FailAt(bone.line, "found " + std::to_string(bone.limits.size()) +
                                     " limits, wanted two for each of the " +
                                     std::to_string(bone.dofs.size()) + " dofs");
    for (size_t i = 0; i + 1 < bone.limits.size(); i += 2)
      if (bone.limits[i] > bone.limits[i + 1])
        scanner_.FailAt(bone.line, "found a lower limit above the upper one");
  }

  void ReadLimits(RawBone* bone) {
    for (;;) {
      const std::string_view next = scanner_.PeekOnAnyLine();
      const bool is_number =
          !next.empty() && (std::string_view("+-.0123456789").find(next[0]) != next.npos ||
                            EqualsIgnoringCase(next.substr(0, 3), "inf"));
      if (!is_number) return;
      if (scanner_.AtLineEnd()) scanner_.NextLine();
      bone->limits.push_back(scanner_.NumberOrInfinity("a limit as a number or inf"));
    }
  }

  std::vector<Dof> ReadDofs() {
    std::vector<Dof> dofs;
    while (!scanner_.AtLineEnd()) {
      const std::string_view word = scanner_.Word();
      if (EqualsIgnoringCase(word, "l"))
        scanner_.Fail(word, "rx ry rz tx ty tz (bones that change their length are not supported)");
      size_t kind = 0;
      while (kind < kDofNames.size() && !EqualsIgnoringCase(word, kDofNames[kind])) ++kind;
      if (kind == kDofNames.size()) scanner_.Fail(word, "one of rx ry rz tx ty tz");
      for (const Dof& dof : dofs)
        if (static_cast<size_t>(dof.kind) == kind) scanner_.Fail(word, "every channel once");
      dofs.push_back({static_cast<Dof::Kind>(kind)});
    }
    return dofs;
  }

  // "XYZ": as dofs rx ry rz.
  std::vector<Dof> ReadAxisOrder() {
    const std::string_view word = scanner_.Word();
    std::vector<Dof> order;
    std::array<bool, 3> seen{};
    for (const char c : word) {
      const size_t axis = Lower({&c, 1})[0] - size_t{'x'};
      if (axis > 2 || seen[axis]) break;
      seen[axis] = true;
      order.push_back({static_cast<Dof::Kind>(axis)});
    }
    if (order.size() != 3 || word.size() != 3) scanner_.Fail(word, "an axis order such as XYZ");
    return order;
  }

  Eigen::Vector3d ReadVector(std::string_view wanted) {
    Eigen::Vector3d vector;
    for (double& value : vector) value = scanner_.Number(wanted);
    return vector;
  }

  bool ReadHierarchy() {
    has_hierarchy_ = true;
    children_.resize(raw_.size() + 1);
    parent_line_.resize(raw_.size() + 1, 0);
    while (scanner_.NextLine()) {
      if (AtSection()) return true;
      const std::string_view parent = scanner_.Word();
      if (EqualsIgnoringCase(parent, "begin") || EqualsIgnoringCase(parent, "end")) continue;
      const size_t p = IndexOf(parent);
      while (!scanner_.AtLineEnd()) {
        const std::string_view child = scanner_.Word();
        const size_t c = IndexOf(child);
        if (c == 0) scanner_.Fail(child, "a bone, the root has no parent");
        if (parent_line_[c] != 0)
          scanner_.Fail(child, "every bone under one parent (it has one at line " +
                                   std::to_string(parent_line_[c]) + ")");
        parent_line_[c] = scanner_.line();
        children_[p].push_back(c);
      }
    }
    return false;
  }

  // 0: the root, else 1 + index of the bone.
  size_t IndexOf(std::string_view name) {
    if (EqualsIgnoringCase(name, "root")) return 0;
    const auto found = bone_of_name_.find(Lower(name));
    if (found == bone_of_name_.end()) scanner_.Fail(name, "a bone of :bonedata");
    return found->second + 1;
  }

  AsfSkeleton Build() {
    children_.resize(raw_.size() + 1);
    asf_.skeleton.name = name_;
    asf_.skeleton.bones = {{.name = "root"}};
    asf_.root_position_m = root_position_ * asf_.metres_per_unit;
    asf_.root_rest_from_axis = AxisMatrix(root_orientation_, root_axis_order_);
    // Depth first; a stack of its own, for chains of any depth.
    std::vector<std::pair<size_t, int>> stack;  // bone, parent in the skeleton
    const auto push_children = [&](size_t bone, int index) {
      for (auto c = children_[bone].rbegin(); c != children_[bone].rend(); ++c)
        stack.emplace_back(*c, index);
    };
    for (push_children(0, 0); !stack.empty();) {
      const auto [bone, parent] = stack.back();
      stack.pop_back();
      asf_.skeleton.bones.push_back(BuildBone(raw_[bone - 1], parent));
      push_children(bone, static_cast<int>(asf_.skeleton.bones.size()) - 1);
    }
    if (asf_.skeleton.bones.size() != raw_.size() + 1) FailForUnreachable();
    return std::move(asf_);
  }

  void FailForUnreachable() {
    for (const RawBone& bone : raw_)
      if (!asf_.skeleton.FindBone(bone.name))
        scanner_.FailAt(bone.line, "found bone " + Quoted(bone.name) +
                                       " with no way to the root, wanted it under :hierarchy");
  }

  Bone BuildBone(const RawBone& raw, int parent) {
    Bone bone{.name = raw.name, .parent = parent};
    bone.offset_m = asf_.skeleton.bones[parent].tip_m;
    // Files print the direction with 6 digits: the length is the better known.
    bone.tip_m = raw.direction->stableNormalized() * (*raw.length * asf_.metres_per_unit);
    if (!raw.axis_order.empty()) bone.rest_from_axis = AxisMatrix(raw.axis_angles, raw.axis_order);
    bone.dofs = raw.dofs;
    for (size_t i = 0; i < raw.limits.size(); ++i) {
      Dof& dof = bone.dofs[i / 2];
      const double unit = dof.IsRotation() ? asf_.radians_per_unit : asf_.metres_per_unit;
      (i % 2 == 0 ? dof.lower : dof.upper) = raw.limits[i] * unit;
    }
    return bone;
  }

  Eigen::Matrix3d AxisMatrix(const Eigen::Vector3d& angles, const std::vector<Dof>& order) {
    const Eigen::Vector3d angles_rad = angles * asf_.radians_per_unit;
    return RotationOfDofs(order, angles_rad.data());
  }

  TextScanner scanner_;
  AsfSkeleton asf_;
  std::string name_;
  std::vector<Dof> root_axis_order_ = {{Dof::Kind::kRx}, {Dof::Kind::kRy}, {Dof::Kind::kRz}};
  Eigen::Vector3d root_position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d root_orientation_ = Eigen::Vector3d::Zero();
  std::vector<RawBone> raw_;
  std::unordered_map<std::string, size_t> bone_of_name_;
  std::vector<std::vector<size_t>> children_;
  std::vector<int> parent_line_;
  bool has_bonedata_ = false;
  bool has_hierarchy_ = false;
};

}  // namespace

AsfSkeleton ReadAsfSkeleton(const std::filesystem::path& path) { return AsfReader(path).Read(); }

Skeleton ReadAsf(const std::filesystem::path& path) { return ReadAsfSkeleton(path).skeleton; }

const char* DofName(Dof::Kind kind) { return kDofNames[static_cast<size_t>(kind)]; }

}  // namespace poselift
