// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/body_tags.h"

#include <algorithm>

namespace poselift {

const BodyTag* BodyTags::Find(int id) const {
  const auto found =
      std::find_if(tags.begin(), tags.end(), [&](const BodyTag& tag) { return tag.id == id; });
  return found == tags.end() ? nullptr : &*found;
}

}  // namespace poselift
