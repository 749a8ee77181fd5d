// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/model_smoother.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "lift/baselines/butterworth.h"
#include "lift/body_smoothing.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/level_camera.h"

namespace poselift {
namespace {

constexpr double kStartCutoff_hz = 3.0;
// Lifted frames flip now and then: their noise has a heavy tail, which the median
// would not see.
constexpr double kNoiseQuantile = 0.9, kSigmasAtQuantile = 1.645;

std::vector<Landmark::Part> Joint(int joint) { return {{joint, 1.0}}; }

// Where a plain filter has the motion; gaps filled by straight lines.
Motion Start(const Motion& motion, int max_gap_frames) {
  const auto filter = [](const Eigen::MatrixXd& curves, double frame_rate_hz) {
    return ButterworthLowPass(curves, frame_rate_hz,
                              {.cutoff_hz = std::min(kStartCutoff_hz, 0.25 * frame_rate_hz)});
  };
  return SmootherOfCurves(GapFill::kLinear, filter)(motion, max_gap_frames);
}

// The frames around each as the samples of a segment.
std::vector<SegmentViews::Query> QueriesOf(const std::vector<Pose3>& joints_m,
                                           double frames_a_sample) {
  std::vector<SegmentViews::Query> queries;
  const auto last = static_cast<double>(joints_m.size() - 1);
  for (size_t t = 0; t < joints_m.size(); ++t) {
    SegmentViews::Query& query = queries.emplace_back(3, kSegmentSamples * kNumJoints);
    for (int k = 0; k < kSegmentSamples; ++k) {
      const double at = static_cast<double>(t) + (k - kMiddleSample) * frames_a_sample;
      const auto nearest = static_cast<size_t>(std::lround(std::clamp(at, 0.0, last)));
      query.middleCols<kNumJoints>(k * kNumJoints) = joints_m[nearest];
    }
  }
  return queries;
}

// Those of the start: its root mean square second differences.
void ExpectAccelerations(const Motion& start, const FrameSpan& span,
                         SequenceRefinementOptions* options) {
  const auto num_differences = static_cast<double>(span.NumFrames() - 2);
  if (num_differences < 1.0) return;
  double angles = 0.0, turn = 0.0, place_m2 = 0.0;
  for (int t = span.first + 2; t <= span.last; ++t) {
    const auto i = static_cast<size_t>(t);
    const SkeletonPose &a = start.frames[i - 2], &b = start.frames[i - 1], &c = start.frames[i];
    angles += (a.dofs - 2.0 * b.dofs + c.dofs).squaredNorm();
    place_m2 += (a.root_in_world_m - 2.0 * b.root_in_world_m + c.root_in_world_m).squaredNorm();
    const auto near = [&](const SkeletonPose& pose) {
      const Eigen::Vector4d q = pose.world_from_root.coeffs();
      return Eigen::Vector4d(q.dot(b.world_from_root.coeffs()) < 0.0 ? -q : q);
    };
    turn += (near(a) - 2.0 * near(b) + near(c)).squaredNorm();
  }
  // The options are for 30 frames a second.
  const double slower = std::pow(start.frame_time_s * 30.0, 1.5);
  const auto sigma = [&](double sum, double size, double least) {
    return std::max(least, std::sqrt(sum / (size * num_differences)) / slower);
  };
  options->acceleration_sigma_rad = sigma(angles, kNumAngles, 1e-3);
  options->path_sigma_m = sigma(place_m2, 3.0, 1e-4);
  options->turn_sigma = sigma(turn, 4.0, 1e-4);
}

// Of motions on the codebook's skeleton.
class ModelSmoother {
 public:
  ModelSmoother(std::shared_ptr<const MotionCodebook> codebook, const ModelSmootherOptions& options)
      : codebook_(std::move(codebook)), options_(options) {}

  Motion Smooth(const Motion& motion, int max_gap_frames) const {
    const SegmentViews views(*codebook_, AllJoints(), options_.views);
    Motion smooth = Start(motion, max_gap_frames);
    std::vector<bool> known;
    for (const SkeletonPose& pose : smooth.frames) known.push_back(IsKnown(pose));
    const Eigen::MatrixXd whitening =
        PoseNoise(motion).cwiseMax(options_.least_noise).cwiseInverse().asDiagonal();
    for (const FrameSpan& span : SpansOf(known))
      SmoothSpan(motion, views, whitening, span, &smooth);
    return smooth;
  }

 private:
  static std::vector<std::vector<Landmark::Part>> AllJoints() {
    std::vector<std::vector<Landmark::Part>> joints;
    for (int j = 0; j < kNumJoints; ++j) joints.push_back(Joint(j));
    return joints;
  }

