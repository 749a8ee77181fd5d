// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/lift_inputs.h"

#include <algorithm>
#include <array>
#include <map>

#include "src/input_error.h"
#include "src/io/labels.h"
#include "src/io/text_scanner.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

bool IsPictureName(const fs::path& path) {
  constexpr std::array<std::string_view, 9> kEndings = {".jpg",  ".jpeg", ".png", ".bmp", ".tif",
                                                        ".tiff", ".webp", ".ppm", ".pgm"};
  const std::string ending = path.extension();
  return std::any_of(kEndings.begin(), kEndings.end(),
                     [&](std::string_view known) { return EqualsIgnoringCase(ending, known); });
}

std::vector<fs::path> FindPictures(const std::vector<std::string>& inputs) {
  std::vector<fs::path> pictures;
  for (const fs::path input : inputs) {
    if (!fs::is_directory(input)) {
      if (!fs::exists(input)) throw InputError(input, "found no such file, wanted a picture");
      pictures.push_back(input);
      continue;
    }
    const size_t before = pictures.size();
    for (const auto& entry : fs::directory_iterator(input))
      if (IsPictureName(entry.path())) pictures.push_back(entry.path());
    if (pictures.size() == before) throw InputError(input, "found no picture in this folder");
    std::sort(pictures.begin() + static_cast<std::ptrdiff_t>(before), pictures.end());
  }
  return pictures;
}

// The pictures that the labels name themselves, where they are there.
std::vector<fs::path> NamedPictures(const Labels& labels, const fs::path& labels_file) {
  std::vector<fs::path> images;
  for (const FrameLabels& frame : labels.frames) {
    const fs::path image = labels_file.parent_path() / frame.image;
    images.push_back(!frame.image.empty() && fs::is_regular_file(image) ? image : fs::path());
  }
  return images;
}

LiftInputs MatchByName(const Labels& labels, const std::vector<fs::path>& pictures,
                       const std::string& labels_file) {
  LiftInputs matched{{labels.layout, {}}, pictures, {}};
  if (pictures.size() == 1 && labels.frames.size() == 1) {
    matched.labels.frames = labels.frames;
    return matched;
  }
  std::map<std::string, const FrameLabels*> by_name;
  for (const FrameLabels& frame : labels.frames) by_name[fs::path(frame.image).filename()] = &frame;
  for (const fs::path& picture : pictures) {
    const auto found = by_name.find(picture.filename());
    if (found == by_name.end())
      throw InputError(labels_file,
                       "found no frame for the picture " + picture.string() +
                           ", wanted one with \"image\": " + Quoted(picture.filename().string()));
    matched.labels.frames.push_back(*found->second);
  }
  return matched;
}

LiftInputs LabelsBeside(const std::vector<fs::path>& pictures, const std::string& layout) {
  LiftInputs inputs;
  for (const fs::path& picture : pictures) {
    fs::path file = picture;
    file.replace_extension(".labels.json");
    if (!fs::exists(file))
      throw InputError(
          picture, "found no labels: name a file with --labels, or put one at " + file.string());
    const Labels labels = ReadLabels(file, layout);
    if (!inputs.labels.layout.empty() && inputs.labels.layout != labels.layout)
      throw InputError(file, "found layout " + labels.layout + " after " + inputs.labels.layout +
                                 ", wanted one layout for all pictures: lift them one by one");
    LiftInputs one = MatchByName(labels, {picture}, file);
    inputs.labels.layout = labels.layout;
    inputs.labels.frames.push_back(one.labels.frames.front());
    inputs.images.push_back(picture);
  }
  return inputs;
}

}  // namespace

LiftInputs GatherInputs(const std::vector<std::string>& inputs, const std::string& labels_file,
                        const std::string& layout) {
  const std::vector<fs::path> pictures = FindPictures(inputs);
  if (labels_file.empty()) return LabelsBeside(pictures, layout);
  const Labels labels = ReadLabels(labels_file, layout);
  if (pictures.empty()) return {labels, NamedPictures(labels, labels_file), {}};
  return MatchByName(labels, pictures, labels_file);
}

}  // namespace poselift::cli
