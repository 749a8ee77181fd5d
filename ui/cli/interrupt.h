// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

namespace poselift::cli {

// While it lives, SIGINT and SIGTERM end a loop over a camera, which asks `asked`, and not
// the program. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const;

 private:
  using Handler = void (*)(int);
  Handler int_before_, term_before_;
};

}  // namespace poselift::cli
