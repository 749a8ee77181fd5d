// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/camera_refinement.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/rotation.h>
#include <ceres/solver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

namespace poselift {
namespace {

constexpr int kFirstCoefficient = 4;
using PoseVector = Eigen::Matrix<double, 6, 1>;  // angle times axis, translation

// Camera::Project (src/camera.h), for derivatives; without its test of the fold, which a
// minimiser must be able to step over.
struct CornerError {
  Eigen::Vector2d x_px;
  Eigen::Vector2d corner_in_board_m;

  template <typename T>
  bool operator()(const T* camera, const T* pose, T* residual_px) const {
    const T point[3] = {T(corner_in_board_m.x()), T(corner_in_board_m.y()), T(0)};
    T in_cam[3];
    ceres::AngleAxisRotatePoint(pose, point, in_cam);
    for (int i = 0; i < 3; ++i) in_cam[i] += pose[3 + i];
    if (!(in_cam[2] > 0.0)) return false;
    const T x = in_cam[0] / in_cam[2], y = in_cam[1] / in_cam[2];
    const T &k1 = camera[4], &k2 = camera[5], &p1 = camera[6], &p2 = camera[7], &k3 = camera[8];
    const T r2 = x * x + y * y;
    const T g = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const T x_d = x * g + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
    const T y_d = y * g + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
    residual_px[0] = x_px.x() - (camera[0] * x_d + camera[2]);
    residual_px[1] = x_px.y() - (camera[1] * y_d + camera[3]);
    return true;
  }
};

PoseVector ToVector(const Eigen::Isometry3d& pose) {
  PoseVector vector;
  const Eigen::Matrix3d R = pose.linear();
  ceres::RotationMatrixToAngleAxis(R.data(), vector.data());
  vector.tail<3>() = pose.translation();
  return vector;
}

Eigen::Isometry3d ToPose(const PoseVector& vector) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d R;
  ceres::AngleAxisToRotationMatrix(vector.data(), R.data());
  pose.linear() = R;
  pose.translation() = vector.tail<3>();
  return pose;
}

void SetParameters(const CameraParameters& p, Camera* camera) {
  camera->fx_px = p[0];
  camera->fy_px = p[1];
  camera->cx_px = p[2];
  camera->cy_px = p[3];
  camera->distortion = {.k1 = p[4], .k2 = p[5], .p1 = p[6], .p2 = p[7], .k3 = p[8]};
}

void AddView(const CalibrationBoard& board, const BoardView& view, double* camera, double* pose,
             ceres::LossFunction* loss, ceres::Problem* problem) {
  for (size_t i = 0; i < view.ids.size(); ++i)
    problem->AddResidualBlock(
        new ceres::AutoDiffCostFunction<CornerError, 2, kNumCameraParameters, 6>(
            new CornerError{view.corners_px.col(static_cast<Eigen::Index>(i)),
                            board.corners_in_board_m.col(view.ids[i])}),
        loss, camera, pose);
}

RefinementResult Solve(ceres::LinearSolverType linear_solver, ceres::Problem* problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = linear_solver;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-10;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem, &summary);
  RefinementResult result;
  result.is_done = summary.IsSolutionUsable();
  result.cost_px2 = summary.final_cost;
  return result;
}

// (sum_v A'A - A'B (B'B)^-1 B'A)^-1 with a view's derivatives by the camera, A, and by its own
// pose, B: the block of the camera in the inverse of the whole normal matrix.
void FindCovariance(const std::vector<const BoardView*>& views, int num_free,
                    const ceres::Problem::EvaluateOptions& blocks, ceres::Problem* problem,
                    RefinementResult* result) {
  constexpr double kLeastCondition = 1e-12;
  ceres::CRSMatrix rows;
  if (!problem->Evaluate(blocks, nullptr, nullptr, nullptr, &rows)) return;
  const Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>> J(
      rows.num_rows, rows.num_cols, static_cast<Eigen::Index>(rows.values.size()), rows.rows.data(),
      rows.cols.data(), rows.values.data());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(num_free, num_free);
  Eigen::Index row = 0;
  for (size_t v = 0; v < views.size(); ++v) {
    const auto num_rows = 2 * static_cast<Eigen::Index>(views[v]->ids.size());
    const Eigen::MatrixXd J_view = J.middleRows(row, num_rows);
    const auto A = J_view.leftCols(num_free);
    const auto B = J_view.middleCols(num_free + 6 * static_cast<Eigen::Index>(v), 6);
    const Eigen::MatrixXd A_left = A - B * B.householderQr().solve(A);
    information += A_left.transpose() * A_left;
    row += num_rows;
  }
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * information *
                                                             scale.asDiagonal());
  result->has_covariance = eigen.eigenvalues()[0] > kLeastCondition;  // false for NaN
  if (!result->has_covariance) return;
  result->covariance.topLeftCorner(num_free, num_free) =
      scale.asDiagonal() * eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
      eigen.eigenvectors().transpose() * scale.asDiagonal();
}

}  // namespace

