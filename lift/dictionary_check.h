// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "lift/dictionary.h"

namespace poselift {

// What no dictionary may be, in one line ("atom 3 has norm 0.5, wanted 1"), or
// "" when all is well:
//  - atoms: 69 rows, at least one column, finite, each of norm 1 (to 1e-6);
//  - skeleton: no SkeletonFlaw (skeleton_check.h);
//  - typical norm: more than 0, at most 100 m;
//  - prior: none, or a mean of 69 and a whitening of 69 x 69 finite numbers;
//  - training record: no negative number, a finite error.
std::string DictionaryFlaw(const Dictionary& dictionary);

}  // namespace poselift
