// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/lifter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lift/alternation.h"
#include "lift/depth_mirror.h"

namespace poselift {
namespace {

constexpr int kLeastPoints = 4;
constexpr int kPointsOfAWholeBody = 15;
// How far off a pose that was mirrored may be: it is where to start.
constexpr double kMirrorSigma_m = 0.1;
// Of points that are dragged: less lets the pose jump at the first move, more changes nothing.
constexpr double kNewAtomsGain = 0.05;
// px or m: fourth powers of what lies within are far from overflow.
constexpr double kFarthest = 1e9;

// A pose that somebody made (pins, ObservePose), counted from the pelvis, and nothing in a picture:
// it looks one way only. What tags measure does not, for they may be taken for each other.
bool IsWholePose(const Observation& observation) {
  return observation.Count(ObservedPoint::Kind::k2D) == 0 &&
         std::ssize(observation.points) >= kPointsOfAWholeBody &&
         std::any_of(observation.points.begin(), observation.points.end(),
                     [](const ObservedPoint& point) {
                       return point.parts.size() == 1 && point.x.isZero(0.0) &&
                              point.parts.front().joint == joint::kPelvis;
                     });
}

void SortByObjective(std::vector<LiftSolution>* solutions) {
  std::stable_sort(
      solutions->begin(), solutions->end(),
      [](const LiftSolution& a, const LiftSolution& b) { return a.objective < b.objective; });
}

Pose3 JointsInCam_m(const LiftSolution& solution) {
  return CamFromBody(solution.tau_rad) * Unstacked(solution.pose_in_body_m);
}

double RmsDistance_m(const LiftSolution& a, const LiftSolution& b) {
  return std::sqrt((JointsInCam_m(a) - JointsInCam_m(b)).squaredNorm() / kNumJoints);
}

// Keeps the better of any two that are the same pose.
std::vector<LiftSolution> Distinct(std::vector<LiftSolution> sorted, double distinct_m) {
  std::vector<LiftSolution> distinct;
  for (LiftSolution& solution : sorted) {
    const bool is_new = std::all_of(distinct.begin(), distinct.end(), [&](const LiftSolution& d) {
      return RmsDistance_m(d, solution) >= distinct_m;
    });
    if (is_new) distinct.push_back(std::move(solution));
  }
  return distinct;
}

// The first so many, each thread with storage of its own; within a loop that is parallel already
// one after the other.
void RunEach(const Alternation& alternation, int alternations, std::vector<LiftSolution>* solutions,
             int count) {
  count = std::min(count, static_cast<int>(solutions->size()));
#pragma omp parallel if (count > 1)
  {
    Alternation mine(alternation);
#pragma omp for schedule(dynamic)
    for (int i = 0; i < count; ++i) mine.Run(alternations, &(*solutions)[i]);
  }
}

std::vector<LiftSolution> AtStarts(const std::vector<ViewStart>& starts,
                                   const Dictionary& dictionary, bool has_2d) {
  std::vector<LiftSolution> solutions;
  for (const ViewStart& start : starts) {
    LiftSolution solution;
    solution.tau_rad = start.tau_rad;
    if (has_2d) solution.scale_px_per_m = start.scale_px_per_unit / dictionary.typical_norm_m;
    solutions.push_back(std::move(solution));
  }
  return solutions;
}

}  // namespace

std::string LifterOptions::Validate() const {
  for (const std::string& error : {omp.Validate(), rotation.Validate(), views.Validate()})
    if (!error.empty()) return error;
  if (!(prior_weight >= 0.0))
    return fmt::format("LifterOptions::prior_weight = {}, wanted at least 0", prior_weight);
  if (max_alternations < 1)
    return fmt::format("LifterOptions::max_alternations = {}, wanted at least 1", max_alternations);
  if (!(min_improvement >= 0.0))
    return fmt::format("LifterOptions::min_improvement = {}, wanted at least 0", min_improvement);
  if (!(new_atoms_gain >= 0.0 && new_atoms_gain < 1.0))
    return fmt::format("LifterOptions::new_atoms_gain = {}, wanted 0 to below 1", new_atoms_gain);
  if (trial_alternations < 1)
    return fmt::format("LifterOptions::trial_alternations = {}, wanted at least 1",
                       trial_alternations);
  if (num_finishing < 1)
    return fmt::format("LifterOptions::num_finishing = {}, wanted at least 1", num_finishing);
  if (!(distinct_m >= 0.0))
    return fmt::format("LifterOptions::distinct_m = {}, wanted at least 0", distinct_m);
  return "";
}

std::string CanLift(const Observation& observation) {
  const auto count = static_cast<int>(observation.points.size());
  if (count < kLeastPoints)
    return fmt::format("{} usable points, wanted at least {} well spread ones", count,
                       kLeastPoints);
  for (const ObservedPoint& point : observation.points) {
    if (!(point.x.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kFarthest))
      return fmt::format("'{}' is at ({}, {}, {}), wanted numbers up to {}", point.name,
                         point.x.x(), point.x.y(), point.x.z(), kFarthest);
    if (!(point.sigma >= 1.0 / kFarthest && point.sigma <= kFarthest))
      return fmt::format("'{}' has a sigma of {}, wanted {} to {}", point.name, point.sigma,
                         1.0 / kFarthest, kFarthest);
  }
  for (const JointRelation& relation : observation.relations)
    if (!(std::abs(relation.bound_m) <= kFarthest && relation.sigma_m >= 1.0 / kFarthest &&
          relation.sigma_m <= kFarthest))
      return fmt::format("a hint says {} m with a sigma of {}, wanted numbers from {} to {}",
                         relation.bound_m, relation.sigma_m, 1.0 / kFarthest, kFarthest);
  const ProjectionOperator op(observation);
  // The target is in units of sigma.
  if (op.target().head(op.NumPointRows()).squaredNorm() < static_cast<double>(op.NumPointRows()))
    return "all points lie in one place, wanted points spread over the body";
  return "";
}

Lifter::Lifter(const Dictionary& dictionary, LifterOptions options)
    : dictionary_(dictionary), options_(std::move(options)) {
  if (const std::string error = options_.Validate(); !error.empty())
    throw std::invalid_argument(error);
  prior_rows_.resize(0, dictionary.NumAtoms());
  if (dictionary.prior.Empty() || options_.prior_weight == 0.0) return;
  const Eigen::MatrixXd whitening = options_.prior_weight * dictionary.prior.whitening;
  prior_rows_ = whitening * dictionary.atoms;
  prior_target_ = whitening * dictionary.prior.mean_m;
}

std::vector<LiftSolution> Lifter::Solve(const Observation& observation) const {
  if (!CanLift(observation).empty()) return {};
  Alternation alternation(dictionary_, options_, observation, prior_rows_, prior_target_);
  auto starts =
      SearchViews(alternation.op(), alternation.centred_atoms(), options_.rotation, options_.views);
  if (IsWholePose(observation)) starts.resize(std::min<size_t>(starts.size(), 1));
  auto solutions = AtStarts(starts, dictionary_, alternation.op().Has2D());
  const int trial = std::min(options_.trial_alternations, options_.max_alternations);
  RunEach(alternation, trial, &solutions, static_cast<int>(solutions.size()));
  SortByObjective(&solutions);
  RunEach(alternation, options_.max_alternations - trial, &solutions, options_.num_finishing);
  SortByObjective(&solutions);
  if (!observation.relations.empty()) AddMirrored(observation, &alternation, &solutions);
  return Distinct(std::move(solutions), options_.distinct_m);
}

// A flip in depth is another minimum: the alternation does not get there by itself.
void Lifter::AddMirrored(const Observation& observation, Alternation* alternation,
                         std::vector<LiftSolution>* solutions) const {
  std::vector<LiftSolution> mirrored;
  for (int i = 0; i < options_.num_finishing && i < static_cast<int>(solutions->size()); ++i) {
    const LiftSolution& solution = (*solutions)[i];
    for (const DepthMirror& mirror :
         MirrorsInDepth(observation.relations, JointsInCam_m(solution))) {
      // A code for the mirrored pose, of the same picture.
      Observation in_depth = observation;
      for (int j = 0; j < kNumJoints; ++j)
        if (j != joint::kPelvis)
          in_depth.relations.push_back({.parts = {{j, 1.0}, {joint::kPelvis, -1.0}},
                                        .bound_m = mirror.depths_m[j],
                                        .sigma_m = kMirrorSigma_m});
      LiftSolution start;
      start.tau_rad = mirror.whole_body ? MirroredInDepth(solution.tau_rad) : solution.tau_rad;
      start.scale_px_per_m = solution.scale_px_per_m;
      LiftSolution coded = start;
      Alternation(dictionary_, options_, in_depth, prior_rows_, prior_target_).Run(1, &coded);
      start.tau_rad = coded.tau_rad;
      start.scale_px_per_m = coded.scale_px_per_m;
      alternation->StartFrom(coded.code, &start);
      alternation->Run(options_.trial_alternations, &start);
      mirrored.push_back(std::move(start));
    }
  }
  SortByObjective(&mirrored);
  for (int i = 0; i < options_.num_finishing && i < static_cast<int>(mirrored.size()); ++i)
    alternation->Run(options_.max_alternations, &mirrored[i]);
  solutions->insert(solutions->end(), mirrored.begin(), mirrored.end());
  SortByObjective(solutions);
}

std::vector<LiftSolution> Lifter::SolveFrom(const Observation& observation,
                                            const std::vector<ViewStart>& starts) const {
  if (!CanLift(observation).empty()) return {};
  Alternation alternation(dictionary_, options_, observation, prior_rows_, prior_target_);
  auto solutions = AtStarts(starts, dictionary_, alternation.op().Has2D());
  for (LiftSolution& solution : solutions) alternation.Run(options_.max_alternations, &solution);
  SortByObjective(&solutions);
  return solutions;
}

LiftSolution Lifter::GoOnFrom(const Observation& observation, LiftSolution start) const {
  Alternation alternation(dictionary_, options_, observation, prior_rows_, prior_target_);
  alternation.StartFrom(std::move(start.code), &start);
  alternation.Run(options_.max_alternations, &start);
  return start;
}

LiftSolution Lifter::Follow(const Observation& observation, LiftSolution start) const {
  LifterOptions options = options_;
  options.new_atoms_gain = kNewAtomsGain;
  Alternation alternation(dictionary_, options, observation, prior_rows_, prior_target_);
  alternation.StartFrom(std::move(start.code), &start);
  alternation.Run(1, &start);
  return start;
}

}  // namespace poselift
