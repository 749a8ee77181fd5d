// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/io/json_value.h"
#include "src/labels.h"
#include "src/layout.h"

namespace poselift {

// The formats behind ReadLabels, one file each. layout: null for auto.

bool IsNativeLabels(const JsonValue& root);
Labels ReadNativeLabels(const JsonValue& root, const Layout* layout);

// Pieces of poselift-labels, for files that hold changes of labels.
std::vector<PersonLabels> ReadNativePeople(const JsonValue& json, const Layout& layout);
FrameLabels ReadNativeFrame(const JsonValue& json, const Layout& layout);
void AppendNativePeople(const std::vector<PersonLabels>& people, std::string* out);
void AppendNativeFrame(const FrameLabels& frame, std::string* out);
// Empty, or why a person with the hints `before` cannot have this one as well.
std::string WhatIsWrongWith(const LabelHint& hint, std::span<const LabelHint> before,
                            const Layout& layout);
// Bound of a time in seconds.
inline constexpr double kLargestTime_s = 1e9;

bool IsCocoLabels(const JsonValue& root);
Labels ReadCocoLabels(const JsonValue& root, const Layout* layout);

// frames: each file's outermost value, one a frame.
bool IsOpenPose(const JsonValue& root);
FrameLabels ReadOpenPoseFrame(const JsonValue& root, const Layout** layout);
// Refuses coordinates that --keypoint_scale 3 or 4 made relative to the picture.
void RefuseRelativeScale(const Labels& labels, const std::string& file);

// Bounds of what a picture can hold: beyond them a file is broken.
inline constexpr double kLargestCoordinate_px = 1e6;
inline constexpr int kLargestPicture_px = 1000000;

// Below this score of a detector a point counts as guessed: LabelState::kOccluded.
inline constexpr double kGuessedBelowScore = 0.3;

// x, y and a detector's score: 0 for a point it has not found.
LandmarkLabel LandmarkFromScore(std::string_view name, const Eigen::Vector2d& x_px, double score);

// Of the layouts with that many landmarks the first; null when there is none.
const Layout* FindLayoutBySize(size_t num_landmarks);

// "body15 (15), coco17 (17), ..."
std::string LayoutSizes();

}  // namespace poselift
