// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/label_propagation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "src/input_error.h"
#include "src/observation.h"

namespace poselift {
namespace {

const PersonLabels* FindPerson(const FrameLabels* frame, int id) {
  if (!frame) return nullptr;
  for (const PersonLabels& person : frame->people)
    if (person.id == id) return &person;
  return nullptr;
}

const LandmarkLabel* FindLabel(const PersonLabels* person, const std::string& name) {
  if (!person) return nullptr;
  for (const LandmarkLabel& label : person->landmarks)
    if (label.name == name) return &label;
  return nullptr;
}

// A frame since the last key frame.
struct HeldFrame {
  int index = 0;
  double time_s = 0.0;
  cv::Mat grey;                        // empty once no key frame reaches it any more
  FollowedPoints forwards, backwards;  // from the key frames before and behind; or empty
};

// A key frame with its place in time.
struct Key {
  FrameLabels labels;
  double time_s = 0.0;
};

// What is known of a landmark at one key frame, and what came from there.
struct End {
  const LandmarkLabel* label = nullptr;  // null: absent
  double time_s = 0.0;
  double variance_px2 = 0.0;  // of the label
  FollowedPoint now;          // the track from here, at the frame in question
  FollowedPoint at_other;     // and at the other key frame
};

FollowedPoint Point(const FollowedPoints& points, const Key& key, int id, const std::string& name) {
  for (size_t p = 0; p < points.size(); ++p) {
    const PersonLabels& person = key.labels.people[p];
    if (person.id != id) continue;
    for (size_t l = 0; l < person.landmarks.size(); ++l)
      if (person.landmarks[l].name == name) return points[p][l];
  }
  return {};
}

// x' of the header.
FollowedPoint SetRight(const End& from, const End& to, double labels_variance_px2) {
  FollowedPoint point = from.now;
  if (!point.known) return point;
  if (!from.at_other.known || !to.label) {
    point.variance_px2 += from.variance_px2;
    return point;
  }
  const double S = from.at_other.variance_px2;
  const double share = point.variance_px2 / S;
  const Eigen::Vector2d d = to.label->x_px - from.at_other.x_px;
  const double expected_px2 = S + from.variance_px2 + to.variance_px2;
  const double c = (2.0 + d.squaredNorm() / expected_px2) / 4.0;
  point.x_px += share * d;
  point.variance_px2 = c * point.variance_px2 * (1.0 - share) + labels_variance_px2;
  return point;
}

FollowedPoint Blend(const std::vector<FollowedPoint>& estimates) {
  FollowedPoint blend;
  double weights = 0.0;
  for (const FollowedPoint& e : estimates) {
    weights += 1.0 / e.variance_px2;
    blend.x_px += e.x_px / e.variance_px2;
  }
  if (estimates.empty()) return blend;
  blend.known = true;
  blend.x_px /= weights;
  for (const FollowedPoint& e : estimates) {
    const double apart_px2 = (e.x_px - blend.x_px).squaredNorm() / 2.0;  // along one axis
    blend.variance_px2 += (e.variance_px2 + apart_px2) / e.variance_px2 / weights;
  }
  return blend;
}

class Propagation {
 public:
  Propagation(std::string layout, const PropagationOptions& options) : options_(options) {
    labels_.layout = std::move(layout);
  }

  // Returns whether labels lead to this frame.
  bool Add(const VideoFrame& frame);
  void AddKey(const VideoFrame& frame, const FrameLabels& labels);
  Labels Finish();

 private:
  void Release(double now_s);
  void FollowBackwards(const FrameLabels& labels);
  void EmitBetween(const Key* behind);
  FrameLabels Frame(const HeldFrame& frame, const Key* behind) const;
  PersonLabels Person(int id, const HeldFrame& frame, const Key* behind) const;
  LandmarkLabel Landmark(const std::string& name, int id, const HeldFrame& frame,
                         const Key* behind) const;
  std::vector<FollowedPoint> Estimates(const End& before, const End& behind, double time_s,
                                       double extent_px) const;
  double Variance_px2(const LandmarkLabel& label, double extent_px) const;

