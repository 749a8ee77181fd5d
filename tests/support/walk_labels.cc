// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/walk_labels.h"

#include "src/io/labels.h"
#include "tests/support/support.h"
#include "ui/label/label_project.h"

namespace poselift::testing {

Labels ShortWalk(int num_frames, int gap) {
  Labels walk = ReadLabels(SourcePath("samples/walk/walk-side.every-frame.labels.json"));
  constexpr std::ptrdiff_t kFirst = 40;
  walk.frames.erase(walk.frames.begin(), walk.frames.begin() + kFirst);
  walk.frames.resize(static_cast<size_t>(num_frames));
  for (int f = gap; gap >= 0 && f < gap + 3; ++f)
    walk.frames[static_cast<size_t>(f)].people.clear();
  return walk;
}

std::filesystem::path FreshLabelsFile(const std::filesystem::path& folder, const Labels& labels) {
  const auto file = folder / "walk.labels.json";
  for (const char* left : {"walk.labels.json", ".walk.labels.json.journal"})
    std::filesystem::remove(folder / left);
  CreateLabelsFile(file, labels);
  return file;
}

}  // namespace poselift::testing
