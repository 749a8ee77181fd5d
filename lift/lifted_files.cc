// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lifted_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "lift/key_frames.h"
#include "src/input_error.h"
#include "src/io/angles_csv.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

constexpr std::array kFormats = {LiftedFormat{".bvh", "Motion (BVH)"},
                                 LiftedFormat{".amc", "Motion with its skeleton (AMC, ASF)"},
                                 LiftedFormat{".csv", "Joint angles (CSV)"},
                                 LiftedFormat{".json", "Poses (JSON)"}};

bool AnyUsable(const LiftedLabels& lifted) {
  for (const auto& people : lifted.results)
    for (const LiftResult& result : people)
      if (result.IsUsable()) return true;
  return false;
}

bool IsCut(const FrameLabels& before, const FrameLabels& behind) {
  return (before.frame || behind.frame) && before.image != behind.image;
}

}  // namespace

FrameSpan FramesOfVideo(const Labels& labels, size_t frame) {
  const auto& frames = labels.frames;
  size_t first = frame, last = frame;
  while (first > 0 && !IsCut(frames[first - 1], frames[first])) --first;
  while (last + 1 < frames.size() && !IsCut(frames[last], frames[last + 1])) ++last;
  return {static_cast<int>(first), static_cast<int>(last)};
}

double FrameTime_s(const Labels& labels, double fps) {
  const auto& frames = labels.frames;
  const bool timed = frames.size() > 1 && frames.front().time_s && frames.back().time_s &&
                     *frames.back().time_s > *frames.front().time_s;
  if (!timed) return 1.0 / fps;
  return (*frames.back().time_s - *frames.front().time_s) / static_cast<double>(frames.size() - 1);
}

std::string WhyFramesAlone(const Labels& labels) {
  const auto& frames = labels.frames;
  if (AreKeyFrames(labels))
    return frames.size() > 1 ? "" : "found one key frame, wanted at least 2 to make a motion of";
  if (frames.size() <= 2)
    return fmt::format("found {} frames, wanted at least 3 to make a motion of", frames.size());
  if (const FrameSpan video = FramesOfVideo(labels, 0); video.NumFrames() < std::ssize(frames))
    return fmt::format("found frames of several videos, {} and {}, wanted those of one",
                       frames.front().image, frames[static_cast<size_t>(video.NumFrames())].image);
  const auto untimed = std::ranges::find_if(
      frames, [](const FrameLabels& frame) { return !frame.time_s.has_value(); });
  if (untimed != frames.end())
    return fmt::format("found no time of frame {}, wanted the times of all frames, as of a video",
                       untimed - frames.begin() + 1);
  constexpr double kAnyFps = 30.0;  // they have times
  const double frame_time_s = FrameTime_s(labels, kAnyFps);
  if (frame_time_s <= SequenceLifter::kLongestFrameTime_s) return "";
  return fmt::format("found {:.2g} s between frames, wanted at most {} to make a motion of",
                     frame_time_s, SequenceLifter::kLongestFrameTime_s);
}

void WriteLifted(const LiftedLabels& lifted, const Labels& labels, const Skeleton& skeleton,
                 bool is_motion, double fps, const std::filesystem::path& folder,
                 const ProgressFn& progress) {
  Motion motion;
  if (AnyUsable(lifted))
    motion = is_motion ? ToMotionOverTime(lifted, skeleton, progress)
                       : ToMotion(lifted, skeleton, FrameTime_s(labels, fps));
  if (progress) progress(1.0);
  WritePosesJson(lifted.poses, folder / "poses.json");
  WriteAnglesCsv(lifted.poses, folder / "angles.csv");
  if (is_motion && !lifted.key_frame_time_s)
    WriteAnglesSigmaCsv(lifted.poses, folder / "angles_sigma.csv");
  if (motion.frames.empty()) return;
  WriteMotion(motion, folder / "poses.bvh");
  WriteMotion(motion, folder / "poses.amc");
}

std::span<const LiftedFormat> LiftedFormats() { return kFormats; }

void WriteLiftedMotion(const LiftedLabels& lifted, const Skeleton& skeleton,
                       const std::filesystem::path& path, const ProgressFn& progress) {
  const std::string ending = path.extension().string();
  std::vector<std::string_view> endings;
  for (const LiftedFormat& format : kFormats) endings.push_back(format.ending);
  if (std::ranges::none_of(
          endings, [&](std::string_view known) { return EqualsIgnoringCase(ending, known); }))
    throw InputError(path, fmt::format("found the ending {}, wanted one of {}", Quoted(ending),
                                       fmt::join(endings, ", ")));
  if (!AnyUsable(lifted)) throw InputError(path, "found no pose to write, wanted a lifted motion");
  if (EqualsIgnoringCase(ending, ".json")) return WritePosesJson(lifted.poses, path);
  if (EqualsIgnoringCase(ending, ".csv")) return WriteAnglesCsv(lifted.poses, path);
  WriteMotion(ToMotionOverTime(lifted, skeleton, progress), path);
}

}  // namespace poselift
