// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/dictionary.h"
#include "lift/eval/evaluate_sequence.h"

namespace poselift::cli {

// The methods that `evaluate sequence` compares, in the order of the table: every
// frame lifted alone, then filters of its joints, or of the labels before it. The
// dictionary must outlive them.
std::vector<NamedSequenceMethod> SequenceMethods(const Dictionary& dictionary);

}  // namespace poselift::cli
