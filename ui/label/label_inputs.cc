// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_inputs.h"

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

// One of a picture; of a video all that it has.
void AddFrames(const fs::path& picture, const fs::path& labels_file, Labels* labels) {
  const fs::path folder = fs::absolute(labels_file).parent_path();
  FrameLabels frame{.image = fs::absolute(picture).lexically_relative(folder).string()};
  if (!IsVideoFile(picture)) {
    const cv::Mat bgr = ReadImage(picture);
    frame.width_px = bgr.cols;
    frame.height_px = bgr.rows;
    labels->frames.push_back(std::move(frame));
    return;
  }
  const cv::Size size_px = VideoFile(picture).size_px();
  frame.width_px = size_px.width;
  frame.height_px = size_px.height;
  frame.frame = 0;
  for (const double time_s : ReadFrameTimes(picture)) {
    frame.time_s = time_s;
    labels->frames.push_back(frame);
    ++*frame.frame;
  }
}

}  // namespace

fs::path FindLabelsFile(const std::vector<std::string>& inputs, const std::string& labels_file,
                        const std::string& layout) {
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
  for (const fs::path& picture : pictures) AddFrames(picture, file, &labels);
  PrepareFolderOf(file);
  CreateLabelsFile(file, labels);
  return file;
}

}  // namespace poselift
