// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "calib/calibration_board.h"
#include "src/camera.h"

namespace poselift {

// Coefficients of Camera's distortion (src/camera.h) that are free; the others are 0.
enum class LensModel { kPinhole, kK1, kK1K2, kK1K2P1P2, kK1K2P1P2K3 };
inline constexpr std::array kLensModels = {LensModel::kPinhole, LensModel::kK1, LensModel::kK1K2,
                                           LensModel::kK1K2P1P2, LensModel::kK1K2P1P2K3};
const char* LensModelName(LensModel lens);  // "none", "k1", "k1-k2", ...
int NumFreeParameters(LensModel lens);      // of the camera: 4 to 9

// fx, fy, cx, cy, k1, k2, p1, p2, k3; the first four in px.
inline constexpr int kNumCameraParameters = 9;
using CameraParameters = Eigen::Matrix<double, kNumCameraParameters, 1>;
using CameraCovariance = Eigen::Matrix<double, kNumCameraParameters, kNumCameraParameters>;
const std::array<const char*, kNumCameraParameters>& CameraParameterNames();
CameraParameters ParametersOf(const Camera& camera);

// A camera and where each view has the board.
struct CalibrationState {
  Camera camera;
  std::vector<Eigen::Isometry3d> cam_from_board;  // metres
};

// Minimises over the camera and the poses of views v with corners i
//
//   sum_vi  rho(|x_vi - Project(cam_from_board_v X_i)|^2)
//
// with Huber's rho, linear beyond loss_px, by Levenberg and Marquardt (Ceres). The state is
// the start; it stays as it was where this fails.
struct RefinementOptions {
  LensModel lens = LensModel::kK1K2P1P2;
  double loss_px = 1.0;
  bool with_covariance = false;
};

struct RefinementResult {
  bool is_done = false;
  double cost_px2 = 0.0;
  // Of the camera's parameters, for corners with a noise of 1 px in x and in y, fixed ones 0.
  // Not known where the views leave a parameter open.
  bool has_covariance = false;
  CameraCovariance covariance = CameraCovariance::Zero();
};

RefinementResult RefineCamera(const CalibrationBoard& board,
                              const std::vector<const BoardView*>& views,
                              const RefinementOptions& options, CalibrationState* state);

// The same over one pose, the camera known.
RefinementResult RefineBoardPose(const CalibrationBoard& board, const BoardView& view,
                                 const Camera& camera, double loss_px,
                                 Eigen::Isometry3d* cam_from_board);

// Seen minus projected, 2 x corners; NaN for what the camera does not show.
Eigen::Matrix2Xd BoardResiduals_px(const CalibrationBoard& board, const BoardView& view,
                                   const Camera& camera, const Eigen::Isometry3d& cam_from_board);

// Root of the mean squared distance; infinite with NaN in it.
double RmsOf(const Eigen::Matrix2Xd& residuals_px);

}  // namespace poselift
