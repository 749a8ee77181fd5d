// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

namespace poselift {

// While one lives, what the whole process writes to stderr goes nowhere: for
// short calls into decoders that print to it (libpng, libjpeg and OpenCV all do,
// of files that are damaged or merely odd) and cannot be told not to. May be
// nested and used from several threads; the last one that goes restores stderr.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
};

}  // namespace poselift
