// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/progress.h"
#include "ui/label/frame_times.h"
#include "ui/label/label_project.h"

namespace poselift {

// The labels file that a person who gives these inputs works on: a labels file itself, or pictures
// and folders of them, in natural order. Of one picture NAME.jpg it is NAME.labels.json beside it,
// of a folder labels.json in it, unless `labels_file` says another. It may not be there yet. Throws
// InputError for inputs that are none.
std::filesystem::path LabelsFileOf(const std::vector<std::string>& inputs,
                                   const std::string& labels_file);

// The same; one that is not there is made, with the pictures and without labels. `layout` names its
// landmarks.
//
// That may take a while: of videos every frame's time is read, and goes to `times` too.
//
// Throws InputError also for pictures that cannot be read. What progress throws comes out, and no
// file is made.
std::filesystem::path FindLabelsFile(const std::vector<std::string>& inputs,
                                     const std::string& labels_file, const std::string& layout,
                                     const ProgressFn& progress = {}, VideoTimes* times = nullptr);

// Puts those pictures and videos of the inputs that the project does not have behind its frames, as
// one step. One whose picture is missing has that of the same name: Relink finds it. What cannot
// be read is left out and told (messages()). Throws what progress throws, and adds nothing then.
void AddNewPictures(const std::vector<std::string>& inputs, LabelProject* project,
                    const ProgressFn& progress = {}, VideoTimes* times = nullptr);

}  // namespace poselift
