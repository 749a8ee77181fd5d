// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <string>

#include "src/labels.h"
#include "src/layout.h"
#include "src/skeleton.h"

namespace poselift {

// A key frame at 0, without a picture, and a person in it who stands, facing the camera, with the
// arms down: all joints pinned softly, for posing from nothing.
Labels NewPose(const Layout& layout, const Skeleton& skeleton);

// Makes a labels file of it where there is none yet. Throws InputError when it cannot be written,
// and for a layout that there is not.
void CreatePoseFile(const std::filesystem::path& file, const std::string& layout,
                    const Skeleton& skeleton);

}  // namespace poselift
