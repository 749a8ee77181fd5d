// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_inputs.h"

#include <utility>

#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/image.h"
#include "src/io/image_folder.h"
#include "src/io/video.h"
#include "ui/label/label_project.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> PicturesOf(const std::vector<std::string>& inputs) {
  std::vector<fs::path> pictures;
  for (const fs::path input : inputs) {
    if (fs::is_directory(input)) {
      const ImageFolder folder(input);
      pictures.insert(pictures.end(), folder.files().begin(), folder.files().end());
    } else if (HasImageEnding(input) || IsVideoFile(input)) {
      pictures.push_back(input);
    } else {
      throw InputError(
          input, "found no picture, wanted pictures, folders of them, videos or a labels file");
    }
  }
  return pictures;
}

// All that the video has.
std::vector<double> AddFrames(const fs::path& path, FrameLabels frame, Labels* labels,
                              const ProgressFn& progress) {
  const cv::Size size_px = VideoFile(path).size_px();
  frame.width_px = size_px.width;
  frame.height_px = size_px.height;
  frame.frame = 0;
  std::vector<double> times_s = ReadFrameTimes(path, progress);
  for (const double time_s : times_s) {
    frame.time_s = time_s;
    labels->frames.push_back(frame);
    ++*frame.frame;
  }
  return times_s;
}

void AddPicture(const fs::path& path, FrameLabels frame, Labels* labels) {
  const cv::Mat bgr = ReadImage(path);
  frame.width_px = bgr.cols;
  frame.height_px = bgr.rows;
  labels->frames.push_back(std::move(frame));
}

}  // namespace

fs::path FindLabelsFile(const std::vector<std::string>& inputs, const std::string& labels_file,
                        const std::string& layout, const ProgressFn& progress, VideoTimes* times) {
  if (inputs.size() == 1 && fs::path(inputs[0]).extension() == ".json" && labels_file.empty())
    return inputs[0];
  const std::vector<fs::path> pictures = PicturesOf(inputs);
  if (pictures.empty()) throw InputError("found no input, wanted pictures or a labels file");
  fs::path file = labels_file;
  if (file.empty())
    file = inputs.size() == 1 && !fs::is_directory(inputs[0])
               ? fs::path(pictures[0]).replace_extension(".labels.json")
               : pictures[0].parent_path() / "labels.json";
  if (fs::exists(file)) return file;
  Labels labels{.layout = layout};
  PrepareFolderOf(file);
  const fs::path folder = fs::absolute(file).parent_path();
  for (size_t i = 0; i < pictures.size(); ++i) {
    const auto so_far = [&](double part) {
      if (progress)
        progress((static_cast<double>(i) + part) / static_cast<double>(pictures.size()));
    };
    const std::string image = fs::absolute(pictures[i]).lexically_relative(folder).string();
    if (!IsVideoFile(pictures[i])) {
      AddPicture(pictures[i], {.image = image}, &labels);
    } else {
      auto times_s = AddFrames(pictures[i], {.image = image}, &labels, so_far);
      if (times) times->insert_or_assign(image, std::move(times_s));
    }
    so_far(1.0);
  }
  CreateLabelsFile(file, labels);
  return file;
}

}  // namespace poselift
