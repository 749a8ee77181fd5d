// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/label_inputs.h"

#include <set>
#include <utility>

#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/image.h"
#include "src/io/image_folder.h"
#include "src/io/video.h"
#include "src/translated.h"
#include "ui/label/label_relink.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> PicturesOf(const std::vector<std::string>& inputs) {
  std::vector<fs::path> pictures;
  for (const fs::path input : inputs) {
    if (fs::is_directory(input)) {
      const std::vector<fs::path> files = ListPictures(input);
      pictures.insert(pictures.end(), files.begin(), files.end());
    } else if (HasImageEnding(input) || IsVideoFile(input)) {
      pictures.push_back(input);
    } else {
      throw InputError(
          input, "found no picture, wanted pictures, folders of them, videos or a labels file");
    }
  }
  return pictures;
}

bool IsLabelsFile(const std::vector<std::string>& inputs) {
  return inputs.size() == 1 && fs::path(inputs[0]).extension() == ".json";
}

// All that the video has.
std::vector<double> AddFrames(const fs::path& path, FrameLabels frame, const ProgressFn& progress,
                              std::vector<FrameLabels>* frames) {
  const cv::Size size_px = VideoFile(path).size_px();
  frame.width_px = size_px.width;
  frame.height_px = size_px.height;
  frame.frame = 0;
  std::vector<double> times_s = ReadFrameTimes(path, progress);
  for (const double time_s : times_s) {
    frame.time_s = time_s;
    frames->push_back(frame);
    ++*frame.frame;
  }
  return times_s;
}

void AddPicture(const fs::path& path, FrameLabels frame, std::vector<FrameLabels>* frames) {
  const cv::Mat bgr = ReadImage(path);
  frame.width_px = bgr.cols;
  frame.height_px = bgr.rows;
  frames->push_back(std::move(frame));
}

// Their paths are relative to the folder.
std::vector<FrameLabels> FramesOf(const std::vector<fs::path>& pictures, const fs::path& folder,
                                  const ProgressFn& progress, VideoTimes* times) {
  std::vector<FrameLabels> frames;
  for (size_t i = 0; i < pictures.size(); ++i) {
    const auto so_far = [&](double part) {
      if (progress)
        progress((static_cast<double>(i) + part) / static_cast<double>(pictures.size()));
    };
    const std::string image = fs::absolute(pictures[i]).lexically_relative(folder).string();
    if (!IsVideoFile(pictures[i])) {
      AddPicture(pictures[i], {.image = image}, &frames);
    } else {
      auto times_s = AddFrames(pictures[i], {.image = image}, so_far, &frames);
      if (times) times->insert_or_assign(image, std::move(times_s));
    }
    so_far(1.0);
  }
  return frames;
}

// What the frames show, as it is on the disk; of what is missing there the name.
std::set<fs::path> PathsOf(const Labels& labels, const fs::path& labels_dir) {
  std::set<fs::path> paths;
  const std::string* before = nullptr;  // the frames of a video share one
  for (const FrameLabels& frame : labels.frames) {
    if (frame.image.empty() || (before && frame.image == *before)) continue;
    before = &frame.image;
    const fs::path path = ImagePath(frame, labels_dir);
    std::error_code ignored;
    paths.insert(fs::exists(path, ignored) ? fs::weakly_canonical(path) : path.filename());
  }
  return paths;
}

}  // namespace

fs::path LabelsFileOf(const std::vector<std::string>& inputs, const std::string& labels_file) {
  if (IsLabelsFile(inputs) && labels_file.empty()) return inputs[0];
  const std::vector<fs::path> pictures = PicturesOf(inputs);
  if (pictures.empty()) throw InputError("found no input, wanted pictures or a labels file");
  if (!labels_file.empty()) return labels_file;
  return inputs.size() == 1 && !fs::is_directory(inputs[0])
             ? fs::path(pictures[0]).replace_extension(".labels.json")
             : pictures[0].parent_path() / "labels.json";
}

fs::path FindLabelsFile(const std::vector<std::string>& inputs, const std::string& labels_file,
                        const std::string& layout, const ProgressFn& progress, VideoTimes* times) {
  fs::path file = LabelsFileOf(inputs, labels_file);
  if (fs::exists(file) || IsLabelsFile(inputs)) return file;
  PrepareFolderOf(file);
  CreateLabelsFile(file, {layout, FramesOf(PicturesOf(inputs), fs::absolute(file).parent_path(),
                                           progress, times)});
  return file;
}

void AddNewPictures(const std::vector<std::string>& inputs, LabelProject* project,
                    const ProgressFn& progress, VideoTimes* times) {
  if (IsLabelsFile(inputs)) return;
  const std::set<fs::path> known = PathsOf(project->labels(), project->dir());
  std::vector<fs::path> pictures = PicturesOf(inputs);
  std::erase_if(pictures, [&](const fs::path& picture) {
    return known.contains(fs::weakly_canonical(picture)) || known.contains(picture.filename());
  });
  LabelEdit edit{.name = Translated("add pictures")};
  for (const fs::path& picture : pictures) try {
      const auto frames = FramesOf({picture}, project->dir(), progress, times);
      edit.added.insert(edit.added.end(), frames.begin(), frames.end());
    } catch (const InputError& error) {
      project->Tell(Translated("not added: {}", error.what()));
    }
  project->Apply(std::move(edit));
}

}  // namespace poselift
