// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <QImage>
#include <filesystem>

namespace poselift {

// A picture, upright as its EXIF orientation says. Throws InputError where it cannot be read.
QImage LoadPicture(const std::filesystem::path& path);

}  // namespace poselift
