// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/board_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace poselift {
namespace {

std::string Text(const BoardCounts& counts) {
  return fmt::format("{} x {}", counts.rows, counts.columns);
}

struct MostSeen {
  BoardCounts counts;
  int times = 0;
};

MostSeen MostSeenOf(const BoardSurvey& survey) {
  std::vector<BoardCounts> seen = survey.larger;
  for (const BoardAbsence& absence : survey.absences)
    if (absence.seen) seen.push_back(*absence.seen);
  MostSeen most;
  for (const BoardCounts& counts : seen) {
    const int times = static_cast<int>(std::count(seen.begin(), seen.end(), counts));
    if (times > most.times) most = {counts, times};
  }
  return most;
}

bool IsPartOf(const BoardCounts& part, const BoardCounts& whole) {
  return std::min(part.rows, part.columns) <= std::min(whole.rows, whole.columns) &&
         std::max(part.rows, part.columns) <= std::max(whole.rows, whole.columns);
}

struct OtherTags {
  TagRange range;
  int times = 0;
};

// The family that most pictures show, with all its ids.
OtherTags OthersOf(const BoardSurvey& survey) {
  std::map<std::string, OtherTags> families;
  OtherTags most;
  for (const BoardAbsence& absence : survey.absences) {
    if (!absence.others) continue;
    OtherTags& tags =
        families.try_emplace(absence.others->family, OtherTags{*absence.others}).first->second;
    tags.range.first_id = std::min(tags.range.first_id, absence.others->first_id);
    tags.range.last_id = std::max(tags.range.last_id, absence.others->last_id);
    if (++tags.times >= most.times) most = tags;
  }
  return most;
}

std::string Text(const TagRange& tags) {
  return fmt::format("{} with ids {} to {}", tags.family, tags.first_id, tags.last_id);
}

}  // namespace

void BoardSurvey::AddFound(const BoardView& view) {
  ++num_found;
  if (view.part_of) larger.push_back(*view.part_of);
}

std::string FlawOfBoard(const BoardFinder& finder, const BoardSurvey& survey) {
  const int num_mirrored = static_cast<int>(
      std::count_if(survey.absences.begin(), survey.absences.end(),
                    [](const BoardAbsence& absence) { return absence.is_mirrored; }));
  if (num_mirrored > survey.num_found)
    return "the pictures are mirrored: the board is seen only when they are turned left to right; "
           "switch off the mirror of the camera or the program that took them";
  const size_t num_pictures = survey.absences.size() + static_cast<size_t>(survey.num_found);
  const MostSeen most = MostSeenOf(survey);
  if (most.times > survey.num_found - static_cast<int>(survey.larger.size())) {
    const BoardCounts said = finder.counts();
    std::string text =
        fmt::format("I see {} {} in {} of {} pictures, you said {}", Text(most.counts),
                    finder.counted(), most.times, num_pictures, Text(said));
    if (BoardCounts{most.counts.rows + 1, most.counts.columns + 1} == said)
      text += "; count the inner corners, where four squares meet, not the squares";
    else if (most.counts == BoardCounts{said.columns, said.rows})
      text += "; rows and columns are exchanged";
    else if (IsPartOf(most.counts, said))
      text += fmt::format(
          "; if the board has {}, show all of it: a part is hidden or outside of "
          "the pictures; else say {}",
          Text(said), Text(most.counts));
    else
      text += fmt::format("; say {} if that is the board", Text(most.counts));
    return text;
  }
  if (const OtherTags others = OthersOf(survey); others.times > survey.num_found)
    return fmt::format(
        "I see tags of {} in {} of {} pictures, you said {}: say the family, the "
        "first id, the rows and columns and the gaps that the board has",
        Text(others.range), others.times, num_pictures, finder.board().name);
  if (survey.num_found == 0)
    return fmt::format(
        "no board is visible in any of {} pictures: wanted a {}, whole, flat, sharp and evenly lit",
        survey.absences.size(), finder.board().name);
  return {};
}

std::string Describe(const BoardFinder& finder, const BoardAbsence& absence) {
  if (absence.is_mirrored) return "mirrored";
  if (absence.others) return fmt::format("tags of {} seen", Text(*absence.others));
  if (!absence.seen) return "no board seen";
  if (IsPartOf(*absence.seen, finder.counts()))
    return fmt::format("{} {} seen, not all of {}", Text(*absence.seen), finder.counted(),
                       Text(finder.counts()));
  return fmt::format("{} {} seen, not {}", Text(*absence.seen), finder.counted(),
                     Text(finder.counts()));
}

}  // namespace poselift
