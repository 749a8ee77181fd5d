// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "calib/tag_sheet.h"
#include "src/body_tags.h"

namespace poselift {

// Sixteen tags of tag36h11 for a whole body, seen from 3 m at 1280 x 720, and where each is
// worn. The offsets are those of an adult of 1.75 m, right to some centimetres: `tags fit`
// measures them.
BodyTags DefaultBodyTags();

// What to print of the tags that a person wears. Those of the default set say where they go.
std::vector<SheetTag> SheetTagsOf(const BodyTags& tags);

}  // namespace poselift
