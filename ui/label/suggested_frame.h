// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstddef>
#include <optional>

#include "src/labels.h"
#include "ui/label/person_motion.h"

namespace poselift {

// The frame where labels of the person would tell most: of those that nobody has labelled (what
// was propagated is no label of a person), the one that the motion is least sure of
// (PersonMotion::Sigma_deg); without a motion the one farthest, in frames, from any that has
// labels. Nothing when all have.
std::optional<size_t> SuggestedFrame(const Labels& labels, int person_id,
                                     const PersonMotion* motion);

}  // namespace poselift
