// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "lift/lift_photo.h"
#include "src/labels.h"
#include "src/progress.h"
#include "ui/label/label_edits.h"

namespace poselift {

// Labels of a person in frames where nobody said them, from the key frames: those where somebody
// did (PersonLabels::is_propagated is false and there are landmarks).
struct GuessedLabels {
  int id = 0;
  std::string name;                       // of the edit that puts them there
  std::map<size_t, PersonLabels> frames;  // without landmarks: nothing is known there
  bool replaces = false;                  // what a person said there, too
};

bool IsKeyFrame(const Labels& labels, PersonRef ref);
// The nearest key frame from ref on, itself not, within the same video or row of pictures; nothing
// when there is none.
std::optional<size_t> NextKeyFrame(const Labels& labels, PersonRef ref, int step);

// By optical flow (label_propagation.h), through the video of the frame, or the row of pictures of
// its size around it, which count as 30 a second.
// kAround: from all key frames of the person; else from this frame on until the next key frame.
// dir: of image paths. Throws InputError when ref, or nothing at all, is no key frame, and for
// pictures that cannot be read; what progress throws comes through.
enum class Reach { kAround, kForwards, kBackwards };
GuessedLabels FollowPerson(const Labels& labels, const std::filesystem::path& dir, PersonRef ref,
                           Reach reach, const ProgressFn& progress = {});

// Of the frame before, what has no label there as its 3D pose shows it, moved by the flow from its
// picture to this one; what the flow loses stays where it was, occluded. Replaces. Throws
// InputError when nothing is known of the person there.
GuessedLabels FollowFromFrameBefore(const Labels& labels, const std::filesystem::path& dir,
                                    PersonRef ref, const PhotoLifter& lifter);

// Between the key frames around ref (ref itself may be the first of them): their poses are lifted,
// the joint angles go evenly from one to the other (pose_between.h), seen by a camera that goes
// evenly too. Throws InputError where there are not two, or one cannot be lifted.
GuessedLabels PosesBetween(const Labels& labels, PersonRef ref, const PhotoLifter& lifter);

// One step.
LabelEdit PutGuesses(const Labels& labels, const GuessedLabels& guesses);
// Somebody looked, and they are right: a key frame. "accept person 1"
LabelEdit AcceptGuess(const Labels& labels, PersonRef ref);

}  // namespace poselift
