// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/person_motion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>

#include "lift/default_dictionary.h"
#include "lift/key_frames.h"
#include "lift/lift_sequence.h"
#include "lift/lifted_files.h"
#include "lift/poses_to_motion.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/input_error.h"
#include "src/joint_angles.h"

namespace poselift {
namespace {

// FNV-1a.
class Mark {
 public:
  void Add(std::string_view bytes) {
    for (const char byte : bytes) AddByte(static_cast<unsigned char>(byte));
    AddByte(0);
  }
  void Add(double value) {
    auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) AddByte(bits & 0xff);
  }
  std::uint64_t value() const { return value_; }

 private:
  void AddByte(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001b3; }

  std::uint64_t value_ = 0xcbf29ce484222325;
};

void AddPerson(const PersonLabels& person, Mark* mark) {
  for (const LandmarkLabel& label : person.landmarks) {
    mark->Add(label.name);
    mark->Add(label.x_px.x());
    mark->Add(label.x_px.y());
    mark->Add(static_cast<double>(label.state));
    mark->Add(label.radius_px.value_or(-1.0));
  }
  for (const LabelHint& hint : person.hints) {
    mark->Add(static_cast<double>(hint.kind));
    mark->Add(hint.joint);
    mark->Add(hint.other);
    mark->Add(hint.metres_m.value_or(-1.0));
    for (const double x_m : hint.x_in_cam_m) mark->Add(x_m);
  }
}

// What there is to say of the frames, from what `lift` would write.
void ReadAngles(PersonMotion* motion) {
  const auto& frames = motion->lifted.poses.frames;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto first = static_cast<size_t>(motion->video.first);
  const auto num_columns = static_cast<Eigen::Index>(first + frames.size());
  motion->times_s = Eigen::VectorXd::Constant(num_columns, unknown);
  motion->angles_deg = motion->angles_sigma_deg =
      Eigen::MatrixXd::Constant(std::ssize(JointAngles()), num_columns, unknown);
  motion->is_filled.assign(first + frames.size(), false);
  for (size_t f = 0; f < frames.size(); ++f) {
    const auto column = static_cast<Eigen::Index>(first + f);
    motion->times_s[column] = frames[f].time_s.value_or(unknown);
    if (frames[f].people.empty()) continue;
    const PersonPose& person = frames[f].people.front();
    motion->is_filled[first + f] = person.status == kFilledStatus;
    for (size_t a = 0; a < person.angles_deg.size(); ++a)
      motion->angles_deg(static_cast<Eigen::Index>(a), column) = person.angles_deg[a].second;
    for (size_t a = 0; a < person.angles_sigma_deg.size(); ++a)
      motion->angles_sigma_deg(static_cast<Eigen::Index>(a), column) =
          person.angles_sigma_deg[a].second;
  }
}

}  // namespace

const LiftedPose* PersonMotion::PoseOf(size_t frame) const {
  const auto first = static_cast<size_t>(video.first);
  if (frame < first || frame - first >= lifted.results.size()) return nullptr;
  const auto& people = lifted.results[frame - first];
  if (people.empty()) return nullptr;
  const LiftResult& result = people.front();
  return result.IsUsable() ? &result.poses.front() : nullptr;
}

double PersonMotion::Sigma_deg(size_t frame) const {
  const auto column = static_cast<Eigen::Index>(frame);
  if (column >= angles_sigma_deg.cols()) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(angles_sigma_deg.col(column).squaredNorm() /
                   static_cast<double>(angles_sigma_deg.rows()));
}

Labels OnlyPerson(const Labels& labels, int person_id, const FrameSpan& frames) {
  const bool are_keys = AreKeyFrames(labels);  // whose pins say enough
  Labels alone = labels;
  alone.frames.resize(static_cast<size_t>(frames.last) + 1);
  alone.frames.erase(alone.frames.begin(), alone.frames.begin() + frames.first);
  for (FrameLabels& frame : alone.frames)
    std::erase_if(frame.people, [&](const PersonLabels& other) {
      return other.id != person_id || (other.landmarks.empty() && !are_keys);
    });
  return WithPeopleBetween(alone);
}

std::vector<std::uint64_t> LabelMarks(const Labels& labels, int person_id,
                                      const FrameSpan& frames) {
  std::vector<std::uint64_t> marks(labels.frames.size(), 0);
  const auto end = std::min(static_cast<size_t>(frames.last) + 1, marks.size());
  for (auto f = static_cast<size_t>(frames.first); f < end; ++f) {
    const FrameLabels& frame = labels.frames[f];
    Mark mark;
    mark.Add(frame.time_s.value_or(-1.0));
    mark.Add(frame.frame.value_or(-1));
    for (const PersonLabels& person : frame.people)
      if (person.id == person_id) AddPerson(person, &mark);
    marks[f] = mark.value();
  }
  return marks;
}

LiftedLabels LiftAsMotion(const PhotoLifter& lifter, const Labels& labels,
                          const ProgressFn& progress) {
  if (const std::string why = WhyFramesAlone(labels); !why.empty()) throw InputError(why);
  if (AreKeyFrames(labels)) return LiftKeyFrames(lifter, labels, progress);
  const MotionCodebook codebook = WithMirrored(ReadMotionCodebook(DefaultMotionModelPath()));
  return LiftLabelsOverTime(SequenceLifter(lifter, codebook), lifter.dictionary().skeleton,
                            WithPeopleBetween(labels), std::nullopt, progress);
}

PersonMotion LiftPersonAsMotion(const PhotoLifter& lifter, const Labels& labels, int person_id,
                                size_t frame, const ProgressFn& progress) {
  const FrameSpan video = FramesOfVideo(labels, frame);
  PersonMotion motion{
      .person_id = person_id, .video = video, .label_marks = LabelMarks(labels, person_id, video)};
  try {
    motion.lifted = LiftAsMotion(lifter, OnlyPerson(labels, person_id, video), progress);
  } catch (const InputError& error) {
    motion.message = error.what();
    return motion;
  }
  motion.message = "found no labels of the person, wanted at least four landmarks in some frames";
  for (auto& people : motion.lifted.results)
    for (LiftResult& result : people) {
      if (!result.IsUsable()) {
        if (!motion.message.empty()) motion.message = result.message;
        continue;
      }
      motion.message.clear();
      result.poses.resize(1);  // half an hour has many frames
    }
  ReadAngles(&motion);
  return motion;
}

}  // namespace poselift
