// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QDialog>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/capture/camera_list.h"

namespace poselift {

// Who starts without a picture is asked for one, and told how labelling goes.
class Welcome : public QDialog {
  Q_OBJECT

 public:
  // sample: a picture to try it with; empty when there is none.
  using ListFn = std::function<std::vector<CameraInfo>()>;
  explicit Welcome(
      std::filesystem::path sample, QWidget* parent = nullptr,
      ListFn cameras = [] { return ListCameras(); });

  // What was chosen, for FindLabelsFile; empty when nothing was.
  const std::vector<std::string>& inputs() const { return inputs_; }
  // Of a camera that was chosen; empty: none.
  const std::string& tags_file() const { return tags_file_; }
  const std::string& camera_file() const { return camera_file_; }
  // Pictures and labels files, by a dialog; empty when nothing was chosen.
  static std::vector<std::string> AskForPictures(QWidget* parent);

 private:
  void TrySample();
  void ChooseCamera();

  std::filesystem::path sample_;
  ListFn cameras_;
  std::vector<std::string> inputs_;
  std::string tags_file_, camera_file_;
};

// The sample picture that came with the program; empty where there is none.
std::filesystem::path SamplePicture();

// A copy in a folder of one's own, for the labels are written beside it; one that is there stays.
// Throws InputError when it cannot be made.
std::filesystem::path CopyOfSample(const std::filesystem::path& sample,
                                   const std::filesystem::path& folder);

}  // namespace poselift
