// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/amc.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/number_text.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr int kDigits = 9;

class AmcReader {
 public:
  AmcReader(const std::filesystem::path& path, const AsfSkeleton& asf)
      : scanner_(path, {.comment = '#'}),
        asf_(asf),
        dof_starts_(asf.skeleton.DofStarts()),
        frame_of_bone_(asf.skeleton.bones.size(), 0),
        radians_per_unit_(asf.radians_per_unit),
        pose_(SkeletonPose::Rest(asf.skeleton)) {}

  std::vector<SkeletonPose> Read() {
    bool more = !scanner_.AtLineEnd() || scanner_.NextLine();
    while (more && scanner_.PeekOnAnyLine().starts_with(':')) more = ReadKeyword();
    while (more) more = ReadFrame();
    if (frames_.empty())
      scanner_.FailAt(scanner_.line(),
                      "the file ends before its first frame, wanted an AMC motion");
    return std::move(frames_);
  }

 private:
  bool ReadKeyword() {
    const std::string_view key = scanner_.Word();
    if (EqualsIgnoringCase(key, ":degrees")) radians_per_unit_ = kRadFromDeg;
    if (EqualsIgnoringCase(key, ":radians")) radians_per_unit_ = 1.0;
    return scanner_.NextLine();
  }

  // From the line of its number to the next number; false at the file's end.
  bool ReadFrame() {
    ReadFrameNumber();
    const int line = scanner_.line();
    pose_.dofs.setZero();
    pose_.root_in_world_m = asf_.root_position_m;
    pose_.world_from_root.setIdentity();
    num_bones_ = 0;
    bool more = scanner_.NextLine();
    while (more && !AtNumber()) {
      ReadBone();
      more = scanner_.NextLine();
    }
    if (frames_.empty()) bones_per_frame_ = num_bones_;
    if (num_bones_ != bones_per_frame_ || num_bones_ == 0)
      scanner_.FailAt(line, "found " + std::to_string(num_bones_) + " bones in frame " +
                                std::to_string(number_) + ", wanted " +
                                std::to_string(std::max(bones_per_frame_, 1)) +
                                " as in the first; the file may be cut short");
    frames_.push_back(pose_);
    return more;
  }

  bool AtNumber() {
    const std::string_view word = scanner_.PeekOnAnyLine();
    return word[0] >= '0' && word[0] <= '9';
  }

  void ReadFrameNumber() {
    const std::string_view word = scanner_.Word();
    int number = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool is_number = error == std::errc() && stop == word.data() + word.size();
    if (!is_number || (!frames_.empty() && number != number_ + 1))
      scanner_.Fail(word, frames_.empty() ? std::string("the number of the first frame")
                                          : "frame number " + std::to_string(number_ + 1));
    scanner_.ExpectLineEnd();
    number_ = number;
  }

  void ReadBone() {
    const std::string_view name = scanner_.Word();
    const int b = FindBone(name);
    if (frame_of_bone_[b] == static_cast<int>(frames_.size()) + 1)
      scanner_.Fail(name, "every bone once in a frame");
    frame_of_bone_[b] = static_cast<int>(frames_.size()) + 1;
    ++num_bones_;
    if (b == 0) {
      ReadRoot();
    } else {
      double* values = pose_.dofs.data() + dof_starts_[b];
      for (const Dof& dof : asf_.skeleton.bones[b].dofs) *values++ = ReadValue(dof);
    }
    scanner_.ExpectLineEnd();
  }

  double ReadValue(const Dof& dof) {
    return scanner_.Number("a number for each dof of the bone") *
           (dof.IsRotation() ? radians_per_unit_ : asf_.metres_per_unit);
  }

  void ReadRoot() {
    double values[6];
    for (size_t i = 0; i < asf_.root_channels.size(); ++i) {
      const Dof& channel = asf_.root_channels[i];
      values[i] = ReadValue(channel);
      if (!channel.IsRotation()) pose_.root_in_world_m[channel.Axis()] += values[i];
    }
    const Eigen::Matrix3d& C = asf_.root_rest_from_axis;
    pose_.world_from_root = C * RotationOfDofs(asf_.root_channels, values) * C.transpose();
  }

  // Frames repeat the bones in one order: the name after the last one found is
  // tried first.
  int FindBone(std::string_view name) {
    const auto& bones = asf_.skeleton.bones;
    const size_t turn = static_cast<size_t>(num_bones_);
    if (turn < order_.size() && bones[order_[turn]].name == name) return order_[turn];
    const auto found = asf_.skeleton.FindBone(name);
    if (!found) scanner_.Fail(name, "a bone of the skeleton " + Quoted(asf_.skeleton.name));
    if (frames_.empty()) order_.push_back(*found);
    return *found;
  }

