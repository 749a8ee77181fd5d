// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/difference_cost.h"

#include <ceres/cost_function.h>

#include <utility>

namespace poselift {
namespace {

class DifferenceCost final : public ceres::CostFunction {
 public:
  DifferenceCost(std::vector<double> coefficients, Eigen::VectorXd target,
                 Eigen::VectorXd root_weights)
      : coefficients_(std::move(coefficients)),
        target_(std::move(target)),
        root_weights_(std::move(root_weights)) {
    const int size = static_cast<int>(target_.size());
    set_num_residuals(size);
    mutable_parameter_block_sizes()->assign(coefficients_.size(), size);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    using Block = Eigen::Map<const Eigen::VectorXd>;
    const Eigen::Index size = target_.size();
    Eigen::Map<Eigen::VectorXd> difference(residuals, size);
    difference = -target_;
    for (size_t b = 0; b < coefficients_.size(); ++b)
      difference += coefficients_[b] * Block(parameters[b], size);
    difference.array() *= root_weights_.array();
    if (!jacobians) return true;
    for (size_t b = 0; b < coefficients_.size(); ++b)
      if (jacobians[b])
        Eigen::Map<Eigen::MatrixXd>(jacobians[b], size, size) =
            (coefficients_[b] * root_weights_).asDiagonal();  // its own transpose
    return true;
  }

 private:
  std::vector<double> coefficients_;
  Eigen::VectorXd target_, root_weights_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> MakeDifferenceCost(std::vector<double> coefficients,
                                                        Eigen::VectorXd target,
                                                        Eigen::VectorXd root_weights) {
  return std::make_unique<DifferenceCost>(std::move(coefficients), std::move(target),
                                          std::move(root_weights));
}

}  // namespace poselift
