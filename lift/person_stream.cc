// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/person_stream.h"

#include <cmath>
#include <utility>

#include "lift/body_smoothing.h"
#include "lift/poses_to_motion.h"
#include "src/input_error.h"

namespace poselift {

PersonStream::PersonStream(const Skeleton& skeleton, std::shared_ptr<const MotionCodebook> codebook,
                           std::optional<int> person_id, const MotionFilterOptions& options)
    : skeleton_(skeleton),
      ik_(skeleton),
      smoother_(codebook, options),
      person_id_(person_id),
      camera_{.centre_px = Eigen::Vector2d::Constant(kUnknown)},
      to_person_(skeleton) {
  if (!IsSameBody(skeleton, codebook->skeleton))
    throw InputError(
        "found a dictionary and a motion model of different skeletons, wanted one skeleton: learn "
        "both from the same motions");
}

void PersonStream::Add(FramePoses frame) {
  SkeletonPose pose = UnknownPose(skeleton_);
  if (const PersonPose* person = Find(frame)) {
    // For good: what is measured from must not move.
    if (!camera_.centre_px.allFinite()) camera_ = FindCamera({person});
    pose = ik_.Solve(*person, camera_);
    if (std::isfinite(person->scale_px_per_m)) scale_px_per_m_ = person->scale_px_per_m;
  }
  smoother_.Add(*frame.time_s, pose);
  waiting_.push_back({*frame.time_s, std::move(frame.image), scale_px_per_m_});
}

std::optional<FramePoses> PersonStream::Take() {
  using Kind = SmoothedFrame::Kind;
  const auto frame = smoother_.Take();
  if (!frame) return std::nullopt;
  const Waiting source = std::move(waiting_.front());
  waiting_.pop_front();
  PersonPose person;
  if (frame->kind != Kind::kNotKnown)
    person = to_person_.Convert(frame->pose, camera_, source.scale_px_per_m);
  else
    person.message = kUnknownMessage;
  person.id = person_id_.value_or(0);
  person.status = frame->kind == Kind::kMeasured ? "ok"
                  : frame->kind == Kind::kFilled ? kFilledStatus
                                                 : kUnknownStatus;
  return FramePoses{source.image, source.time_s, {std::move(person)}};
}

const PersonPose* PersonStream::Find(const FramePoses& poses) {
  for (const PersonPose& person : poses.people) {
    if (person.status != "ok") continue;
    if (!person_id_) person_id_ = person.id;
    if (person.id == *person_id_) return &person;
  }
  return nullptr;
}

}  // namespace poselift
