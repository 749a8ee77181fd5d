// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include "src/body_tags.h"
#include "src/skeleton.h"

namespace poselift {

// The standard skeleton with the lengths of bones that the tags file says. Throws InputError
// for a name that is no joint's and a length that is no bone's.
Skeleton PersonSkeleton(const Skeleton& standard, const BodyTags& tags);

}  // namespace poselift
