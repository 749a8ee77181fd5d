// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "lift/tracking/tag_fit.h"

namespace poselift {

// Whether a body can be a human's, and if not, what in the tags file is probably wrong. Of the
// ratios of its groups of bones (body_proportions.h) to the standard skeleton's:
//
//   size         their median: 0.50 (a child of three) to 1.23 (somebody of 2.1 m). A picture
//                knows no measure but the tags, so their wrong size makes all bones wrong alike.
//   proportions  each against the median: 0.75 to 1.33, five standard deviations of people; of
//                the forearm 0.6 to 1.67: people, and where hands end, differ more.
//   sides        a bone of the left against that of the right: 0.87 to 1.15.
//
// Empty: it can. person: a skeleton with the bones of standard.
std::string ImplausibleBody(const Skeleton& standard, const Skeleton& person);

// The same of a fit, and of its tags: one that no pose explains, that faces another way, or that is
// farther from where the tags file has it than anything on its bone, is worn on another bone.
inline constexpr double kWorstFit_px = 3.0;
inline constexpr double kFarthestMoved_mm = 250.0, kFarthestLeaned_deg = 75.0;
std::string ImplausibleFit(const Skeleton& standard, const TagFit& fit);

}  // namespace poselift
