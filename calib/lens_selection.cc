// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/lens_selection.h"

#include <algorithm>
#include <cmath>

namespace poselift {
namespace {

constexpr size_t kFewestViews = 4;
// Sigmas. More than chance alone asks for: what the corners of a view have in common, a board
// that is not quite flat, is not in the sigmas.
constexpr double kTold = 5.0;

struct Fold {
  std::vector<const BoardView*> views;
  CalibrationState state;
};

Fold WithoutGroup(const std::vector<const BoardView*>& views, const CalibrationState& state,
                  size_t group, size_t num_groups) {
  Fold fold;
  fold.state.camera = state.camera;
  for (size_t v = 0; v < views.size(); ++v) {
    if (v % num_groups == group) continue;
    fold.views.push_back(views[v]);
    fold.state.cam_from_board.push_back(state.cam_from_board[v]);
  }
  return fold;
}

// Whether one of the coefficients that this model has and the next smaller one has not is
// told from 0.
bool IsTold(const CalibrationState& state, const CameraParameters& sigma, LensModel lens,
            LensModel smaller) {
  const CameraParameters parameters = ParametersOf(state.camera);
  for (int i = NumFreeParameters(smaller); i < NumFreeParameters(lens); ++i)
    if (std::abs(parameters[i]) > kTold * sigma[i]) return true;
  return false;
}

}  // namespace

LensModel SelectLensModel(const CalibrationBoard& board, const std::vector<const BoardView*>& views,
                          double loss_px, CalibrationState state) {
  for (size_t m = kLensModels.size(); m-- > 1;) {
    const RefinementOptions options{kLensModels[m], loss_px, true};
    const RefinementResult refined = RefineCamera(board, views, options, &state);
    if (!refined.is_done || !refined.has_covariance) continue;
    const CameraParameters sigma =
        loss_px / kLossSigmas * refined.covariance.diagonal().cwiseSqrt();
    if (IsTold(state, sigma, kLensModels[m], kLensModels[m - 1])) return kLensModels[m];
  }
  return kLensModels.front();
}

CameraParameters JackknifeSigma(const CalibrationBoard& board,
                                const std::vector<const BoardView*>& views,
                                const CalibrationState& state, LensModel lens, double loss_px) {
  if (views.size() < kFewestViews) return CameraParameters::Zero();
  const size_t num_groups = std::min<size_t>(views.size(), 10);
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
