// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "lift/camera_track.h"
#include "lift/person_ik.h"
#include "lift/pose_to_person.h"
#include "lift/temporal/online_smoother.h"
#include "src/poses.h"

namespace poselift {

// One person of lifted poses, smoothed as the frames arrive (OnlineSmoother), in
// constant memory. The camera is what the person's first frame says of it.
class PersonStream {
 public:
  // person_id: else the first that is seen. codebook: with its mirror images. Throws
  // InputError for wrong options and for a codebook of another skeleton.
  PersonStream(const Skeleton& skeleton, std::shared_ptr<const MotionCodebook> codebook,
               std::optional<int> person_id, const MotionFilterOptions& options);

  // frame: with its time. Throws InputError when time does not go on.
  void Add(FramePoses frame);
  void End() { smoother_.End(); }  // no more frames come
  // The oldest frame that has waited for long enough, with this person alone: "ok",
  // kFilledStatus or kUnknownStatus.
  std::optional<FramePoses> Take();

 private:
  struct Waiting {
    double time_s = 0.0;
    std::string image;
    double scale_px_per_m = kUnknown;
  };

  const PersonPose* Find(const FramePoses& poses);

  Skeleton skeleton_;
  PersonIk ik_;
  OnlineSmoother smoother_;
  std::optional<int> person_id_;
  CameraTrack camera_;
  PoseToPerson to_person_;
  double scale_px_per_m_ = kUnknown;
  std::deque<Waiting> waiting_;
};

}  // namespace poselift
