// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/train_codebook.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lift/train/kmeans.h"
#include "src/forward_kinematics.h"

namespace poselift {
namespace {

// The part of the variance that k-means does not see. It leaves about a quarter
// of the dimensions.
constexpr double kUnseenVariance = 1e-3;
constexpr Eigen::Index kBlock = 256;

auto MiddleSamples(const MotionCodebook& codebook) {
  return codebook.segments.middleRows<kNumFeatures>(kMiddleSample * kNumFeatures);
}

// The 23 joints at the middle sample: 69 x n, metres.
Eigen::MatrixXd MiddleJoints_m(const MotionCodebook& codebook) {
  const JointSites sites = FindJointSites(codebook.skeleton);
  Eigen::MatrixXd joints_m(3 * kNumJoints, codebook.segments.cols());
  BoneFrames frames;
  for (Eigen::Index k = 0; k < joints_m.cols(); ++k) {
    const SkeletonPose pose = PoseOfSample(MiddleSamples(codebook).col(k).cast<double>());
    ForwardKinematics(codebook.skeleton, pose, &frames);
    joints_m.col(k) = Stacked(JointPositions(sites, frames));
  }
  return joints_m;
}

// Segments and rates in metres, without what varies little: a column a segment.
Eigen::MatrixXd Points(const MotionCodebook& segments) {
  const FeatureVector lever_arms_m = LeverArms(segments).cwiseMax(kShortestLeverArm_m);
  Eigen::MatrixXd points(kSegmentRows + kNumFeatures, segments.segments.cols());
  points << lever_arms_m.replicate<kSegmentSamples, 1>().asDiagonal() *
                segments.segments.cast<double>(),
      (segments.sample_time_s * lever_arms_m).asDiagonal() * segments.rates.cast<double>();
  points.colwise() -= points.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(points * points.transpose());
  const Eigen::VectorXd& variances = eigen.eigenvalues();  // the smallest first
  Eigen::Index first = 0;
  for (double unseen = variances[0];
       first + 1 < variances.size() && unseen <= kUnseenVariance * variances.sum();)
    unseen += variances[++first];
  return eigen.eigenvectors().rightCols(variances.size() - first).transpose() * points;
}

// Cells are numbered anew. When all are small, all stay.
void DissolveSmallCells(const Eigen::MatrixXd& points, int least_members, Eigen::VectorXi* cells) {
  std::vector<int> counts(static_cast<size_t>(cells->maxCoeff()) + 1, 0);
  for (const int cell : *cells) ++counts[cell];
  std::vector<int> number(counts.size(), -1);
  int kept = 0;
  for (size_t c = 0; c < counts.size(); ++c)
    if (counts[c] >= least_members) number[c] = kept++;
  if (kept == 0) return;
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(points.rows(), kept);
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    if (const int cell = (*cells)[j]; number[cell] >= 0)
      means.col(number[cell]) += points.col(j) / counts[cell];
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    int& cell = (*cells)[j];
    cell = number[cell];
    if (cell < 0) (means.colwise() - points.col(j)).colwise().squaredNorm().minCoeff(&cell);
  }
}

// Sums of the members' columns.
template <typename Matrix>
Eigen::MatrixXd SumsOfCells(const Matrix& columns, const Eigen::VectorXi& cells, int num_cells) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(columns.rows(), num_cells);
  for (Eigen::Index j = 0; j < cells.size(); ++j)
    sums.col(cells[j]) += columns.col(j).template cast<double>();
  return sums;
}

Eigen::MatrixXd Deviations(const MotionCodebook& segments, const Eigen::VectorXi& cells,
                           const Eigen::MatrixXd& means, const Eigen::VectorXd& counts) {
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(kNumFeatures, counts.size());
  for (Eigen::Index j = 0; j < cells.size(); ++j)
    squares.col(cells[j]) +=
        (MiddleSamples(segments).col(j).cast<double>() - means.col(cells[j])).cwiseAbs2();
  const double degrees =
      static_cast<double>(std::max<Eigen::Index>(1, cells.size() - counts.size()));
  const Eigen::VectorXd usual = squares.rowwise().sum() / degrees;
  squares.colwise() += usual;
  return (squares * counts.cwiseInverse().asDiagonal()).cwiseSqrt();
}

}  // namespace

