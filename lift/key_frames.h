// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <vector>

#include "lift/lift_labels.h"
#include "lift/lift_photo.h"
#include "src/labels.h"
#include "src/progress.h"

namespace poselift {

// Key frames: poses without pictures, of pins (src/labels.h), that are to become a motion. Each
// sits on a frame of it, FrameLabels::frame, and time_s says when that is: so they tell the rate.
bool AreKeyFrames(const Labels& labels);

// When key frames are.
struct KeyTimes {
  static constexpr double kFps = 30.0, kGap_s = 0.5;  // of those that say nothing
  static constexpr int kMostNumber = 36000;           // 20 minutes at 30 frames a second

  double fps = kFps;
  std::vector<int> numbers;  // of the motion's frames, one a key frame; they grow

  double Time_s(int number) const { return number / fps; }
  int Gap() const;  // kGap_s in frames
  // The last key frame that is not behind the number, else the first.
  size_t KeyAt(int number) const;
};

// Where frames are not said they follow from the times, and without those lie kGap_s apart;
// fps_unsaid is the rate where no key frame but one at 0 tells it.
KeyTimes KeyTimesOf(const Labels& labels, double fps_unsaid = KeyTimes::kFps);

// All frames of the motion, from the first key frame to the last. Each person is at their key
// frames as those are lifted by themselves; in between, every angle goes along a MonotoneCurve
// through them. A key frame that cannot be lifted does not count. Throws InputError for more than
// kMostNumber frames; what progress throws comes through.
LiftedLabels LiftKeyFrames(const PhotoLifter& lifter, const Labels& labels,
                           const ProgressFn& progress);

}  // namespace poselift
