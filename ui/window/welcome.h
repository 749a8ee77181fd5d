// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QDialog>
#include <filesystem>
#include <string>
#include <vector>

namespace poselift {

// Who starts without a picture is asked for one, and told how labelling goes.
class Welcome : public QDialog {
  Q_OBJECT

 public:
  // sample: a picture to try it with; empty when there is none.
  explicit Welcome(std::filesystem::path sample, QWidget* parent = nullptr);

  // What was chosen, for FindLabelsFile; empty when nothing was.
  const std::vector<std::string>& inputs() const { return inputs_; }
  // Pictures and labels files, by a dialog; empty when nothing was chosen.
  static std::vector<std::string> AskForPictures(QWidget* parent);

 private:
  void TrySample();

  std::filesystem::path sample_;
  std::vector<std::string> inputs_;
};

// The sample picture that came with the program; empty where there is none.
std::filesystem::path SamplePicture();

// A copy in a folder of one's own, for the labels are written beside it; one that is there stays.
// Throws InputError when it cannot be made.
std::filesystem::path CopyOfSample(const std::filesystem::path& sample,
                                   const std::filesystem::path& folder);

}  // namespace poselift
