// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/io/text_scanner.h"
#include "src/units.h"

namespace poselift {
namespace {

// Index = Dof::Kind.
constexpr std::array<const char*, 6> kChannelNames = {"Xrotation", "Yrotation", "Zrotation",
                                                      "Xposition", "Yposition", "Zposition"};
constexpr std::string_view kAnyChannel =
    "one of Xposition Yposition Zposition Xrotation Yrotation Zrotation";

// The dofs that the channels of one joint are, in the order of the file: what
// stands first there is outermost.
struct Joint {
  std::vector<Dof> channels;
  bool has_offset = false;
  bool has_channels = false;
};

class BvhReader {
 public:
  BvhReader(const std::filesystem::path& path, const BvhReadOptions& options)
      : scanner_(path, {}), options_(options) {}

  Motion Read() {
    ExpectWord("HIERARCHY");
    ExpectWord("ROOT");
    ReadHierarchy();
    SetTips();
    motion_.frame_time_s = options_.frame_time_s;
    ReadMotion();
    return std::move(motion_);
  }

 private:
  std::vector<Bone>& bones() { return motion_.skeleton.bones; }

  void ExpectWord(std::string_view wanted) {
    const std::string_view word = scanner_.WordOnAnyLine();
    if (!EqualsIgnoringCase(word, wanted)) FailOnWord(word, wanted);
  }

  [[noreturn]] void FailOnWord(std::string_view found, std::string_view wanted) {
    if (found.empty())
      scanner_.FailAt(scanner_.line(),
                      "the file ends here, wanted " + std::string(wanted) + " of a BVH motion");
    scanner_.Fail(found, wanted);
  }

  // From the name of the root to its closing brace; the stack is our own, for
  // files nested to any depth.
  void ReadHierarchy() {
    std::vector<int> open;
    OpenJoint(-1, &open);
    while (!open.empty()) {
      const std::string_view word = scanner_.WordOnAnyLine();
      const int b = open.back();
      if (EqualsIgnoringCase(word, "OFFSET")) {
        if (joints_[b].has_offset) scanner_.Fail(word, "one OFFSET a joint");
        joints_[b].has_offset = true;
        bones()[b].offset_m = ReadOffset();
      } else if (EqualsIgnoringCase(word, "CHANNELS")) {
        if (joints_[b].has_channels) scanner_.Fail(word, "one line CHANNELS a joint");
        joints_[b].has_channels = true;
        ReadChannels(b);
      } else if (EqualsIgnoringCase(word, "JOINT")) {
        OpenJoint(b, &open);
      } else if (EqualsIgnoringCase(word, "End")) {
        ReadEndSite(b);
      } else if (word == "}") {
        if (!joints_[b].has_offset) scanner_.Fail(word, "an OFFSET for every joint");
        open.pop_back();
      } else {
        FailOnWord(word, "OFFSET, CHANNELS, JOINT, End Site or }");
      }
    }
  }

  // Names may have blanks in them: the rest of the line, up to a brace.
  void OpenJoint(int parent, std::vector<int>* open) {
    std::string name;
    bool has_brace = false;
    while (!scanner_.AtLineEnd() && !has_brace) {
      std::string_view word = scanner_.Word();
      has_brace = word.ends_with('{');
      if (has_brace) word.remove_suffix(1);
      if (!name.empty() && !word.empty()) name += '_';
      name += word;
    }
    if (name.empty()) scanner_.Fail({}, "the name of the joint");
    if (!has_brace) ExpectWord("{");
    open->push_back(static_cast<int>(bones().size()));
    bones().push_back({.name = name, .parent = parent});
    joints_.emplace_back();
  }

  Eigen::Vector3d ReadOffset() {
    Eigen::Vector3d offset;
    for (double& value : offset) value = scanner_.Number("three numbers after OFFSET");
    scanner_.ExpectLineEnd();
    return offset * options_.metres_per_unit;
  }

  void ReadEndSite(int b) {
    ExpectWord("Site");
    ExpectWord("{");
    ExpectWord("OFFSET");
    bones()[b].tip_m = ReadOffset();
    ExpectWord("}");
  }

  void ReadChannels(int b) {
    const double count = scanner_.Number("the number of channels");
    if (count != std::floor(count) || count < 0 || count > 6)
      scanner_.FailAt(scanner_.line(), "found a wrong number of channels, wanted 0 to 6");
    std::vector<Dof>& channels = joints_[b].channels;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const std::string_view word = scanner_.Word();
      size_t kind = 0;
      while (kind < kChannelNames.size() && !EqualsIgnoringCase(word, kChannelNames[kind])) ++kind;
      if (kind == kChannelNames.size()) scanner_.Fail(word, kAnyChannel);
      for (const Dof& channel : channels)
        if (static_cast<size_t>(channel.kind) == kind) scanner_.Fail(word, "every channel once");
      channels.push_back({static_cast<Dof::Kind>(kind)});
    }
    scanner_.ExpectLineEnd();
    num_channels_ += channels.size();
    if (b > 0) bones()[b].dofs.assign(channels.rbegin(), channels.rend());
  }

