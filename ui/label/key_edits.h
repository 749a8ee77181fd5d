// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/key_frames.h"
#include "src/labels.h"
#include "ui/label/label_history.h"

namespace poselift {

// Changes of key frames (lift/key_frames.h), as edits with a name that a menu can show. Where
// there are none, and where it says so, they throw std::invalid_argument. times: of the labels.

// One with these people at the number: the motion's frame. Where a key frame is there already it,
// and what follows it closely, goes on by a frame. "add key frame 3"
LabelEdit AddKeyFrame(const Labels& labels, const KeyTimes& times, int number,
                      std::vector<PersonLabels> people);
// Where a further one goes behind a key frame: half way to the next, or a gap behind the last.
int NumberBehind(const KeyTimes& times, size_t key);

// The others stay when they are. Of the last one there is no removing. "remove key frame 3"
LabelEdit RemoveKeyFrame(const Labels& labels, const KeyTimes& times, size_t key);

// To the number, or as near as the key frames around let it; with all behind it, these go along
// and only the one before stops it. What is done in a row is one step. "move key frame 3"
enum class Along { kAlone, kAllBehind };
LabelEdit MoveKeyFrame(const Labels& labels, KeyTimes times, size_t key, int number, Along along);

// Another rate: all stay when they are, as near as frames of it are. "24 frames a second"
LabelEdit ChangeKeyRate(const Labels& labels, const KeyTimes& times, double fps);

}  // namespace poselift
