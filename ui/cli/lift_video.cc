// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/lift_video.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/input_error.h"
#include "src/io/labels.h"
#include "src/io/video.h"
#include "src/label_propagation.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

// Those of the video, where the file names several pictures.
std::vector<FrameLabels> FramesOf(const Labels& labels, const fs::path& video,
                                  const std::string& labels_file) {
  std::vector<FrameLabels> frames;
  for (const FrameLabels& frame : labels.frames)
    if (frame.image.empty() || fs::path(frame.image).filename() == video.filename())
      frames.push_back(frame);
  if (frames.empty())
    throw InputError(labels_file, fmt::format("found no frame of the video, wanted some with "
                                              "\"image\": \"{}\" and \"frame\" or \"time_s\"",
                                              video.filename().string()));
  return frames;
}

int NearestFrame(const std::vector<double>& times_s, double time_s,
                 const std::string& labels_file) {
  const auto next = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  const auto nearest = next == times_s.begin()                                          ? next
                       : next == times_s.end() || time_s - *(next - 1) < *next - time_s ? next - 1
                                                                                        : next;
  constexpr double kMostOff_s = 0.5;  // a label's time is somebody's reading
  if (std::abs(*nearest - time_s) > kMostOff_s)
    throw InputError(labels_file, fmt::format("found labels at {} s, wanted 0 to {:.3f} s", time_s,
                                              times_s.back()));
  return static_cast<int>(nearest - times_s.begin());
}

// Which frame of the video each is.
void Number(const fs::path& video, const std::string& labels_file,
            std::vector<FrameLabels>* frames) {
  const auto has_frame = [](const FrameLabels& f) { return f.frame.has_value(); };
  if (std::all_of(frames->begin(), frames->end(), has_frame)) return;
  const std::vector<double> times_s = ReadFrameTimes(video);
  const bool in_order = frames->size() == times_s.size() &&
                        std::none_of(frames->begin(), frames->end(),
                                     [](const auto& f) { return f.frame || f.time_s; });
  for (size_t i = 0; i < frames->size(); ++i) {
    FrameLabels& frame = (*frames)[i];
    if (in_order)
      frame.frame = static_cast<int>(i);
    else if (!frame.frame && frame.time_s)
      frame.frame = NearestFrame(times_s, *frame.time_s, labels_file);
    else if (!frame.frame)
      throw InputError(labels_file,
                       fmt::format("found {} frames without \"frame\" or \"time_s\", wanted one of "
                                   "them, or one for each of the video's {} frames",
                                   frames->size(), times_s.size()));
  }
}

void CheckFrames(cv::Size size_px, const std::string& labels_file,
                 const std::vector<FrameLabels>& frames) {
  for (size_t i = 0; i < frames.size(); ++i) {
    const FrameLabels& frame = frames[i];
    if (i > 0 && frame.frame == frames[i - 1].frame)
      throw InputError(labels_file, fmt::format("found labels of frame {} twice", *frame.frame));
    const bool fits = frame.width_px == 0 || frame.height_px == 0 ||
                      cv::Size(frame.width_px, frame.height_px) == size_px;
    if (!fits)
      throw InputError(labels_file,
                       fmt::format("found labels on {} x {} pixels, wanted the video's {} x {}",
                                   frame.width_px, frame.height_px, size_px.width, size_px.height));
  }
}

// Without propagation: the labelled frames with their times.
Labels Timed(Labels labels, VideoFile* video) {
  int index = 0;
  for (FrameLabels& frame : labels.frames) {
    std::optional<double> time_s;
    for (; index <= *frame.frame; ++index) time_s = video->Skip_s();
    if (!time_s)
      throw InputError(
          fmt::format("found labels of frame {}, but the video is shorter", *frame.frame));
    frame.time_s = time_s;
    frame.width_px = video->size_px().width;
    frame.height_px = video->size_px().height;
  }
  return labels;
}

}  // namespace

std::optional<fs::path> FindVideo(const std::vector<std::string>& inputs,
                                  const std::string& labels_file) {
  for (const std::string& input : inputs) {
    if (!IsVideoFile(input)) continue;
    if (inputs.size() > 1) throw InputError(input, "is a video: lift it on its own");
    return input;
  }
  if (!inputs.empty() || fs::is_directory(labels_file)) return std::nullopt;
  const Labels labels = ReadLabels(labels_file);
  if (labels.frames.empty() || labels.frames.front().image.empty()) return std::nullopt;
  const std::string& image = labels.frames.front().image;
  const bool same = std::all_of(labels.frames.begin(), labels.frames.end(),
                                [&](const FrameLabels& frame) { return frame.image == image; });
  const fs::path video = fs::path(labels_file).parent_path() / image;
  if (!same || !IsVideoFile(video)) return std::nullopt;
  return video;
}

LiftInputs GatherVideo(const fs::path& path, const VideoLabelsOptions& options,
                       const ProgressFn& progress) {
  VideoFile video(path);
  std::string labels_file = options.labels_file;
  if (labels_file.empty()) {
    labels_file = fs::path(path).replace_extension(".labels.json");
    if (!fs::exists(labels_file))
      throw InputError(path,
                       "found no labels: name a file with --labels, or put one at " + labels_file);
  }
  Labels keys = ReadLabels(labels_file, options.layout);
  keys.frames = FramesOf(keys, path, labels_file);
  Number(path, labels_file, &keys.frames);
  std::stable_sort(keys.frames.begin(), keys.frames.end(),
                   [](const auto& a, const auto& b) { return *a.frame < *b.frame; });
  CheckFrames(video.size_px(), labels_file, keys.frames);

  LiftInputs inputs;
  inputs.video = path;
  PropagationOptions propagation;
  propagation.max_gap_s = options.max_gap_s;
  inputs.labels = options.propagate ? PropagateLabels(keys, &video, propagation, progress)
                                    : Timed(std::move(keys), &video);
  inputs.images.resize(inputs.labels.frames.size());
  return inputs;
}

}  // namespace poselift::cli
