// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lift_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lift/choose_alternatives.h"
#include "lift/normalize.h"
#include "lift/perspective.h"
#include "lift/point_curves.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/level_camera.h"
#include "src/loop_progress.h"

namespace poselift {
namespace {

constexpr double kScaleWindow_s = 1.5;
constexpr double kShareOfFrames = 0.9;  // of the time, to lift each frame by itself

// A part of the sequence in which every frame could be lifted by itself, or
// lies between two that could.
std::vector<FrameSpan> RunsOf(const std::vector<Observation>& frames) {
  std::vector<bool> can_lift;
  for (const Observation& frame : frames) can_lift.push_back(CanLift(frame).empty());
  return SpansOf(can_lift);
}

// The median of what lies around each frame.
std::vector<double> RunningMedian(const std::vector<double>& values, std::ptrdiff_t reach) {
  std::vector<double> medians, window;
  for (std::ptrdiff_t t = 0; t < std::ssize(values); ++t) {
    window.assign(values.begin() + std::max<std::ptrdiff_t>(0, t - reach),
                  values.begin() + std::min(std::ssize(values), t + reach + 1));
    std::nth_element(window.begin(), window.begin() + std::ssize(window) / 2, window.end());
    medians.push_back(window[window.size() / 2]);
  }
  return medians;
}

// Frames whose lift failed take the result of the nearest one in time. False
// when all failed.
bool BorrowMissing(std::vector<LiftResult>* frames) {
  std::vector<size_t> usable;
  for (size_t t = 0; t < frames->size(); ++t)
    if (!(*frames)[t].poses.empty()) usable.push_back(t);
  if (usable.empty()) return false;
  for (size_t t = 0; t < frames->size(); ++t) {
    if (!(*frames)[t].poses.empty()) continue;
    const size_t nearest = *std::min_element(usable.begin(), usable.end(), [t](size_t a, size_t b) {
      return (a < t ? t - a : a - t) < (b < t ? t - b : b - t);
    });
    (*frames)[t] = (*frames)[nearest];
  }
  return true;
}

// The points in the axes of SegmentViews: as they are seen, in metres at the
// sequence's scale, and as deep as in the pose; those not seen as in the pose.
Eigen::Matrix3Xd PlacedPoints_m(const std::vector<ObservedPoint>& points, const Observation& seen,
                                const LiftedPose& lifted, double scale_px_per_m) {
  Eigen::Matrix3Xd placed_m(3, std::ssize(points));
  for (Eigen::Index i = 0; i < placed_m.cols(); ++i) {
    const ObservedPoint& point = points[static_cast<size_t>(i)];
    const Eigen::Vector3d x_in_cam_m = SumOfJoints(point.parts, lifted.joints_in_cam_m);
    const auto found =
        std::find_if(seen.points.begin(), seen.points.end(),
                     [&](const ObservedPoint& now) { return now.name == point.name; });
    Eigen::Vector2d x_m = x_in_cam_m.head<2>();
    if (scale_px_per_m > 0.0) {  // there are 2D points
      const bool is_seen = found != seen.points.end() && found->kind == ObservedPoint::Kind::k2D;
      const Eigen::Vector2d x_px =
          is_seen
              ? Eigen::Vector2d(found->x.head<2>())
              : Eigen::Vector2d(lifted.camera.scale_px_per_m * x_m + lifted.camera.translation_px);
      x_m = x_px / scale_px_per_m;
    }
    placed_m.col(i) << x_m.x(), -x_m.y(), -x_in_cam_m.z();
  }
  return placed_m;
}

bool AllPointsAre2D(const std::vector<Observation>& frames) {
  return std::all_of(frames.begin(), frames.end(), [](const Observation& frame) {
    return frame.Count(ObservedPoint::Kind::k3D) == 0 && frame.bone_poses.empty();
  });
}

// The joints of the pose on a skeleton, and what depends on them.
void PutOn(const Skeleton& skeleton, const Observation& seen, LiftedPose* lifted) {
  lifted->joints_in_cam_m = JointPositions(skeleton, lifted->pose);
  if (seen.pinhole) lifted->pelvis_in_cam_m = PelvisInCam_m(*seen.pinhole, lifted->camera);
  MeasureErrors(seen, lifted);
  lifted->unmet_hints = UnmetHints(seen.relations, lifted->joints_in_cam_m);
}

// A curve of points at any time: linear between frames, held at the ends.
Eigen::Matrix3Xd PointsAt(const std::vector<Eigen::Matrix3Xd>& frames, double t) {
  const double last = static_cast<double>(frames.size() - 1);
  const double clamped = std::clamp(t, 0.0, last);
  const auto before = static_cast<size_t>(clamped);
  const size_t after = std::min(before + 1, frames.size() - 1);
  const double u = clamped - static_cast<double>(before);
  return (1.0 - u) * frames[before] + u * frames[after];
}

}  // namespace

std::string LiftSequenceOptions::Validate() const {
  for (const std::string& error : {views.Validate(), local.Validate(), refinement.Validate()})
    if (!error.empty()) return error;
  if (!(label_cutoff_hz >= 0.0))
    return fmt::format("LiftSequenceOptions::label_cutoff_hz = {}, wanted >= 0", label_cutoff_hz);
  if (!(max_gap_s >= 0.0))
    return fmt::format("LiftSequenceOptions::max_gap_s = {}, wanted >= 0", max_gap_s);
  if (num_neighbours < 1)
    return fmt::format("LiftSequenceOptions::num_neighbours = {}, wanted at least 1",
                       num_neighbours);
  if (!(depth_weight >= 0.0))
    return fmt::format("LiftSequenceOptions::depth_weight = {}, wanted >= 0", depth_weight);
  if (!(trunk_sigma_factor > 0.0 && limb_sigma_factor > 0.0))
    return fmt::format(
        "LiftSequenceOptions::trunk_sigma_factor = {}, limb_sigma_factor = {}, wanted > 0",
        trunk_sigma_factor, limb_sigma_factor);
  return "";
}

// What is known of the frames of a run, stage by stage.
struct SequenceLifter::Run {
  double frame_time_s;
  std::vector<Observation> seen;    // the labels
  std::vector<Observation> smooth;  // and their smoothed curves
  std::vector<LiftResult> alone;    // each frame lifted by itself, none without a pose
  std::vector<LiftedPose> chosen;   // of its poses
  std::vector<double> scales_px_per_m;
  std::vector<LocalPose> local;
  std::vector<FrameEvidence> evidence;
  FrameSpan span;  // of the sequence
};

SequenceLifter::SequenceLifter(const PhotoLifter& lifter, const MotionCodebook& codebook,
                               const LiftSequenceOptions& options)
    : lifter_(lifter),
      codebook_(codebook),
      options_(options),
      refinement_(lifter.dictionary().skeleton, lifter.dictionary().prior, options.refinement),
      angles_(lifter.dictionary().skeleton) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
  if (codebook.skeleton.NumDofs() != lifter.dictionary().skeleton.NumDofs())
    throw InputError(
        "found a motion model and a dictionary of different skeletons, wanted one "
        "skeleton: learn both from the same motions");
}

