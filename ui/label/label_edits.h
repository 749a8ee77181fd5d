// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "src/labels.h"
#include "ui/label/label_history.h"

namespace poselift {

// The usual changes of labels, as edits with a name that a menu can show. The labels are not
// touched: LabelHistory::Apply does that.
//
// All places are pixels of the picture, integer = pixel centre. A frame that is not there throws
// std::out_of_range; where a person or a landmark must be there and is not, or the landmark is
// none of the layout, std::invalid_argument.

// A person of a frame. The id is the same in all frames of a video.
struct PersonRef {
  size_t frame = 0;
  int id = 0;
};

// Null when there is none.
const PersonLabels* FindPerson(const Labels& labels, PersonRef ref);
const LandmarkLabel* FindLandmark(const Labels& labels, PersonRef ref, std::string_view landmark);

// Puts the landmark there; the person too when it is new. "place left knee". Where a hand puts a
// landmark, no radius of a detector or of flow stays.
LabelEdit PlaceLandmark(const Labels& labels, PersonRef ref, std::string_view landmark,
                        const Eigen::Vector2d& x_px, LabelState state = LabelState::kVisible);
// The state stays, but what was absent is visible where it is put. "move left knee"
LabelEdit MoveLandmark(const Labels& labels, PersonRef ref, std::string_view landmark,
                       const Eigen::Vector2d& x_px);
// The same by a difference; nudges in a row are one step. "nudge left knee"
LabelEdit NudgeLandmark(const Labels& labels, PersonRef ref, std::string_view landmark,
                        const Eigen::Vector2d& step_px);

// Where it is, or was, stays. "mark left knee as occluded"
LabelEdit SetLandmarkState(const Labels& labels, PersonRef ref, std::string_view landmark,
                           LabelState state);
// visible -> occluded -> absent -> visible
LabelEdit CycleLandmarkState(const Labels& labels, PersonRef ref, std::string_view landmark);
// "remove left knee"
LabelEdit RemoveLandmark(const Labels& labels, PersonRef ref, std::string_view landmark);

// Without landmarks. std::invalid_argument when there is one of that id. "add person 2"
LabelEdit AddPerson(const Labels& labels, PersonRef ref);
LabelEdit RemovePerson(const Labels& labels, PersonRef ref);
// The smallest id from 0 that nobody has in the frame.
int FreePersonId(const Labels& labels, size_t frame);

// Hints of the person, as one step; HintsToFlip and HintsToChoose (lift/depth_mirror.h) give them
// for a limb and for an alternative. A new hint takes the place of one that says something else of
// the same: the bone's direction, which of two joints is nearer, where a joint is pinned, the
// height. "hint: left wrist nearer than right wrist", "4 hints"
LabelEdit GiveHints(const Labels& labels, PersonRef ref, const std::vector<LabelHint>& hints);
// std::out_of_range when there is no such hint. "forget: left wrist nearer than right wrist"
LabelEdit RemoveHint(const Labels& labels, PersonRef ref, size_t index);
// "forget the hints of person 1"
LabelEdit RemoveHints(const Labels& labels, PersonRef ref);

// Left landmarks become right ones and the other way round, in hints too. "swap left and right of
// person 1"
LabelEdit SwapSides(const Labels& labels, PersonRef ref);
// The labels of the mirrored picture: x_px -> width_px - 1 - x_px, sides swapped, pins mirrored, of
// all people.
// std::invalid_argument for a width below 1. "mirror labels"
LabelEdit MirrorFrame(const Labels& labels, size_t frame, int width_px);

// The whole person, absent landmarks too. Turned and scaled about PersonCenter; angles go from x to
// y, clockwise on the screen; turns in a row are one step, scalings too. "move person 1",
// "turn person 1", "scale person 1"
LabelEdit MovePerson(const Labels& labels, PersonRef ref, const Eigen::Vector2d& step_px);
LabelEdit RotatePerson(const Labels& labels, PersonRef ref, double angle_rad);
// factor > 0: radii grow with it.
LabelEdit ScalePerson(const Labels& labels, PersonRef ref, double factor);
// The middle of the box around what is not absent; around all when everything is.
Eigen::Vector2d PersonCenter(const PersonLabels& person);

// The person of the other frame, with states, radii and hints, into this frame, in the place of the
// one with the same id. "copy person 1 from frame 4" (counted from 1, as people do)
LabelEdit CopyPerson(const Labels& labels, PersonRef from, size_t to_frame);
// In the place of this person, whose id stays. "paste person 1"
LabelEdit PastePerson(const Labels& labels, PersonRef to, PersonLabels person);

}  // namespace poselift
