// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "lift/ik/articulation.h"
#include "lift/temporal/acceleration_model.h"
#include "src/motion.h"

namespace poselift {

// Eq. (1) of the motion paper as poses arrive: its Markov chain of order two with
// the local regressions of a codebook, which are linear and Gaussian, is a Kalman
// filter. The state of each feature is its value and its rate,
//
//   x_t = x_t-1 + dt v + dt^2/2 a,   v_t = v_t-1 + dt a,   a ~ N(a(x, v), variance),
//
// with a and its variance by AccelerationModel (its slope in x is not in the
// covariance). Features are filtered side by side: what they do together is in
// a(x, v), and in what measures them. Frames come out `latency_s` late, set right by
// those that came since (Rauch, Tung, Striebel). Memory and time a frame do not grow.
struct MotionFilterOptions {
  double latency_s = 0.1;
  // So long are poses foretold that are not measured; at most 10 s.
  double max_gap_s = 0.5;
  // Of the variance of accelerations: bodies that were not captured differ, and
  // what is measured errs for more than one frame.
  double variance_scale = 6.0;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct SmoothedFrame {
  enum class Kind { kMeasured, kFilled, kNotKnown };
  double time_s = 0.0;
  Kind kind = Kind::kNotKnown;
  SkeletonPose pose;                                 // UnknownPose when unknown
  FeatureVector deviations = FeatureVector::Zero();  // standard ones, as PoseDifference
};

class MotionFilter {
 public:
  // codebook: with its mirror images. body: whose poses these are, the codebook's
  // skeleton with other bone lengths. Throws InputError for wrong options.
  MotionFilter(std::shared_ptr<const MotionCodebook> codebook, const Skeleton& body,
               const MotionFilterOptions& options);

  // The next frame, in a world with y up, and what is foretold of it: nothing after a
  // gap that is too long, and at the start. will_measure: Measure follows. The floor is
  // where the lowest joint is, of late. Throws InputError when time does not go on.
  struct Prediction {
    const SkeletonPose& pose;
    const FeatureVector& variances;  // as PoseDifference
  };
  std::optional<Prediction> Next(double time_s, bool will_measure);
  // Of the newest frame: its pose and the variances of that in the light of what was
  // foretold too; without that, as they were measured.
  void Measure(const SkeletonPose& pose, const FeatureVector& variances);
  // What was foretold of the newest frame was wrong: Measure starts the filter anew.
  void StartAnew();
  // Where the body will be by the newest rates, at a time soon after the newest frame;
  // nothing when that is not known.
  std::optional<SkeletonPose> Ahead(double time_s) const;
  // No more frames come: the rest may go out.
  void End() { has_ended_ = true; }
  // The oldest frame that has waited for long enough, if there is one.
  std::optional<SmoothedFrame> Take();

 private:
  // Variances of a value and its rate, of each feature.
  struct Covariance {
    FeatureVector xx, xv, vv;
  };
  struct Frame {
    double time_s = 0.0;
    SmoothedFrame::Kind kind = SmoothedFrame::Kind::kNotKnown;
    SkeletonPose predicted, filtered;
    FeatureVector predicted_rates, rates;
    Covariance predicted_covariance, covariance;
    double dt_s = 0.0;  // from the frame before, 0 where the filter started anew
  };

  bool GoesOn(const Frame& before, double time_s, bool will_measure) const;
  void Predict(const Frame& before, Frame* frame);
  void LearnFloor(const SkeletonPose& pose, double dt_s);
  // The oldest frame in the light of all.
  SmoothedFrame SmoothOldest() const;

  std::shared_ptr<const MotionCodebook> codebook_;
  MotionFilterOptions options_;
  Articulation body_;
  FeatureVector to_model_;  // of this body's lengths, those of the codebook's body
  AccelerationModel model_;
  std::deque<Frame> frames_;
  double floor_m_ = std::numeric_limits<double>::infinity();
  double measured_s_ = 0.0;  // when there was a pose the last time
  std::optional<Frame> newest_taken_;
  bool has_ended_ = false;
};

}  // namespace poselift