  void SmoothSpan(const Motion& motion, const SegmentViews& views, const Eigen::MatrixXd& whitening,
                  const FrameSpan& span, Motion* smooth) const {
    std::vector<Pose3> joints_m;
    for (int t = span.first; t <= span.last; ++t)
      joints_m.push_back(JointPositions(smooth->skeleton, smooth->frames[static_cast<size_t>(t)]));
    constexpr double kAsTheRest = 1.0;  // depth is known as well
    const auto nearest =
        views.FindNearest(QueriesOf(joints_m, codebook_->sample_time_s / motion.frame_time_s),
                          kAsTheRest, options_.num_neighbours);
    std::vector<FrameEvidence> evidence;
    for (int t = span.first; t <= span.last; ++t) {
      const auto i = static_cast<size_t>(t);
      FrameEvidence& frame = evidence.emplace_back();
      frame.start = LevelFromCam(smooth->frames[i]);
      frame.camera.scale_px_per_m = 0.0;
      frame.local = MakeLocalPose(*codebook_, nearest[i - static_cast<size_t>(span.first)],
                                  kAsTheRest, options_.local);
      if (IsKnown(motion.frames[i]))
        frame.measured = PosePrediction{LevelFromCam(motion.frames[i]), whitening};
    }
    SequenceRefinementOptions options = options_.refinement;
    ExpectAccelerations(*smooth, span, &options);
    const SequenceRefinement refinement(smooth->skeleton, {}, options);
    const auto refined = refinement.Solve(evidence, motion.frame_time_s);
    for (size_t i = 0; i < refined.size(); ++i)
      smooth->frames[i + static_cast<size_t>(span.first)] = LevelFromCam(refined[i].pose);
  }

  std::shared_ptr<const MotionCodebook> codebook_;
  ModelSmootherOptions options_;
};

// Of the absolute third differences of one quantity.
double NoiseOf(std::vector<double>* differences) {
  if (differences->empty()) return 0.0;
  const auto place = differences->begin() +
                     static_cast<std::ptrdiff_t>(kNoiseQuantile * (differences->size() - 1));
  std::nth_element(differences->begin(), place, differences->end());
  return *place / kSigmasAtQuantile / std::sqrt(20.0);
}

}  // namespace

std::string ModelSmootherOptions::Validate() const {
  for (const std::string& error : {views.Validate(), local.Validate(), refinement.Validate()})
    if (!error.empty()) return error;
  if (num_neighbours < 1)
    return fmt::format("ModelSmootherOptions::num_neighbours = {}, wanted at least 1",
                       num_neighbours);
  if (!(least_noise > 0.0))
    return fmt::format("ModelSmootherOptions::least_noise = {}, wanted > 0", least_noise);
  return "";
}

FeatureVector PoseNoise(const Motion& motion) {
  std::vector<std::vector<double>> of_angles(kNumAngles);
  std::vector<double> of_place, of_turn;
  for (size_t t = 3; t < motion.frames.size(); ++t) {
    constexpr double kBinomial[] = {1.0, -3.0, 3.0, -1.0};
    Eigen::VectorXd dofs = Eigen::VectorXd::Zero(kNumAngles);
    Eigen::Vector3d place_m = Eigen::Vector3d::Zero(), turn_rad = place_m;
    for (size_t k = 0; k < 4; ++k) {
      const SkeletonPose& pose = motion.frames[t - k];
      dofs += kBinomial[k] * pose.dofs;
      place_m += kBinomial[k] * pose.root_in_world_m;
      Eigen::Quaterniond turn = pose.world_from_root * motion.frames[t].world_from_root.conjugate();
      if (turn.w() < 0.0) turn.coeffs() *= -1.0;
      turn_rad += kBinomial[k] * 2.0 * turn.vec();
    }
    if (!dofs.allFinite() || !place_m.allFinite() || !turn_rad.allFinite()) continue;
    for (int d = 0; d < kNumAngles; ++d)
      of_angles[static_cast<size_t>(d)].push_back(std::abs(dofs[d]));
    for (int axis = 0; axis < 3; ++axis) {
      of_place.push_back(std::abs(place_m[axis]));
      of_turn.push_back(std::abs(turn_rad[axis]));
    }
  }
  FeatureVector noise;
  for (int d = 0; d < kNumAngles; ++d) noise[d] = NoiseOf(&of_angles[static_cast<size_t>(d)]);
  const double place_m = NoiseOf(&of_place), turn_rad = NoiseOf(&of_turn);
  for (const int row : {feature::kHeight, feature::kVelocity, feature::kVelocity + 1})
    noise[row] = place_m;
  for (const int row : {feature::kTilt, feature::kTilt + 1, feature::kYawRate})
    noise[row] = turn_rad;
  return noise;
}

MotionSmoother SmootherByModel(std::shared_ptr<const MotionCodebook> codebook, MotionSmoother rest,
                               const ModelSmootherOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  const Skeleton body = codebook->skeleton;
  const auto of_body = [smoother = ModelSmoother(std::move(codebook), options)](
                           const Motion& motion, int max_gap_frames) {
    return smoother.Smooth(motion, max_gap_frames);
  };
  return SmootherOfBody(body, of_body, std::move(rest));
}

}  // namespace poselift
