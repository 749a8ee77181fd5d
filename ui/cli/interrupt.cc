// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/interrupt.h"

#include <atomic>
#include <csignal>

namespace poselift::cli {
namespace {

std::atomic<bool> stop_asked = false;  // NOLINT(readability-identifier-naming): a variable
static_assert(std::atomic<bool>::is_always_lock_free);

void Stop(int) { stop_asked = true; }

}  // namespace

Interrupt::Interrupt()
    : int_before_(std::signal(SIGINT, Stop)), term_before_(std::signal(SIGTERM, Stop)) {
  stop_asked = false;
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, int_before_);
  std::signal(SIGTERM, term_before_);
}

bool Interrupt::asked() const { return stop_asked; }

}  // namespace poselift::cli
