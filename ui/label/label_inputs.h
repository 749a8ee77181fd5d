// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/progress.h"
#include "ui/label/frame_times.h"

namespace poselift {

// The labels file that a person who gives these inputs works on: a labels file itself, or pictures
// and folders of them, in natural order. Of one picture NAME.jpg it is NAME.labels.json beside it,
// of a folder labels.json in it, unless `labels_file` says another. One that is not there yet is
// made, with the pictures and without labels; `layout` names its landmarks.
//
// That may take a while: of videos every frame's time is read. Those of a file that is made go to
// `times` too.
//
// Throws InputError for inputs that are none, and for a file of another format than poselift's
// own. What progress throws comes out, and no file is made.
std::filesystem::path FindLabelsFile(const std::vector<std::string>& inputs,
                                     const std::string& labels_file, const std::string& layout,
                                     const ProgressFn& progress = {}, VideoTimes* times = nullptr);

}  // namespace poselift