const char* LensModelName(LensModel lens) {
  constexpr std::array kNames = {"none", "k1", "k1-k2", "k1-k2-p1-p2", "k1-k2-p1-p2-k3"};
  return kNames[static_cast<size_t>(lens)];
}

int NumFreeParameters(LensModel lens) {
  constexpr std::array kCoefficients = {0, 1, 2, 4, 5};
  return kFirstCoefficient + kCoefficients[static_cast<size_t>(lens)];
}

const std::array<const char*, kNumCameraParameters>& CameraParameterNames() {
  static constexpr std::array kNames = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"};
  return kNames;
}

CameraParameters ParametersOf(const Camera& camera) {
  const Distortion& d = camera.distortion;
  CameraParameters p;
  p << camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px, d.k1, d.k2, d.p1, d.p2, d.k3;
  return p;
}

RefinementResult RefineCamera(const CalibrationBoard& board,
                              const std::vector<const BoardView*>& views,
                              const RefinementOptions& options, CalibrationState* state) {
  ceres::HuberLoss loss(options.loss_px);
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  const int num_free = NumFreeParameters(options.lens);
  CameraParameters camera = ParametersOf(state->camera);
  camera.tail(kNumCameraParameters - num_free).setZero();
  std::vector<PoseVector> poses;
  for (const Eigen::Isometry3d& pose : state->cam_from_board) poses.push_back(ToVector(pose));
  for (size_t v = 0; v < views.size(); ++v)
    AddView(board, *views[v], camera.data(), poses[v].data(), &loss, &problem);
  if (num_free < kNumCameraParameters) {
    std::vector<int> fixed;
    for (int i = num_free; i < kNumCameraParameters; ++i) fixed.push_back(i);
    problem.SetManifold(camera.data(), new ceres::SubsetManifold(kNumCameraParameters, fixed));
  }
  RefinementResult result = Solve(ceres::DENSE_SCHUR, &problem);
  if (!result.is_done || !camera.allFinite()) return {};
  if (options.with_covariance) {
    ceres::Problem::EvaluateOptions blocks;
    blocks.parameter_blocks = {camera.data()};
    for (PoseVector& pose : poses) blocks.parameter_blocks.push_back(pose.data());
    FindCovariance(views, num_free, blocks, &problem, &result);
  }
  SetParameters(camera, &state->camera);
  for (size_t v = 0; v < views.size(); ++v) state->cam_from_board[v] = ToPose(poses[v]);
  return result;
}

RefinementResult RefineBoardPose(const CalibrationBoard& board, const BoardView& view,
                                 const Camera& camera, double loss_px,
                                 Eigen::Isometry3d* cam_from_board) {
  ceres::HuberLoss loss(loss_px);
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  CameraParameters parameters = ParametersOf(camera);
  PoseVector pose = ToVector(*cam_from_board);
  AddView(board, view, parameters.data(), pose.data(), &loss, &problem);
  problem.SetParameterBlockConstant(parameters.data());
  const RefinementResult result = Solve(ceres::DENSE_QR, &problem);
  if (result.is_done) *cam_from_board = ToPose(pose);
  return result;
}

Eigen::Matrix2Xd BoardResiduals_px(const CalibrationBoard& board, const BoardView& view,
                                   const Camera& camera, const Eigen::Isometry3d& cam_from_board) {
  Eigen::Matrix2Xd residuals_px(2, view.corners_px.cols());
  for (Eigen::Index i = 0; i < residuals_px.cols(); ++i) {
    Eigen::Vector3d corner_in_board_m(0, 0, 0);
    corner_in_board_m.head<2>() = board.corners_in_board_m.col(view.ids[static_cast<size_t>(i)]);
    residuals_px.col(i) =
        view.corners_px.col(i) - camera.Project(cam_from_board * corner_in_board_m);
  }
  return residuals_px;
}

double RmsOf(const Eigen::Matrix2Xd& residuals_px) {
  const double rms_px =
      std::sqrt(residuals_px.squaredNorm() /
                static_cast<double>(std::max<Eigen::Index>(residuals_px.cols(), 1)));
  return std::isfinite(rms_px) ? rms_px : std::numeric_limits<double>::infinity();
}

}  // namespace poselift
