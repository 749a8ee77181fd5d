// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <functional>

namespace poselift {

// How a function that may take long says how far it is: fraction done, from 0
// to 1, never falling. It may be called from several threads at once, and is
// empty when nobody listens.
using ProgressFn = std::function<void(double fraction)>;

}  // namespace poselift
