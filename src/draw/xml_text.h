// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>
#include <string_view>

namespace poselift {

// Text that XML takes: its own characters written out, control characters and
// what is no UTF-8 replaced.
std::string EscapedXml(std::string_view text);

}  // namespace poselift