LiftedSequence SequenceLifter::LiftSequence(const std::vector<Observation>& frames,
                                            double frame_time_s, const ProgressFn& progress) const {
  const auto tall = std::find_if(frames.begin(), frames.end(), [](const Observation& frame) {
    return frame.stature_m.has_value();
  });
  if (tall == frames.end()) return LiftAtSkeletonSize(frames, frame_time_s, progress);
  const double size = SizeOf(*tall, lifter_.dictionary().skeleton);
  std::vector<Observation> at_size;
  for (const Observation& frame : frames) at_size.push_back(AtSkeletonSize(frame, size));
  LiftedSequence lifted = LiftAtSkeletonSize(at_size, frame_time_s, progress);
  for (LiftResult& frame : lifted.frames)
    for (LiftedPose& pose : frame.poses) pose.size = size;
  return lifted;
}

LiftedSequence SequenceLifter::LiftAtSkeletonSize(const std::vector<Observation>& frames,
                                                  double frame_time_s,
                                                  const ProgressFn& progress) const {
  if (!(frame_time_s > 0.0 && frame_time_s <= kLongestFrameTime_s))
    throw InputError(fmt::format("found {} s between frames, wanted more than 0 and at most {}",
                                 frame_time_s, kLongestFrameTime_s));
  const int max_gap_frames = static_cast<int>(std::floor(options_.max_gap_s / frame_time_s));
  const std::vector<Observation> smooth =
      SmoothPoints(frames, frame_time_s, options_.label_cutoff_hz, max_gap_frames);
  const Skeleton& standard = lifter_.dictionary().skeleton;
  LiftedSequence lifted{std::vector<LiftResult>(frames.size()),
                        std::vector<bool>(frames.size(), false),
                        {},
                        standard};
  for (size_t t = 0; t < frames.size(); ++t) {
    lifted.frames[t].status = LiftStatus::kCannotLift;
    lifted.frames[t].message = CanLift(frames[t]);
  }
  std::vector<Run> runs;
  for (const FrameSpan& span : RunsOf(smooth)) {
    const auto part = [&](const std::vector<Observation>& all) {
      return std::vector<Observation>(all.begin() + span.first, all.begin() + span.last + 1);
    };
    Run run{.frame_time_s = frame_time_s, .seen = part(frames), .smooth = part(smooth)};
    run.span = span;
    const auto so_far = [&](double share) {
      if (progress)
        progress(kShareOfFrames * (span.first + share * span.NumFrames()) /
                 static_cast<double>(frames.size()));
    };
    if (!LiftEach(&run, so_far)) continue;
    FindLocalPoses(&run);
    so_far(1.0);  // where who waits may stop it
    GatherEvidence(&run);
    runs.push_back(std::move(run));
  }
  if (!runs.empty() && options_.find_proportions && AllPointsAre2D(frames))
    lifted.body = FindProportions(&runs);
  lifted.skeleton = WithProportions(standard, lifted.body.log_ratios);
  for (Run& run : runs) {
    if (progress)
      progress(kShareOfFrames +
               (1.0 - kShareOfFrames) * run.span.first / static_cast<double>(frames.size()));
    std::vector<LiftedPose> together = Refine(run, lifted.skeleton, lifted.body.log_ratios);
    for (size_t i = 0; i < together.size(); ++i) {
      const size_t t = i + static_cast<size_t>(run.span.first);
      lifted.filled[t] = !CanLift(frames[t]).empty();
      lifted.frames[t] = std::move(run.alone[i]);
      auto& poses = lifted.frames[t].poses;
      for (LiftedPose& alternative : poses) PutOn(lifted.skeleton, run.seen[i], &alternative);
      poses.insert(poses.begin(), std::move(together[i]));
    }
  }
  if (progress) progress(1.0);
  return lifted;
}