  PropagationOptions options_;
  Labels labels_;
  cv::Size size_px_;
  std::optional<Key> key_;  // the last one
  std::optional<FlowFollower> follower_;
  FlowPyramid pyramid_;          // where the follower is
  std::vector<HeldFrame> held_;  // the last key frame first, if there was one
  size_t first_grey_ = 0;
};

bool Propagation::Add(const VideoFrame& frame) {
  HeldFrame held{frame.index, frame.time_s, {}, {}, {}};
  cv::cvtColor(frame.bgr, held.grey, cv::COLOR_BGR2GRAY);
  size_px_ = held.grey.size();
  const bool is_reached = key_ && frame.time_s - key_->time_s <= options_.max_gap_s;
  if (is_reached) {
    FlowPyramid pyramid = MakeFlowPyramid(held.grey, options_.flow);
    follower_->Step(pyramid_, pyramid);
    held.forwards = follower_->points();
    pyramid_ = std::move(pyramid);
  }
  held_.push_back(std::move(held));
  Release(frame.time_s);
  return is_reached;
}

void Propagation::Release(double now_s) {
  while (now_s - held_[first_grey_].time_s > options_.max_gap_s)
    held_[first_grey_++].grey.release();
}

void Propagation::FollowBackwards(const FrameLabels& labels) {
  FlowFollower follower(labels, options_.flow);
  FlowPyramid from = pyramid_;
  for (size_t i = held_.size() - 1; i-- > first_grey_;) {
    FlowPyramid to = MakeFlowPyramid(held_[i].grey, options_.flow);
    follower.Step(from, to);
    held_[i].backwards = follower.points();
    from = std::move(to);
  }
}

void Propagation::AddKey(const VideoFrame& frame, const FrameLabels& labels) {
  Add(frame);
  const Key key{labels, frame.time_s};
  pyramid_ = MakeFlowPyramid(held_.back().grey, options_.flow);
  FollowBackwards(labels);
  EmitBetween(&key);
  FrameLabels& emitted = labels_.frames.emplace_back(labels);
  emitted.time_s = frame.time_s;
  emitted.width_px = size_px_.width;
  emitted.height_px = size_px_.height;

  held_.erase(held_.begin(), held_.end() - 1);
  first_grey_ = 0;
  follower_.emplace(labels, options_.flow);
  key_ = key;
}

Labels Propagation::Finish() {
  EmitBetween(nullptr);
  return std::move(labels_);
}

// All frames between two key frames, but before the first and behind the last
// one only those that labels lead to.
void Propagation::EmitBetween(const Key* behind) {
  const size_t end = held_.size() - (behind ? 1 : 0);
  for (size_t i = key_ ? 1 : 0; i < end; ++i) {
    FrameLabels frame = Frame(held_[i], behind);
    if (!frame.people.empty() || (key_ && behind)) labels_.frames.push_back(std::move(frame));
  }
}

FrameLabels Propagation::Frame(const HeldFrame& held, const Key* behind) const {
  FrameLabels frame;
  frame.image = (key_ ? key_->labels : behind->labels).image;
  frame.width_px = size_px_.width;
  frame.height_px = size_px_.height;
  frame.time_s = held.time_s;
  frame.frame = held.index;
  for (const Key* key : {key_ ? &*key_ : nullptr, behind}) {
    if (!key) continue;
    for (const PersonLabels& known : key->labels.people) {
      if (FindPerson(&frame, known.id)) continue;
      PersonLabels person = Person(known.id, held, behind);
      if (std::any_of(person.landmarks.begin(), person.landmarks.end(),
                      [](const auto& l) { return l.state != LabelState::kAbsent; }))
        frame.people.push_back(std::move(person));
    }
  }
  return frame;
}

PersonLabels Propagation::Person(int id, const HeldFrame& held, const Key* behind) const {
  PersonLabels person;
  person.id = id;
  person.is_propagated = true;
  for (const Key* key : {key_ ? &*key_ : nullptr, behind}) {
    const PersonLabels* known = key ? FindPerson(&key->labels, id) : nullptr;
    if (!known) continue;
    for (const LandmarkLabel& label : known->landmarks)
      if (!FindLabel(&person, label.name))
        person.landmarks.push_back(Landmark(label.name, id, held, behind));
  }
  return person;
}

double Propagation::Variance_px2(const LandmarkLabel& label, double extent_px) const {
  double sigma_px = label.radius_px.value_or(options_.label_sigma * extent_px);
  if (label.state == LabelState::kOccluded) sigma_px *= ObserveOptions().occluded_sigma_factor;
  return std::max(0.01, sigma_px * sigma_px);
}

LandmarkLabel Propagation::Landmark(const std::string& name, int id, const HeldFrame& held,
                                    const Key* behind) const {
  double extent_px = 0.0;
  const auto end_at = [&](const Key& key, const FollowedPoints& now, const FollowedPoints& other) {
    const PersonLabels* person = FindPerson(&key.labels, id);
    const LandmarkLabel* label = FindLabel(person, name);
    if (!label || label->state == LabelState::kAbsent) return End{};
    extent_px = std::max(extent_px, Extent_px(*person));
    return End{label, key.time_s, Variance_px2(*label, Extent_px(*person)),
               Point(now, key, id, name), Point(other, key, id, name)};
  };
  End a, b;
  if (key_) a = end_at(*key_, held.forwards, held_.back().forwards);
  if (behind) b = end_at(*behind, held.backwards, held_.front().backwards);

  const FollowedPoint blend = Blend(Estimates(a, b, held.time_s, extent_px));
  const double sigma_px = std::sqrt(blend.variance_px2);
  if (!blend.known || sigma_px > options_.max_sigma * extent_px)
    return {name, Eigen::Vector2d::Zero(), LabelState::kAbsent, std::nullopt};
  const bool nearer_a = a.label && (!b.label || held.time_s - a.time_s < b.time_s - held.time_s);
  const bool is_seen =
      (a.now.known || b.now.known) && (nearer_a ? a : b).label->state == LabelState::kVisible;
  if (is_seen) return {name, blend.x_px, LabelState::kVisible, sigma_px};
  return {name, blend.x_px, LabelState::kOccluded,
          sigma_px / ObserveOptions().occluded_sigma_factor};
}

// a, b: at the key frames before and behind.
std::vector<FollowedPoint> Propagation::Estimates(const End& a, const End& b, double time_s,
                                                  double extent_px) const {
  const double gap_s = b.time_s - a.time_s;
  const double u = (time_s - a.time_s) / gap_s;
  const double labels_px2 = (1.0 - u) * a.variance_px2 + u * b.variance_px2;
  std::vector<FollowedPoint> estimates;
  for (const FollowedPoint& track : {SetRight(a, b, labels_px2), SetRight(b, a, labels_px2)})
    if (track.known) estimates.push_back(track);
  if (a.label && b.label && gap_s <= options_.max_gap_s) {
    const double off_px =
        options_.acceleration * extent_px * (time_s - a.time_s) * (b.time_s - time_s) / 2.0;
    estimates.push_back(
        {(1.0 - u) * a.label->x_px + u * b.label->x_px, labels_px2 + off_px * off_px, true});
  }
  return estimates;
}

void Check(const Labels& keys, const PropagationOptions& options) {
  if (const std::string wrong = options.Validate(); !wrong.empty())
    throw std::invalid_argument(wrong);
  int last = -1;
  for (const FrameLabels& key : keys.frames) {
    if (!key.frame || *key.frame <= last)
      throw std::invalid_argument("PropagateLabels: wanted key frames with growing `frame`");
    last = *key.frame;
  }
}

}  // namespace

std::string PropagationOptions::Validate() const {
  if (!(max_gap_s >= 0.0))
    return fmt::format("PropagationOptions::max_gap_s = {}, wanted at least 0", max_gap_s);
  if (!(label_sigma > 0.0))
    return fmt::format("PropagationOptions::label_sigma = {}, wanted more than 0", label_sigma);
  if (!(acceleration > 0.0))
    return fmt::format("PropagationOptions::acceleration = {}, wanted more than 0", acceleration);
  if (!(max_sigma > 0.0))
    return fmt::format("PropagationOptions::max_sigma = {}, wanted more than 0", max_sigma);
  return flow.Validate();
}

Labels PropagateLabels(const Labels& keys, FrameSource* video, const PropagationOptions& options,
                       const ProgressFn& progress) {
  Check(keys, options);
  if (keys.frames.empty()) return keys;
  Propagation propagation(keys.layout, options);
  auto key = keys.frames.begin();
  const double last_key = *keys.frames.back().frame;
  int num_frames = 0;
  while (const auto frame = video->Next()) {
    num_frames = frame->index + 1;
    if (key != keys.frames.end() && frame->index == *key->frame)
      propagation.AddKey(*frame, *key++);
    else if (!propagation.Add(*frame) && key == keys.frames.end())
      break;
    if (progress) progress(std::min(1.0, frame->index / (last_key + 1.0)));
  }
  if (key != keys.frames.end())
    throw InputError(fmt::format("found labels of frame {}, but the video has {} frames",
                                 *key->frame, num_frames));
  return propagation.Finish();
}

}  // namespace poselift
