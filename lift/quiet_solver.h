// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

namespace poselift {

// For programs: what Ceres logs of solves that fail, even of silent ones, is not for their users.
// They are told by the status of what was solved.
void QuietSolver();

}  // namespace poselift
