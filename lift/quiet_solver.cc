// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/quiet_solver.h"

#include <glog/logging.h>

namespace poselift {

void QuietSolver() { FLAGS_minloglevel = google::GLOG_FATAL; }

}  // namespace poselift