  TextScanner scanner_;
  const AsfSkeleton& asf_;
  std::vector<int> dof_starts_;
  std::vector<int> frame_of_bone_;  // the last frame it stood in, from 1
  double radians_per_unit_;
  SkeletonPose pose_;
  std::vector<int> order_;
  std::vector<SkeletonPose> frames_;
  int number_ = 0;
  int num_bones_ = 0;
  int bones_per_frame_ = 0;
};

class AmcWriter {
 public:
  explicit AmcWriter(const AsfSkeleton& asf) : asf_(asf) {
    text_ = "# written by poselift\n:FULLY-SPECIFIED\n";
    text_ += asf.radians_per_unit == 1.0 ? ":RADIANS\n" : ":DEGREES\n";
  }

  void Append(const SkeletonPose& pose) {
    ++number_;
    if (!pose.world_from_root.coeffs().allFinite())
      throw InputError("found a NaN in frame " + std::to_string(number_) + ", wrote no AMC");
    text_ += std::to_string(number_) + "\n";
    AppendRoot(pose);
    Eigen::Index d = 0;
    for (size_t b = 1; b < asf_.skeleton.bones.size(); ++b) {
      const Bone& bone = asf_.skeleton.bones[b];
      if (bone.dofs.empty()) continue;
      text_ += bone.name;
      for (const Dof& dof : bone.dofs) AppendValue(dof, pose.dofs[d++]);
      text_ += '\n';
    }
  }

  const std::string& text() const { return text_; }

 private:
  void AppendRoot(const SkeletonPose& pose) {
    const Eigen::Matrix3d& C = asf_.root_rest_from_axis;
    const Eigen::Matrix3d world_from_root = pose.world_from_root.toRotationMatrix();
    const double error_rad =
        FitDofAngles(C.transpose() * world_from_root * C, asf_.root_channels, root_);
    if (!(error_rad < 1e-6))
      throw InputError("the root turns in frame " + std::to_string(number_) +
                       " as the root channels of the ASF cannot say, wanted RX RY RZ among them");
    text_ += asf_.skeleton.bones[0].name;
    for (size_t i = 0; i < asf_.root_channels.size(); ++i) {
      const Dof& channel = asf_.root_channels[i];
      const int axis = channel.Axis();
      AppendValue(channel, channel.IsRotation()
                               ? root_[i]
                               : pose.root_in_world_m[axis] - asf_.root_position_m[axis]);
    }
    text_ += '\n';
  }

  void AppendValue(const Dof& dof, double value) {
    if (!std::isfinite(value))
      throw InputError("found a NaN in frame " + std::to_string(number_) + ", wrote no AMC");
    text_ += ' ';
    AppendGeneral(value / (dof.IsRotation() ? asf_.radians_per_unit : asf_.metres_per_unit),
                  kDigits, &text_);
  }

  const AsfSkeleton& asf_;
  std::string text_;
  double root_[6] = {};  // of the frame before
  int number_ = 0;
};

bool IsAsf(const std::filesystem::path& path) {
  return EqualsIgnoringCase(path.extension().string(), ".asf");
}

}  // namespace

Motion ReadAmc(const std::filesystem::path& path, const AsfSkeleton& asf, double frame_time_s) {
  return {asf.skeleton, frame_time_s, AmcReader(path, asf).Read()};
}

std::filesystem::path FindAsfOf(const std::filesystem::path& amc_path) {
  const auto folder = amc_path.has_parent_path() ? amc_path.parent_path() : ".";
  const std::string stem = amc_path.stem().string();
  for (const std::string& name : {stem.substr(0, stem.find('_')), stem})
    if (std::filesystem::exists(folder / (name + ".asf"))) return folder / (name + ".asf");
  std::vector<std::filesystem::path> found;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable))
    if (IsAsf(entry.path())) found.push_back(entry.path());
  if (found.size() == 1) return found[0];
  throw InputError(amc_path.string(),
                   "found " + std::string(found.empty() ? "no" : "several") +
                       " .asf beside it, wanted its skeleton; name it (--skeleton FILE.asf)");
}

void WriteAmc(const Motion& motion, const AsfSkeleton& asf, const std::filesystem::path& path) {
  AmcWriter writer(asf);
  for (const SkeletonPose& pose : motion.frames) {
    if (pose.dofs.size() != asf.skeleton.NumDofs())
      throw std::invalid_argument("the motion is of another skeleton than the ASF");
    writer.Append(pose);
  }
  WriteFileAtomically(path, writer.text());
}

void WriteAmc(const Motion& motion, const std::filesystem::path& path) {
  WriteAmc(motion, ToAsfSkeleton(motion.skeleton), path);
}

}  // namespace poselift