std::string CodebookOptions::Validate() const {
  if (num_segments < 1)
    return fmt::format("CodebookOptions::num_segments = {}, wanted at least 1", num_segments);
  if (iterations < 1)
    return fmt::format("CodebookOptions::iterations = {}, wanted at least 1", iterations);
  if (least_members < 1)
    return fmt::format("CodebookOptions::least_members = {}, wanted at least 1", least_members);
  return accelerations.Validate();
}

MotionCodebook TrainCodebook(const MotionCodebook& segments, const CodebookOptions& options,
                             const ProgressFn& progress, CodebookReport* report) {
  const auto part = [&](double from) -> ProgressFn {
    if (!progress) return {};
    return [&progress, from](double share) { progress(from + 0.5 * share); };
  };
  const Eigen::MatrixXd points = Points(segments);
  Eigen::VectorXi cells =
      KMeans(points, options.num_segments, options.iterations, options.seed, part(0.0));
  DissolveSmallCells(points, options.least_members, &cells);
  const int num_cells = cells.maxCoeff() + 1;
  report->members.assign(static_cast<size_t>(num_cells), 0);
  for (const int cell : cells) ++report->members[cell];
  const Eigen::VectorXd counts =
      Eigen::Map<const Eigen::VectorXi>(report->members.data(), num_cells).cast<double>();
  const auto means_of = [&](const auto& columns) -> Eigen::MatrixXd {
    return SumsOfCells(columns, cells, num_cells) * counts.cwiseInverse().asDiagonal();
  };

  MotionCodebook codebook;
  codebook.skeleton = segments.skeleton;
  codebook.sample_time_s = segments.sample_time_s;
  const Eigen::MatrixXd means = means_of(segments.segments);
  codebook.segments = means.cast<float>();
  codebook.rates = means_of(segments.rates).template cast<float>();
  codebook.deviations =
      Deviations(segments, cells, means.middleRows<kNumFeatures>(kMiddleSample * kNumFeatures),
                 counts)
          .cast<float>();
  TrainAccelerations(segments, options.accelerations, part(0.5), &codebook);
  const Eigen::MatrixXd captured_m = MiddleJoints_m(segments), learned_m = MiddleJoints_m(codebook);
  double squared = 0.0;
  for (Eigen::Index j = 0; j < cells.size(); ++j)
    squared += (captured_m.col(j) - learned_m.col(cells[j])).squaredNorm();
  report->rms_error_m = std::sqrt(squared / static_cast<double>(kNumJoints * cells.size()));
  codebook.record.num_segments = cells.size();
  codebook.record.seed = options.seed;
  codebook.record.rms_error_mm = 1e3 * report->rms_error_m;
  return codebook;
}

double MeanDistanceToNearest_m(const MotionCodebook& captured, const MotionCodebook& codebook) {
  const Eigen::MatrixXd captured_m = MiddleJoints_m(captured), learned_m = MiddleJoints_m(codebook);
  const Eigen::VectorXd half_norms = 0.5 * learned_m.colwise().squaredNorm().transpose();
  double sum_m = 0.0;
  for (Eigen::Index first = 0; first < captured_m.cols(); first += kBlock) {
    const auto block = captured_m.middleCols(first, std::min(kBlock, captured_m.cols() - first));
    Eigen::MatrixXd scores = learned_m.transpose() * block;
    scores.colwise() -= half_norms;
    for (Eigen::Index j = 0; j < block.cols(); ++j) {
      Eigen::Index nearest = 0;
      scores.col(j).maxCoeff(&nearest);
      sum_m +=
          (Unstacked(block.col(j)) - Unstacked(learned_m.col(nearest))).colwise().norm().mean();
    }
  }
  return sum_m / static_cast<double>(captured_m.cols());
}

}  // namespace poselift
