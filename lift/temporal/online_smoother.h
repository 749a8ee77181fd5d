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
// covariance), measured by the pose with a noise
// that is estimated as it goes. Features are filtered side by side: what they do
// together is in a(x, v). Frames come out `latency_s` late, set right by those that
// came since (Rauch, Tung, Striebel). Memory and time a frame do not grow.
struct OnlineSmootherOptions {
  double latency_s = 0.1;
  // So long are poses foretold that are not measured; at most 10 s.
  double max_gap_s = 0.5;
  // Of the variance of accelerations: bodies that were not captured differ, and
  // what is measured errs for more than one frame.
  double variance_scale = 6.0;
  double least_noise = 0.002;  // of a measured pose, radians and metres

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct SmoothedFrame {
  enum class Kind { kMeasured, kFilled, kNotKnown };
  double time_s = 0.0;
  Kind kind = Kind::kNotKnown;
  SkeletonPose pose;                                 // UnknownPose when unknown
  FeatureVector deviations = FeatureVector::Zero();  // standard ones, as PoseDifference
};

class OnlineSmoother {
 public:
  // codebook: with its mirror images. Throws InputError for wrong options.
  OnlineSmoother(std::shared_ptr<const MotionCodebook> codebook,
                 const OnlineSmootherOptions& options = {});

  // The next frame: a pose on the codebook's skeleton in a world with y up, or one
  // that is not known. The floor is where the lowest joint is, of late. Throws InputError when time
  // does not go on.
  void Add(double time_s, const SkeletonPose& measured);
  // No more frames come: the rest may go out.
  void End() { has_ended_ = true; }
  // The oldest frame that has waited for long enough, if there is one.
  std::optional<SmoothedFrame> Take();

 private:
  // Variances of a value and its rate, of each feature.
  struct Covariance {
    FeatureVector xx, xv, vv;
  };
  struct Measured {
    double time_s;
    SkeletonPose pose;
  };
  struct Frame {
    double time_s = 0.0;
    SmoothedFrame::Kind kind = SmoothedFrame::Kind::kNotKnown;
    SkeletonPose predicted, filtered;
    FeatureVector predicted_rates, rates;
    Covariance predicted_covariance, covariance;
    double dt_s = 0.0;  // from the frame before, 0 where the filter started anew
  };

  bool GoesOn(const Frame& before, double time_s, bool is_measured) const;
  void Start(const SkeletonPose& measured, Frame* frame) const;
  void Predict(const Frame& before, Frame* frame);
  void Update(const SkeletonPose& measured, Frame* frame) const;
  void LearnNoise(const Measured& measured);
  void LearnFloor(const SkeletonPose& pose, double dt_s);
  // The oldest frame in the light of all.
  SmoothedFrame SmoothOldest() const;

  std::shared_ptr<const MotionCodebook> codebook_;
  OnlineSmootherOptions options_;
  Articulation body_;
  AccelerationModel model_;
  std::deque<Frame> frames_;
  std::deque<Measured> last_measured_;  // newest first, without a gap
  FeatureVector noise_variance_;
  double num_learned_ = 0.0;
  double floor_m_ = std::numeric_limits<double>::infinity();
  double measured_s_ = 0.0;  // when there was a pose the last time
  std::optional<Frame> newest_taken_;
  bool has_ended_ = false;
};

}  // namespace poselift
