// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/motion_methods.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lift/baselines/frame_ik.h"
#include "lift/baselines/local_pca.h"
#include "lift/temporal/motion_reconstruction.h"
#include "lift/temporal/path_reconstruction.h"
#include "ui/cli/motion_experiment.h"

namespace poselift::cli {
namespace {

// Of these the methods take the neighbours.
const SegmentSearchOptions kCandidates{.num_nearest = 200, .exclusion_frames = 15, .width = 200};

// How fast each feature changes from one frame to the next, for inverse
// kinematics that knows no more of motion.
FeatureVector ChangesOf(const MotionDatabase& database) {
  FeatureVector squares = FeatureVector::Constant(1e-12);
  long count = 0;
  for (const Trial& trial : database.trials)
    for (int t = 1; t < trial.num_frames; ++t, ++count)
      squares += (database.features.col(trial.first_frame + t) -
                  database.features.col(trial.first_frame + t - 1))
                     .cast<double>()
                     .cwiseAbs2();
  FeatureVector sigmas = (squares / std::max(1L, count)).cwiseSqrt();
  // The place, not the speed, is what stays.
  for (int row : {feature::kVelocity, feature::kVelocity + 1, feature::kYawRate})
    sigmas[row] = std::sqrt(database.features.row(row).cast<double>().squaredNorm() /
                            std::max(1, database.NumFrames()));
  return sigmas;
}

// Regression as the papers have it: the neighbours of the last poses alone.
MotionReconstructionOptions AsInPapers(LocalRegressionMethod method) {
  MotionReconstructionOptions options;
  options.observed_scale_per_m = 0.0;
  options.regression = {.method = method};
  return options;
}

}  // namespace

MotionMethods::MotionMethods(const MotionDatabase& database, uint64_t seed)
    : database_(database),
      style_options_{.seed = seed},
      row_weights_(RowWeights(database)),
      search_(database, row_weights_, kCandidates),
      paths_(database),
      style_(LearnStyle(database, style_options_)) {}

std::vector<NamedMotionMethod> MotionMethods::All() const {
  const auto regression = [&](std::string name, const MotionReconstructionOptions& options) {
    return NamedMotionMethod{std::move(name), [this, options] {
                               return std::make_unique<MotionReconstruction>(database_, search_,
                                                                             options);
                             }};
  };
  return {
      {"inverse kinematics",
       [this, sigmas = ChangesOf(database_)] {
         return std::make_unique<FrameIk>(database_.skeleton, database_.frame_time_s, sigmas);
       }},
      Gplvm("GPLVM", style_),
      {"local PCA", [this] { return std::make_unique<LocalPca>(database_, search_); }},
      regression("local PCR", AsInPapers(LocalRegressionMethod::kPrincipalComponents)),
      regression("local regression, as printed", AsInPapers(LocalRegressionMethod::kAsPrinted)),
      regression("local regression, PLS", AsInPapers(LocalRegressionMethod::kPartialLeastSquares)),
      regression("local regression, ridge", AsInPapers(LocalRegressionMethod::kRidge)),
      regression("poselift, by last poses", {}),
      {"poselift", [this] { return std::make_unique<PathReconstruction>(database_, paths_); }}};
}

NamedMotionMethod MotionMethods::GplvmOf(const std::string& action) {
  const auto& actions = PaperActions();
  const auto found = std::find_if(actions.begin(), actions.end(),
                                  [&](const Action& a) { return a.name == action; });
  const MotionDatabase similar = SubsetOfTrials(database_, found->similar);
  if (similar.NumFrames() == 0) return Gplvm(kGplvmOfTheAction, style_);
  if (!style_of_.contains(action)) style_of_[action] = LearnStyle(similar, style_options_);
  return Gplvm(kGplvmOfTheAction, style_of_[action]);
}

NamedMotionMethod MotionMethods::Gplvm(std::string name, const Style& style) const {
  return {std::move(name), [this, &style] {
            return std::make_unique<GplvmMotion>(style, database_.skeleton, database_.frame_time_s,
                                                 row_weights_);
          }};
}

const std::vector<std::string>& MethodsOfThePaper() {
  static const std::vector<std::string> kNames = {"GPLVM", MotionMethods::kGplvmOfTheAction,
                                                  "local PCA", "local PCR", "poselift"};
  return kNames;
}

}  // namespace poselift::cli
