// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/tracking/worn_tags.h"
#include "src/observation.h"
#include "src/skeleton.h"

namespace poselift {

// What tags tell of joints, each tag by itself, for a lift out of nothing (PhotoLifter): a
// tag on a bone tells both its ends, by the likelier of its poses, and one by a joint tells that.
// Points are in cam, metres; their sigmas hold the noise of the picture, how loosely the tag
// sits, and that a tag which may lean either way tells little of what is far from it.
Observation ObserveTags(const std::vector<SeenTag>& seen, const Skeleton& skeleton);

}  // namespace poselift