// Frame by frame, then the alternatives that go together. False when no frame
// has a pose.
bool SequenceLifter::LiftEach(Run* run, const ProgressFn& progress) const {
  const size_t num_frames = run->smooth.size();
  run->alone.resize(num_frames);
  LoopProgress so_far(progress, num_frames);
#pragma omp parallel for schedule(dynamic)
  for (size_t t = 0; t < num_frames; ++t) {
    if (so_far.IsStopped()) continue;
    run->alone[t] = lifter_.LiftPhoto(run->smooth[t]);
    so_far.Advance();
  }
  so_far.Finish();
  if (!BorrowMissing(&run->alone)) return false;
  const std::vector<int> chosen = ChooseAlternatives(run->alone, run->frame_time_s);
  std::vector<double> scales_px_per_m;
  for (size_t t = 0; t < num_frames; ++t) {
    auto& poses = run->alone[t].poses;
    run->chosen.push_back(poses[static_cast<size_t>(chosen[t])]);
    poses.erase(poses.begin() + chosen[t]);  // the rest stay as alternatives
    scales_px_per_m.push_back(run->chosen.back().camera.scale_px_per_m);
  }
  run->scales_px_per_m =
      RunningMedian(scales_px_per_m, std::lround(0.5 * kScaleWindow_s / run->frame_time_s));
  return true;
}

// Each frame as a moment of the codebook: the points as they were seen, where
// they were, with the depth of the chosen pose.
void SequenceLifter::FindLocalPoses(Run* run) const {
  const std::vector<ObservedPoint> points = PointsOf(run->smooth);
  std::vector<std::vector<Landmark::Part>> parts;
  for (const ObservedPoint& point : points) parts.push_back(point.parts);
  std::vector<Eigen::Matrix3Xd> placed_m;
  for (size_t t = 0; t < run->smooth.size(); ++t)
    placed_m.push_back(
        PlacedPoints_m(points, run->smooth[t], run->chosen[t], run->scales_px_per_m[t]));

  const double frames_a_sample = codebook_.sample_time_s / run->frame_time_s;
  const auto num_points = std::ssize(points);
  std::vector<SegmentViews::Query> queries;
  for (size_t t = 0; t < placed_m.size(); ++t) {
    SegmentViews::Query& query = queries.emplace_back(3, kSegmentSamples * num_points);
    for (int k = 0; k < kSegmentSamples; ++k)
      query.middleCols(k * num_points, num_points) =
          PointsAt(placed_m, static_cast<double>(t) + (k - kMiddleSample) * frames_a_sample);
  }
  const auto views = SegmentViews(codebook_, parts, options_.views)
                         .FindNearest(queries, options_.depth_weight, options_.num_neighbours);
  for (const std::vector<SegmentView>& near : views)
    run->local.push_back(MakeLocalPose(codebook_, near, options_.depth_weight, options_.local));
}

