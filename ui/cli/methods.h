// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <vector>

#include "lift/lift_photo.h"

namespace poselift::cli {

// The lifting methods by name: "poselift", "paper" (no prior on the pose,
// several starts), "paper-one-start".
std::vector<std::string> MethodNames();
LiftPhotoOptions FindMethod(const std::string& name);

}  // namespace poselift::cli
