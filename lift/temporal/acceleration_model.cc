// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/acceleration_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace poselift {
namespace {

constexpr double kBandwidth = 0.35;  // of the farthest neighbour's distance

}  // namespace

Eigen::VectorXd AccelerationMetric(const MotionCodebook& codebook) {
  const FeatureVector lever_arms_m = LeverArms(codebook).cwiseMax(kShortestLeverArm_m);
  Eigen::VectorXd metric(kAccelerationInputs);
  metric << lever_arms_m.head<kPoseRows>(), codebook.sample_time_s * lever_arms_m;
  return metric;
}

AccelerationModel::AccelerationModel(const MotionCodebook& codebook)
    : codebook_(codebook),
      metric_(AccelerationMetric(codebook).cast<float>()),
      inputs_(metric_.asDiagonal() * codebook.AccelerationInputs()),
      half_norms_(0.5f * inputs_.colwise().squaredNorm().transpose()),
      scores_(inputs_.cols()),
      order_(static_cast<size_t>(inputs_.cols())) {
  std::iota(order_.begin(), order_.end(), 0);
}

const AccelerationModel::Prediction& AccelerationModel::At(const FeatureVector& pose,
                                                           const FeatureVector& rates) {
  Eigen::Matrix<float, kAccelerationInputs, 1> x;
  x << pose.head<kPoseRows>().cast<float>(), rates.cast<float>();
  const Eigen::Matrix<float, kAccelerationInputs, 1> scaled = metric_.cwiseProduct(x);
  scores_ = half_norms_;
  scores_.noalias() -= inputs_.transpose() * scaled;  // half the squared distance, but |x|^2 / 2
  const auto count = std::min<std::ptrdiff_t>(kNumNeighbours, std::ssize(order_));
  std::partial_sort(order_.begin(), order_.begin() + count, order_.end(), [&](int a, int b) {
    return scores_[a] != scores_[b] ? scores_[a] < scores_[b] : a < b;
  });

  const double least = scores_[order_.front()];
  const double half_norm = 0.5 * static_cast<double>(scaled.squaredNorm());
  const double farthest =
      std::max(1e-12, scores_[order_[static_cast<size_t>(count - 1)]] + half_norm);
  prediction_.mean.setZero();
  prediction_.variance.setZero();
  double sum = 0.0;
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const int c = order_[static_cast<size_t>(k)];
    const double weight =
        std::exp(-(scores_[c] - least) / (2.0 * kBandwidth * kBandwidth * farthest));
    const AccelerationModels& models = codebook_.accelerations;
    Eigen::Matrix<float, kAccelerationInputs, 1> off = x;
    off.head<kPoseRows>() -=
        codebook_.segments.col(c).segment<kPoseRows>(kMiddleSample * kNumFeatures);
    off.tail<kNumFeatures>() -= codebook_.rates.col(c);
    FeatureVector mean = models.means.col(c).cast<double>();
    for (int r = 0; r < kAccelerationRank; ++r)
      mean += static_cast<double>(models.directions.col(c)
                                      .segment<kAccelerationInputs>(r * kAccelerationInputs)
                                      .dot(off)) *
              models.responses.col(c).segment<kNumFeatures>(r * kNumFeatures).cast<double>();
    prediction_.mean += weight * mean;
    prediction_.variance +=
        weight * (models.deviations.col(c).cast<double>().cwiseAbs2() + mean.cwiseAbs2());
    sum += weight;
  }
  prediction_.mean /= sum;
  prediction_.variance = (prediction_.variance / sum - prediction_.mean.cwiseAbs2()).cwiseMax(0.0);
  return prediction_;
}

}  // namespace poselift