  // Where there is no End Site.
  void SetTips() {
    std::vector<int> num_children(bones().size(), 0);
    std::vector<Eigen::Vector3d> sum_m(bones().size(), Eigen::Vector3d::Zero());
    for (const Bone& bone : bones()) {
      if (bone.parent < 0) continue;
      ++num_children[bone.parent];
      sum_m[bone.parent] += bone.offset_m;
    }
    for (size_t b = 0; b < bones().size(); ++b)
      if (num_children[b] > 0) bones()[b].tip_m = sum_m[b] / num_children[b];
  }

  void ReadMotion() {
    ExpectWord("MOTION");
    double wanted_frames = -1.0;
    int frames_line = 0;
    bool more = scanner_.NextLine();
    for (; more && !AtNumber(); more = scanner_.NextLine()) {
      const std::string_view word = scanner_.Word();
      if (EqualsIgnoringCase(word, "Frames:")) {
        wanted_frames = scanner_.Number("the number of frames");
        frames_line = scanner_.line();
      } else if (EqualsIgnoringCase(word, "Frame")) {
        ReadFrameTime();
      } else {
        scanner_.Fail(word, "Frames:, Frame Time: or the values of a frame");
      }
    }
    if (frames_line == 0)
      scanner_.FailAt(scanner_.line(), "found no line \"Frames: N\" in MOTION, wanted one");
    if (num_channels_ == 0) scanner_.FailAt(frames_line, "found no channels in any joint");
    for (pose_ = SkeletonPose::Rest(motion_.skeleton); more; more = scanner_.NextLine())
      ReadFrame();
    if (static_cast<double>(motion_.frames.size()) != wanted_frames)
      scanner_.FailAt(frames_line,
                      "found \"Frames: " + std::to_string(std::llround(wanted_frames)) + "\" and " +
                          std::to_string(motion_.frames.size()) +
                          " lines of values, wanted as many; the file may be cut short");
  }

  bool AtNumber() {
    return std::string_view("+-.0123456789").find(scanner_.PeekOnAnyLine()[0]) !=
           std::string_view::npos;
  }

  void ReadFrameTime() {
    const std::string_view word = scanner_.Word();
    if (!EqualsIgnoringCase(word, "Time:")) scanner_.Fail(word, "Time: after Frame");
    const double frame_time_s = scanner_.Number("the frame time in seconds");
    constexpr double kShortest_s = 1e-6, kLongest_s = 3600.0;
    if (frame_time_s < kShortest_s || frame_time_s > kLongest_s)
      scanner_.FailAt(scanner_.line(), "found a frame time of " + std::to_string(frame_time_s) +
                                           " s, wanted one between 1e-6 and 3600");
    motion_.frame_time_s = frame_time_s;
  }

  void ReadFrame() {
    Eigen::Index first_dof = 0;
    for (size_t b = 0; b < bones().size(); ++b) {
      const std::vector<Dof>& channels = joints_[b].channels;
      std::array<double, 6> values{};
      for (size_t i = 0; i < channels.size(); ++i) values[i] = ReadValue(channels[i]);
      if (b == 0) {
        SetRoot(values.data());
        continue;
      }
      const auto last = first_dof + static_cast<Eigen::Index>(channels.size()) - 1;
      for (size_t i = 0; i < channels.size(); ++i) {
        const double rest_m =
            channels[i].IsRotation() ? 0.0 : bones()[b].offset_m[channels[i].Axis()];
        pose_.dofs[last - static_cast<Eigen::Index>(i)] = values[i] - rest_m;
      }
      first_dof = last + 1;
    }
    if (!scanner_.AtLineEnd())
      scanner_.Fail(scanner_.Word(),
                    "the end of the frame after " + std::to_string(num_channels_) + " values");
    motion_.frames.push_back(pose_);
  }

  double ReadValue(const Dof& channel) {
    if (scanner_.AtLineEnd())
      scanner_.Fail({}, "a value for each of the " + std::to_string(num_channels_) + " channels");
    return scanner_.Number("a number") *
           (channel.IsRotation() ? kRadFromDeg : options_.metres_per_unit);
  }

  void SetRoot(const double* values) {
    const std::vector<Dof>& channels = joints_[0].channels;
    pose_.root_in_world_m = bones()[0].offset_m;
    std::vector<Dof> inner_first(channels.rbegin(), channels.rend());
    std::array<double, 6> reversed{};
    for (size_t i = 0; i < channels.size(); ++i) {
      reversed[channels.size() - 1 - i] = values[i];
      if (!channels[i].IsRotation()) pose_.root_in_world_m[channels[i].Axis()] = values[i];
    }
    pose_.world_from_root = RotationOfDofs(inner_first, reversed.data());
  }

  TextScanner scanner_;
  const BvhReadOptions options_;
  Motion motion_;
  std::vector<Joint> joints_;
  size_t num_channels_ = 0;
  SkeletonPose pose_;
};

}  // namespace

Motion ReadBvh(const std::filesystem::path& path, const BvhReadOptions& options) {
  return BvhReader(path, options).Read();
}

}  // namespace poselift
