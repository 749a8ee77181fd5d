// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/recognisers.h"

#include <array>
#include <nlohmann/json.hpp>

namespace poselift::cli {

std::span<const Recogniser> Recognisers() {
  static constexpr std::array kRecognisers = {
      Recogniser{"BVH motion", IsBvh, DescribeBvh},
      Recogniser{"ASF skeleton", IsAsf, DescribeAsf},
      Recogniser{"AMC motion", IsAmc, DescribeAmc},
  };
  return kRecognisers;
}

}  // namespace poselift::cli
