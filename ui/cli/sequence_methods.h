// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/dictionary.h"
#include "lift/eval/evaluate_sequence.h"
#include "lift/lift_sequence.h"
#include "lift/temporal/motion_codebook.h"

namespace poselift::cli {

// The methods that `evaluate sequence` compares, in the order of the table: every
// frame lifted alone, then filters of its joints, or of the labels before it, then
// LiftSequence. Dictionary and codebook must outlive them.
std::vector<NamedSequenceMethod> SequenceMethods(const Dictionary& dictionary,
                                                 const MotionCodebook& codebook,
                                                 const LiftSequenceOptions& options);

}  // namespace poselift::cli
