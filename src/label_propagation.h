// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <string>

#include "src/flow_follower.h"
#include "src/io/frame_source.h"
#include "src/labels.h"
#include "src/progress.h"

namespace poselift {

// From labels at some frames of a video, the key frames, to labels at every
// frame between and around them.
//
// A visible label is followed from its key frame forwards and backwards (see
// flow_follower.h). Between key frames A and B the place where a track meets the
// other label shows how far it drifted: d = label - track. It is set right by
// the Brownian bridge with this end, in proportion to its variance s,
//   x' = x + (s / S) d,   variance = c s (1 - s / S),
//   c = (2 + |d|^2 / (S + a^2 + b^2)) / 4
// with S = s at the end and a, b the standard deviations of the labels; c, 1 in
// the mean, says how much more it drifted than was expected. So both labels are
// met wherever the track went. Another estimate is the line between the labels,
// which is off by what a landmark accelerates:
//   standard deviation = acceleration * extent * (t - t_A) (t_B - t) / 2
//
// Track forwards, track backwards and line, as far as they are there, are blended
// with the inverses of their variances, each with that of the labels added. Their
// errors go together, so the blend's variance is the weighted mean of theirs and
// of their squared distances from it. It becomes radius_px, such that Observe
// (observation.h), which takes occluded labels for worse than their radius, has it
// as sigma.
//
// A label is visible where flow led to it and the nearer key frame has it
// visible, occluded where it is a guess.
struct PropagationOptions {
  double max_gap_s = 1.0;  // labels lead no farther; no line over a longer gap
  FlowOptions flow;
  double label_sigma = 0.012;  // of the extent, where a label has no radius_px
  double acceleration = 2.0;   // of a landmark (standard deviation), extents / s^2
  double max_sigma = 0.1;      // of the extent: what is known worse is absent

  std::string Validate() const;  // empty when all is well, else what is wrong
};

// keys: frames with `frame`, which frame of the video they are, growing. A person
// is the same where the id is. Extent: the larger side of the box around a
// person's labels.
//
// The result: the key frames as they are, with the video's times and size, all
// frames between them, and those before and behind as far as labels lead. People
// and landmarks of whom nothing is known are left out and absent.
//
// The video is read once, forwards, no farther than needed. What is held are the
// grey pictures of max_gap_s, a byte a pixel. Time is linear in the frames.
//
// Throws std::invalid_argument for keys without `frame` or out of order and for
// options that do not validate, InputError when the video ends before the last key.
Labels PropagateLabels(const Labels& keys, FrameSource* video,
                       const PropagationOptions& options = {}, const ProgressFn& progress = {});

}  // namespace poselift
