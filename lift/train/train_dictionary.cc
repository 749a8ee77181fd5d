// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/train_dictionary.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "lift/train/batch_omp.h"
#include "lift/train/kmeans.h"

namespace poselift {
namespace {

constexpr int kKMeansIterations = 30;
// The size rule codes this many poses of a subset to estimate its error.
constexpr Eigen::Index kSizeRuleSample = 2000;

Eigen::MatrixXd Columns(const Eigen::MatrixXd& matrix, const std::vector<int>& columns) {
  Eigen::MatrixXd chosen(matrix.rows(), static_cast<Eigen::Index>(columns.size()));
  for (size_t i = 0; i < columns.size(); ++i)
    chosen.col(static_cast<Eigen::Index>(i)) = matrix.col(columns[i]);
  return chosen;
}

std::vector<std::vector<int>> SplitBySubset(const Eigen::MatrixXd& poses,
                                            const TrainOptions& options) {
  const Eigen::VectorXi clusters =
      KMeans(poses, options.num_subsets, kKMeansIterations, options.seed);
  std::vector<std::vector<int>> subsets(static_cast<size_t>(clusters.maxCoeff()) + 1);
  for (int j = 0; j < clusters.size(); ++j) subsets[clusters[j]].push_back(j);
  return subsets;
}

std::vector<int> Shuffled(Eigen::Index count, std::uint64_t seed) {
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 rng(seed);
  std::shuffle(order.begin(), order.end(), rng);
  return order;
}

// The subset's share of options.num_atoms, by the size rule where 0.
int NumAtoms(const Eigen::MatrixXd& subset, const std::vector<int>& drawn, Eigen::Index num_poses,
             const TrainOptions& options) {
  if (options.num_atoms == 0) return AtomsForTarget(subset, drawn, options);
  const double share = static_cast<double>(subset.cols()) / static_cast<double>(num_poses);
  const auto wanted = std::lround(options.num_atoms * share);
  return static_cast<int>(std::clamp<Eigen::Index>(wanted, 1, subset.cols()));
}

}  // namespace

std::string TrainOptions::Validate() const {
  if (num_atoms < 0)
    return fmt::format("TrainOptions::num_atoms = {}, wanted 0 (automatic) or more", num_atoms);
  if (!(target_error_m > 0.0))
    return fmt::format("TrainOptions::target_error_m = {}, wanted more than 0", target_error_m);
  if (!(delta >= 1.0)) return fmt::format("TrainOptions::delta = {}, wanted at least 1", delta);
  if (first_atoms < 1)
    return fmt::format("TrainOptions::first_atoms = {}, wanted at least 1", first_atoms);
  if (num_subsets < 1)
    return fmt::format("TrainOptions::num_subsets = {}, wanted at least 1", num_subsets);
  if (num_threads < 0)
    return fmt::format("TrainOptions::num_threads = {}, wanted 0 (all) or more", num_threads);
  return ksvd.Validate();
}

int AtomsForTarget(const Eigen::MatrixXd& poses, const std::vector<int>& drawn,
                   const TrainOptions& options) {
  // Coded poses from the end of the draw: they are atoms last.
  const Eigen::Index sample = std::min(kSizeRuleSample, poses.cols());
  const Eigen::MatrixXd coded = Columns(poses, {drawn.end() - sample, drawn.end()});
  const int most = static_cast<int>(poses.cols());
  for (int n = std::min(options.first_atoms, most);;
       n = std::min(most, static_cast<int>(std::ceil(1.5 * n)))) {
    Eigen::MatrixXd atoms = Columns(poses, {drawn.begin(), drawn.begin() + n});
    atoms.colwise().normalize();
    const double error =
        CodingErrors(atoms, coded, BatchOmp(atoms, coded, options.ksvd.sparsity)).sum();
    if (n == most || JointRms_m(error, sample) <= options.delta * options.target_error_m) return n;
  }
}

Eigen::MatrixXd TrainAtoms(const Eigen::MatrixXd& poses, const TrainOptions& options,
                           const ProgressFn& progress, TrainReport* report) {
  const auto subsets = SplitBySubset(poses, options);
  std::vector<Eigen::MatrixXd> atoms(subsets.size());
  report->subsets.assign(subsets.size(), {});
  long done = 0;
  const int threads = options.num_threads > 0 ? options.num_threads : omp_get_max_threads();
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (size_t s = 0; s < subsets.size(); ++s) {
    const Eigen::MatrixXd subset = Columns(poses, subsets[s]);
    const std::vector<int> drawn = Shuffled(subset.cols(), options.seed + s);
    const int n = NumAtoms(subset, drawn, poses.cols(), options);
    atoms[s] = Columns(subset, {drawn.begin(), drawn.begin() + n});
    report->subsets[s] = {static_cast<long>(subset.cols()),
                          TrainKsvd(subset, options.ksvd, &atoms[s])};
#pragma omp critical
    {
      done += static_cast<long>(subset.cols());
      if (progress) progress(static_cast<double>(done) / static_cast<double>(poses.cols()));
    }
  }

  Eigen::Index total = 0;
  double squared = 0.0;
  for (size_t s = 0; s < subsets.size(); ++s) {
    total += atoms[s].cols();
    const double rms = report->subsets[s].ksvd.rms_error_m.back();
    squared += rms * rms * static_cast<double>(subsets[s].size());
  }
  report->rms_error_m = std::sqrt(squared / static_cast<double>(poses.cols()));
  Eigen::MatrixXd joined(poses.rows(), total);
  Eigen::Index next = 0;
  for (const Eigen::MatrixXd& part : atoms) {
    joined.middleCols(next, part.cols()) = part;
    next += part.cols();
  }
  return joined;
}

Dictionary TrainDictionary(const TrainingPoses& loaded, bool mirrored, const TrainOptions& options,
                           const ProgressFn& progress, TrainReport* report) {
  const Eigen::MatrixXd poses_m = mirrored ? WithMirrored(loaded.poses_m) : loaded.poses_m;
  Dictionary dictionary;
  dictionary.atoms = TrainAtoms(poses_m, options, progress, report);
  dictionary.skeleton = loaded.standard;
  dictionary.typical_norm_m = poses_m.colwise().norm().mean();
  dictionary.prior = LearnPosePrior(poses_m);
  dictionary.record = {.sources = loaded.files,
                       .num_poses = poses_m.cols(),
                       .mirrored = mirrored,
                       .sparsity = options.ksvd.sparsity,
                       .num_subsets = options.num_subsets,
                       .seed = options.seed,
                       .rms_error_mm = 1e3 * report->rms_error_m};
  return dictionary;
}

}  // namespace poselift