void SequenceLifter::GatherEvidence(Run* run) const {
  for (size_t t = 0; t < run->seen.size(); ++t) {
    const LiftedPose& chosen = run->chosen[t];
    FrameEvidence& frame = run->evidence.emplace_back();
    frame.observation = run->seen[t].pinhole
                            ? AsWeakPerspective(run->seen[t], chosen.joints_in_cam_m, chosen.camera)
                            : run->seen[t];
    frame.start = chosen.pose;
    TakeAnglesNearestToRest(lifter_.dictionary().skeleton, &frame.start);
    frame.start.root_in_world_m = MeanShift_m(run->seen[t], chosen.joints_in_cam_m);
    frame.camera = chosen.camera;
    frame.camera.translation_px -=
        chosen.camera.scale_px_per_m * frame.start.root_in_world_m.head<2>();
    frame.camera.scale_px_per_m = run->scales_px_per_m[t];
    frame.lifted_in_cam_m = chosen.joints_in_cam_m;
    frame.local = run->local[t];
  }
}

// Of all runs, each starting with what those before it have found. Leaves in the
// evidence where the poses went, and the scales at the size of the standard skeleton.
BodyProportions SequenceLifter::FindProportions(std::vector<Run>* runs) const {
  BodyProportions body = ProportionPrior();
  for (Run& run : *runs) {
    const auto refined = refinement_.SolveWithProportions(run.evidence, run.frame_time_s, &body);
    for (size_t t = 0; t < refined.size(); ++t) {
      run.evidence[t].start = refined[t].pose;
      run.evidence[t].camera.translation_px = refined[t].camera.translation_px;
    }
  }
  const Eigen::VectorXd standard_lengths_m = BoneLengths(lifter_.dictionary().skeleton);
  const double stature = std::exp(LogStature(body.log_ratios, standard_lengths_m));
  for (Run& run : *runs)
    for (FrameEvidence& frame : run.evidence) frame.camera.scale_px_per_m *= stature;
  return AtEqualStature(body, standard_lengths_m);
}

std::vector<LiftedPose> SequenceLifter::Refine(const Run& run, const Skeleton& skeleton,
                                               const GroupVector& log_ratios) const {
  const auto refined = refinement_.Solve(run.evidence, run.frame_time_s, log_ratios);
  std::vector<LiftedPose> together;
  for (size_t t = 0; t < refined.size(); ++t) {
    LiftedPose& lifted = together.emplace_back(run.chosen[t]);
    lifted.pose = refined[t].pose;
    lifted.camera = refined[t].camera;
    lifted.camera.translation_px +=
        lifted.camera.scale_px_per_m * lifted.pose.root_in_world_m.head<2>();
    lifted.pose.root_in_world_m.setZero();
    PutOn(skeleton, run.seen[t], &lifted);
    lifted.angles_sigma_deg = AnglesSigma_deg(refined[t]);
  }
  return together;
}

// To first order in the angles of the pose.
Eigen::VectorXd SequenceLifter::AnglesSigma_deg(const RefinedFrame& frame) const {
  if (frame.covariance.size() == 0) return {};
  Eigen::MatrixXd by_pose_deg = angles_.DerivativeDeg(LevelFromCam(frame.pose));
  by_pose_deg.leftCols<3>() *= kLevelFromCam.toRotationMatrix();
  Eigen::VectorXd sigma_deg = (by_pose_deg * frame.covariance)
                                  .cwiseProduct(by_pose_deg)
                                  .rowwise()
                                  .sum()
                                  .cwiseMax(0.0)
                                  .cwiseSqrt();
  for (Eigen::Index a = 0; a < sigma_deg.size(); ++a)
    sigma_deg[a] *= IsOfLimb(JointAngles()[static_cast<size_t>(a)]) ? options_.limb_sigma_factor
                                                                    : options_.trunk_sigma_factor;
  return sigma_deg;
}

}  // namespace poselift
