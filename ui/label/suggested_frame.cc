// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/suggested_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace poselift {
namespace {

bool IsLabelled(const FrameLabels& frame, int person_id) {
  return std::ranges::any_of(frame.people, [&](const PersonLabels& person) {
    return person.id == person_id && !person.landmarks.empty() && !person.is_propagated;
  });
}

// How far each frame is from the nearest that is labelled; where none is, all are as far.
std::vector<size_t> Distances(const std::vector<bool>& is_labelled) {
  const size_t count = is_labelled.size();
  std::vector<size_t> distances(count, count);
  size_t away = count;
  const auto visit = [&](size_t f) {
    away = is_labelled[f] ? 0 : std::min(away + 1, count);
    distances[f] = std::min(distances[f], away);
  };
  for (size_t f = 0; f < count; ++f) visit(f);
  away = count;
  for (size_t f = count; f-- > 0;) visit(f);
  return distances;
}

}  // namespace

std::optional<size_t> SuggestedFrame(const Labels& labels, int person_id,
                                     const PersonMotion* motion) {
  std::vector<bool> is_labelled;
  for (const FrameLabels& frame : labels.frames)
    is_labelled.push_back(IsLabelled(frame, person_id));
  std::optional<size_t> least_sure;
  const bool is_of_person = motion && motion->person_id == person_id;
  for (size_t f = 0; is_of_person && f < is_labelled.size(); ++f) {
    if (is_labelled[f] || !std::isfinite(motion->Sigma_deg(f))) continue;
    if (!least_sure || motion->Sigma_deg(f) > motion->Sigma_deg(*least_sure)) least_sure = f;
  }
  if (least_sure) return least_sure;
  const std::vector<size_t> distances = Distances(is_labelled);
  const auto farthest = std::ranges::max_element(distances);
  if (farthest == distances.end() || *farthest == 0) return std::nullopt;
  return static_cast<size_t>(farthest - distances.begin());
}

}  // namespace poselift
