// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/lens_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "calib/calibration_start.h"

namespace poselift {
namespace {

constexpr size_t kFewestViews = 4;
constexpr double kLoss_px = 1.0;
constexpr double kLittleWorse = 0.05;  // of the squared error: not worth a coefficient

struct Fold {
  std::vector<const BoardView*> views;  // of the fit
  CalibrationState state;
  std::vector<size_t> left_out;
};

Fold WithoutGroup(const std::vector<const BoardView*>& views, const CalibrationState& state,
                  size_t group, size_t num_groups) {
  Fold fold;
  fold.state.camera = state.camera;
  for (size_t v = 0; v < views.size(); ++v) {
    if (v % num_groups == group) {
      fold.left_out.push_back(v);
      continue;
    }
    fold.views.push_back(views[v]);
    fold.state.cam_from_board.push_back(state.cam_from_board[v]);
  }
  return fold;
}

// Mean squared distance of each view's corners, by a camera that has not seen the view.
Eigen::VectorXd LeftOutErrors_px2(const CalibrationBoard& board,
                                  const std::vector<const BoardView*>& views,
                                  const CalibrationState& state, LensModel lens) {
  const size_t num_folds = std::min<size_t>(views.size(), 6);
  Eigen::VectorXd errors_px2 = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(views.size()),
                                                         std::numeric_limits<double>::infinity());
  for (size_t group = 0; group < num_folds; ++group) {
    Fold fold = WithoutGroup(views, state, group, num_folds);
    if (!RefineCamera(board, fold.views, {.lens = lens, .loss_px = kLoss_px}, &fold.state).is_done)
      continue;
    for (const size_t v : fold.left_out) {
      Eigen::Isometry3d pose = state.cam_from_board[v];
      if (!RefineBoardPose(board, *views[v], fold.state.camera, kLoss_px, &pose).is_done) continue;
      const double rms_px = RmsOf(BoardResiduals_px(board, *views[v], fold.state.camera, pose));
      errors_px2[static_cast<Eigen::Index>(v)] = rms_px * rms_px;
    }
  }
  return errors_px2;
}

// Of the mean of these numbers.
double StandardError(const Eigen::VectorXd& x) {
  const auto n = static_cast<double>(x.size());
  return std::sqrt((x.array() - x.mean()).square().sum() / (n - 1.0) / n);
}

}  // namespace

LensModel SelectLensModel(const CalibrationBoard& board, const std::vector<const BoardView*>& views,
                          const CalibrationState& state) {
  if (views.size() < kFewestViews) return LensModel::kK1;
  std::array<Eigen::VectorXd, kLensModels.size()> errors_px2;
  size_t best = 0;
  for (size_t m = 0; m < kLensModels.size(); ++m) {
    errors_px2[m] = LeftOutErrors_px2(board, views, state, kLensModels[m]);
    if (errors_px2[m].mean() < errors_px2[best].mean()) best = m;
  }
  for (size_t m = 0; m < best; ++m) {
    const Eigen::VectorXd worse_px2 = errors_px2[m] - errors_px2[best];
    if (worse_px2.allFinite() &&
        worse_px2.mean() <=
            std::max(StandardError(worse_px2), kLittleWorse * errors_px2[best].mean()))
      return kLensModels[m];
  }
  return kLensModels[best];
}

CameraParameters JackknifeSigma(const CalibrationBoard& board,
                                const std::vector<const BoardView*>& views,
                                const CalibrationState& state, LensModel lens, double loss_px) {
  if (views.size() < kFewestViews) return CameraParameters::Zero();
  const size_t num_groups = std::min<size_t>(views.size(), 20);
  Eigen::Matrix<double, kNumCameraParameters, Eigen::Dynamic> estimates(
      kNumCameraParameters, static_cast<Eigen::Index>(num_groups));
  for (size_t group = 0; group < num_groups; ++group) {
    Fold fold = WithoutGroup(views, state, group, num_groups);
    RefineCamera(board, fold.views, {.lens = lens, .loss_px = loss_px}, &fold.state);
    estimates.col(static_cast<Eigen::Index>(group)) = ParametersOf(fold.state.camera);
  }
  const auto n = static_cast<double>(num_groups);
  const CameraParameters mean = estimates.rowwise().mean();
  const CameraParameters sum = (estimates.colwise() - mean).rowwise().squaredNorm();
  return ((n - 1.0) / n * sum).cwiseSqrt();
}

}  // namespace poselift
