// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/bvh.h"
#include "src/io/bvh_rig.h"
#include "src/io/growing_file.h"
#include "src/io/number_text.h"
#include "src/io/plain_names.h"
#include "src/retarget.h"
#include "src/units.h"

namespace poselift {
namespace {

constexpr int kAngleDecimals = 6;
constexpr int kFrameTimeDecimals = 10;
const std::vector<Dof> kRootRotations = {{Dof::Kind::kRy}, {Dof::Kind::kRx}, {Dof::Kind::kRz}};

}  // namespace

// The text of a BVH, piece by piece.
class BvhText {
 public:
  BvhText(const Skeleton& skeleton, double metres_per_unit)
      : rig_(MakeBvhRig(skeleton)),
        rebaser_(skeleton, rig_.skeleton, rig_.source_bone),
        names_(PlainNames(rig_.skeleton)),
        metres_per_unit_(metres_per_unit),
        // At least 0.1 micrometre, so that ten bones in a row stay within one.
        length_decimals_(std::max(6, 7 + static_cast<int>(std::ceil(std::log10(metres_per_unit))))),
        children_(bones_.size()) {
    for (size_t b = 1; b < bones_.size(); ++b) children_[bones_[b].parent].push_back(b);
  }

  // All before the frames. Returns where their number stands.
  size_t AppendHead(const std::string& num_frames, double frame_time_s) {
    text_ += "HIERARCHY\n";
    AppendHierarchy();
    text_ += "MOTION\nFrames: ";
    const size_t place = text_.size();
    text_ += num_frames + "\nFrame Time: ";
    AppendFixed(frame_time_s, kFrameTimeDecimals, &text_);
    text_ += '\n';
    return place;
  }

  void AppendFrame(const SkeletonPose& pose) {
    const SkeletonPose& on_rig = rebaser_.Rebase(pose);
    for (const size_t b : order_) {
      if (b == 0) {
        for (const double value_m : on_rig.root_in_world_m) AppendLength(value_m);
        FitDofAngles(on_rig.world_from_root.toRotationMatrix(), kRootRotations, root_rad_);
        AppendRotations(root_rad_);
        continue;
      }
      const double* dofs = on_rig.dofs.data() + dof_starts_[b];
      if (HasShifts(bones_[b]))
        for (int axis = 0; axis < 3; ++axis) AppendLength(bones_[b].offset_m[axis] + *dofs++);
      AppendRotations(dofs);
    }
    text_ += '\n';
  }

  // What was appended since the last Take.
  std::string Take() { return std::exchange(text_, {}); }

 private:
  // Depth first, as the values of a frame come; not recursive, for chains of
  // any depth.
  void AppendHierarchy() {
    std::vector<size_t> next_child(bones_.size(), 0);
    std::vector<size_t> open = {0};
    OpenJoint(0, 0);
    while (!open.empty()) {
      const size_t b = open.back();
      if (next_child[b] < children_[b].size()) {
        const size_t child = children_[b][next_child[b]++];
        OpenJoint(child, open.size());
        open.push_back(child);
        continue;
      }
      if (children_[b].empty()) AppendEndSite(b, open.size());
      open.pop_back();
      AppendLine(open.size(), "}");
    }
  }

  void AppendLine(size_t depth, const std::string& line) {
    text_.append(depth, '\t').append(line).append("\n");
  }

  void OpenJoint(size_t b, size_t depth) {
    order_.push_back(b);
    AppendLine(depth, (b == 0 ? "ROOT " : "JOINT ") + names_[b]);
    AppendLine(depth, "{");
    AppendOffset(b == 0 ? Eigen::Vector3d::Zero().eval() : bones_[b].offset_m, depth + 1);
    const bool has_position = b == 0 || HasShifts(bones_[b]);
    AppendLine(depth + 1, std::string("CHANNELS ") +
                              (has_position ? "6 Xposition Yposition Zposition " : "3 ") +
                              "Zrotation Xrotation Yrotation");
  }

  // See JointDofs of the rig.
  static bool HasShifts(const Bone& bone) { return bone.dofs.size() == 6; }

  void AppendOffset(const Eigen::Vector3d& offset_m, size_t depth) {
    text_.append(depth, '\t').append("OFFSET");
    for (const double value_m : offset_m) AppendLength(value_m);
    text_ += '\n';
  }

  void AppendEndSite(size_t b, size_t depth) {
    AppendLine(depth, "End Site");
    AppendLine(depth, "{");
    AppendOffset(bones_[b].tip_m, depth + 1);
    AppendLine(depth, "}");
  }

  void AppendLength(double value_m) { Append(value_m / metres_per_unit_, length_decimals_); }

  void Append(double value, int decimals) {
    if (!std::isfinite(value) || std::abs(value) > 1e9)
      throw InputError("found a value that is no length or angle (" + std::to_string(value) +
                       ") in the motion, wrote no BVH");
    if (!text_.empty() && text_.back() != '\n') text_ += ' ';
    AppendFixed(value, decimals, &text_);
  }

  // ry rx rz, written the outermost first: Z X Y.
  void AppendRotations(const double* angles_rad) {
    for (const int i : {2, 1, 0}) Append(angles_rad[i] * kDegFromRad, kAngleDecimals);
  }

  const BvhRig rig_;
  const std::vector<Bone>& bones_ = rig_.skeleton.bones;
  Rebaser rebaser_;
  const std::vector<std::string> names_;
  const double metres_per_unit_;
  const int length_decimals_;
  const std::vector<int> dof_starts_ = rig_.skeleton.DofStarts();
  std::vector<std::vector<size_t>> children_;
  std::vector<size_t> order_;
  double root_rad_[3] = {};  // of the frame before
  std::string text_;
};

namespace {

void CheckFrameTime(double frame_time_s, const std::filesystem::path& path) {
  if (!(frame_time_s > 0.0) || !std::isfinite(frame_time_s))
    throw InputError(path.string(), "found a frame time that is not positive, wrote no BVH");
}

// The number of frames, for as many as there may come.
std::string CountField(int64_t num_frames) {
  constexpr size_t kWidth = 10;
  std::string field = std::to_string(num_frames);
  field.resize(kWidth, ' ');
  return field;
}

}  // namespace

void WriteBvh(const Motion& motion, const std::filesystem::path& path,
              const BvhWriteOptions& options) {
  CheckFrameTime(motion.frame_time_s, path);
  BvhText text(motion.skeleton, options.metres_per_unit);
  text.AppendHead(std::to_string(motion.frames.size()), motion.frame_time_s);
  for (const SkeletonPose& pose : motion.frames) text.AppendFrame(pose);
  WriteFileAtomically(path, text.Take());
}

GrowingBvh::GrowingBvh(const std::filesystem::path& path, const Skeleton& skeleton,
                       double frame_time_s, const BvhWriteOptions& options) {
  CheckFrameTime(frame_time_s, path);
  text_ = std::make_unique<BvhText>(skeleton, options.metres_per_unit);
  count_place_ = text_->AppendHead(CountField(0), frame_time_s);
  file_ = std::make_unique<GrowingFile>(path, text_->Take(), "");
}

GrowingBvh::~GrowingBvh() = default;

void GrowingBvh::Add(const SkeletonPose& pose) {
  if (!IsKnown(pose)) throw std::invalid_argument("GrowingBvh: a pose of which nothing is known");
  text_->Take();  // what a refused pose left
  text_->AppendFrame(pose);
  file_->Overwrite(count_place_, CountField(num_frames_ + 1));
  file_->Append(text_->Take());
  ++num_frames_;
}

void GrowingBvh::Close() { file_->Close(); }

}  // namespace poselift
