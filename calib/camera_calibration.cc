// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/camera_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "calib/calibration_start.h"
#include "calib/lens_selection.h"
#include "src/units.h"

namespace poselift {
namespace {

constexpr double kStartLoss_px = 2.0;
constexpr double kLeastLoss_px = 0.01;

using ViewList = std::vector<const BoardView*>;

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Camera PlainCamera(cv::Size size_px, double focal_px) {
  return {size_px.width,
          size_px.height,
          focal_px,
          focal_px,
          0.5 * (size_px.width - 1),
          0.5 * (size_px.height - 1),
          {}};
}

// The pose of each view by this camera; views that can have none leave the list. False when
// hardly any is left.
bool FindPoses(const CalibrationBoard& board, ViewList* views, CalibrationState* state) {
  ViewList placed;
  state->cam_from_board.clear();
  for (const BoardView* view : *views)
    if (const auto pose = FindBoardPose(board, *view, state->camera, kStartLoss_px)) {
      placed.push_back(view);
      state->cam_from_board.push_back(*pose);
    }
  *views = placed;
  return views->size() >= 2;
}

// Views evenly among these, enough to start from.
ViewList Some(const ViewList& views) {
  constexpr size_t kEnough = 12;
  const size_t step = (views.size() + kEnough - 1) / kEnough;
  ViewList some;
  for (size_t v = 0; v < views.size(); v += step) some.push_back(views[v]);
  return some;
}

// The best of several starts: the focal length that the views say, and some that cameras have.
std::optional<CalibrationState> Start(const CalibrationBoard& board, cv::Size size_px,
                                      LensModel lens, ViewList* views) {
  std::vector<Eigen::Matrix3d> homographies;
  for (const BoardView* view : *views)
    if (const auto homography = BoardHomography(board, *view)) homographies.push_back(*homography);
  const double longer_px = std::max(size_px.width, size_px.height);
  std::vector<double> focal_lengths_px = {0.6 * longer_px, 1.0 * longer_px, 2.0 * longer_px};
  if (const auto f_px = FocalLengthFromViews_px(homographies, size_px.width, size_px.height))
    focal_lengths_px.insert(focal_lengths_px.begin(), *f_px);
  std::optional<CalibrationState> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double f_px : focal_lengths_px) {
    CalibrationState state{PlainCamera(size_px, f_px), {}};
    ViewList some = Some(*views);
    if (!FindPoses(board, &some, &state)) continue;
    const RefinementResult refined =
        RefineCamera(board, some, {.lens = lens, .loss_px = kStartLoss_px}, &state);
    const double cost_px2 = refined.cost_px2 / static_cast<double>(some.size());
    if (!refined.is_done || cost_px2 >= least * (1.0 - 1e-6)) continue;
    least = cost_px2;
    best = state;
  }
  if (best && !FindPoses(board, views, &*best)) return std::nullopt;
  return best;
}

// A parameter each of 2 x corners x, y against its noise: half the median of squares over ln 2,
// which outliers do not move.
double NoiseOf_px(const CalibrationBoard& board, const ViewList& views,
                  const CalibrationState& state, LensModel lens) {
  std::vector<double> squares_px2;
  for (size_t v = 0; v < views.size(); ++v) {
    const Eigen::Matrix2Xd r =
        BoardResiduals_px(board, *views[v], state.camera, state.cam_from_board[v]);
    for (Eigen::Index i = 0; i < r.cols(); ++i) squares_px2.push_back(r.col(i).squaredNorm());
  }
  const double num_numbers = 2.0 * static_cast<double>(squares_px2.size());
  const double num_parameters = NumFreeParameters(lens) + 6.0 * static_cast<double>(views.size());
  const double num_redundant = std::max(1.0, num_numbers - num_parameters);
  return std::sqrt(Median(squares_px2) / (2.0 * std::log(2.0)) * num_numbers / num_redundant);
}

double LossOf_px(double noise_px) { return std::max(kLeastLoss_px, kLossSigmas * noise_px); }

// Refines with the loss that the noise asks for.
RefinementResult RefineToNoise(const CalibrationBoard& board, const ViewList& views, LensModel lens,
                               CalibrationState* state, double* noise_px) {
  RefinementResult refined;
  for (int round = 0; round < 3; ++round) {
    *noise_px = NoiseOf_px(board, views, *state, lens);
    refined = RefineCamera(
        board, views,
        {.lens = lens, .loss_px = LossOf_px(*noise_px), .with_covariance = round == 2}, state);
    if (!refined.is_done) return refined;
  }
  *noise_px = NoiseOf_px(board, views, *state, lens);
  return refined;
}

// The view that fits much worse than the others, if there is one.
std::optional<size_t> WorstView(const CalibrationBoard& board, const ViewList& views,
                                const CalibrationState& state, const CalibrationOptions& options) {
  std::vector<double> rms_px;
  for (size_t v = 0; v < views.size(); ++v)
    rms_px.push_back(
        RmsOf(BoardResiduals_px(board, *views[v], state.camera, state.cam_from_board[v])));
  const double median_px = Median(rms_px);
  const auto worst = std::max_element(rms_px.begin(), rms_px.end());
  if (*worst <= std::max(options.bad_view_ratio * median_px, median_px + options.least_bad_view_px))
    return std::nullopt;
  return static_cast<size_t>(worst - rms_px.begin());
}

// Drops bad views, the worst first: it spoils the others' fit. False when no camera fits.
bool DropBadViews(const CalibrationBoard& board, LensModel lens, const CalibrationOptions& options,
                  ViewList* views, CalibrationState* state, double* noise_px) {
  while (RefineToNoise(board, *views, lens, state, noise_px).is_done) {
    if (static_cast<int>(views->size()) <= options.fewest_views) return true;
    const auto worst = WorstView(board, *views, *state, options);
    if (!worst) return true;
    views->erase(views->begin() + static_cast<std::ptrdiff_t>(*worst));
    state->cam_from_board.erase(state->cam_from_board.begin() +
                                static_cast<std::ptrdiff_t>(*worst));
    // What was left may have been pulled into the other one of two like poses.
    if (!FindPoses(board, views, state)) return false;
  }
  return false;
}

// Between the board's planes of any two views.
double LargestTurn_rad(const CalibrationState& state) {
  double largest_rad = 0.0;
  for (const Eigen::Isometry3d& a : state.cam_from_board)
    for (const Eigen::Isometry3d& b : state.cam_from_board) {
      const Eigen::Vector3d n_a = a.linear().col(2), n_b = b.linear().col(2);
      largest_rad =
          std::max(largest_rad, std::atan2(n_a.cross(n_b).norm(), std::abs(n_a.dot(n_b))));
    }
  return largest_rad;
}

// Whether the views hold all parameters fast; what they do not goes into the status.
CalibrationStatus Judge(const CalibrationState& state, double rms_px, bool has_covariance,
                        const CameraParameters& sigma, const CalibrationOptions& options) {
  const int larger_side_px = std::max(state.camera.width_px, state.camera.height_px);
  if (rms_px > options.largest_rms * larger_side_px) return CalibrationStatus::kBoardMisfits;
  if (LargestTurn_rad(state) < options.least_turn_rad) return CalibrationStatus::kViewsParallel;
  const double focal_sigma = std::max(sigma[0] / state.camera.fx_px, sigma[1] / state.camera.fy_px);
  if (!has_covariance || !(focal_sigma <= options.largest_focal_sigma))
    return CalibrationStatus::kFocalUnknown;
  return state.camera.Validate().empty() ? CalibrationStatus::kDone : CalibrationStatus::kFailed;
}

CalibratedView Describe(const CalibrationBoard& board, const BoardView& view, const Camera& camera,
                        const Eigen::Isometry3d* used_pose, double loss_px) {
  CalibratedView described;
  described.is_used = used_pose != nullptr;
  described.rms_px = std::numeric_limits<double>::infinity();
  const auto pose =
      used_pose ? std::optional(*used_pose) : FindBoardPose(board, view, camera, loss_px);
  if (!pose) return described;
  described.cam_from_board = *pose;
  described.residuals_px = BoardResiduals_px(board, view, camera, *pose);
  described.rms_px = RmsOf(described.residuals_px);
  return described;
}

void DescribeViews(const CalibrationBoard& board, const std::vector<BoardView>& all,
                   const ViewList& used, const CalibrationState& state, CalibrationResult* result) {
  double sum_px2 = 0.0, num_corners = 0.0;
  for (const BoardView& view : all) {
    const auto found = std::find(used.begin(), used.end(), &view);
    const Eigen::Isometry3d* pose =
        found == used.end() ? nullptr
                            : &state.cam_from_board[static_cast<size_t>(found - used.begin())];
    result->views.push_back(Describe(board, view, state.camera, pose, kStartLoss_px));
    if (!pose) continue;
    sum_px2 += result->views.back().residuals_px.squaredNorm();
    num_corners += static_cast<double>(view.ids.size());
  }
  result->rms_px = std::sqrt(sum_px2 / std::max(1.0, num_corners));
}

void CheckInput(const CalibrationBoard& board, const std::vector<BoardView>& views,
                const CalibrationOptions& options) {
  if (const std::string flaw = options.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  for (const BoardView& view : views) {
    if (static_cast<Eigen::Index>(view.ids.size()) != view.corners_px.cols())
      throw std::invalid_argument("calibration: a view with more ids than corners, or fewer");
    for (const int id : view.ids)
      if (id < 0 || id >= board.num_corners())
        throw std::invalid_argument(
            fmt::format("calibration: found corner {} of {}", id, board.num_corners()));
  }
}

}  // namespace

std::string CalibrationOptions::Validate() const {
  if (fewest_views < 2)
    return fmt::format("fewest_views: found {}, wanted 2 or more", fewest_views);
  if (!(bad_view_ratio > 1.0))
    return fmt::format("bad_view_ratio: found {:g}, wanted more than 1", bad_view_ratio);
  if (!(least_bad_view_px >= 0.0 && least_turn_rad >= 0.0 && largest_focal_sigma > 0.0 &&
        largest_rms > 0.0))
    return "least_bad_view_px, least_turn_rad, largest_focal_sigma, largest_rms: wanted none below "
           "0";
  return {};
}

int CalibrationResult::num_used() const {
  return static_cast<int>(std::count_if(views.begin(), views.end(),
                                        [](const CalibratedView& view) { return view.is_used; }));
}

std::string CalibrationResult::BriefReport() const {
  switch (status) {
    case CalibrationStatus::kNotRun:
      return "not run";
    case CalibrationStatus::kTooFewViews:
      return "too few views of the board to calibrate from; 10 to 20 with the board at different "
             "places and tilts are good";
    case CalibrationStatus::kViewsParallel:
      return fmt::format(
          "the board is turned the same way in all {} views, so the focal length cannot be told; "
          "tilt it by 30 to 45 degrees to the left, to the right, up and down",
          views.size());
    case CalibrationStatus::kFocalUnknown:
      return fmt::format(
          "the views leave the focal length open ({:.4g} ± {:.2g} px); tilt the board by 30 to 45 "
          "degrees, hold it nearer, and use more views",
          camera.fx_px, sigma[0]);
    case CalibrationStatus::kBoardMisfits:
      return fmt::format(
          "the corners lie {:.1f} px rms off where a board as said would have them: measure its "
          "squares, or its tags and the gaps between them; a board must be flat, and pictures be "
          "whole, not cropped each in its own way",
          rms_px);
    case CalibrationStatus::kFailed:
      return "no camera fits these views: is it the board that was said, and flat?";
    case CalibrationStatus::kDone:
      break;
  }
  return fmt::format(
      "focal length {:.2f} ± {:.2f}, {:.2f} ± {:.2f} px, {:.3f} px rms over {} views", camera.fx_px,
      sigma[0], camera.fy_px, sigma[1], rms_px, num_used());
}

CalibrationResult CalibrateCamera(const CalibrationBoard& board,
                                  const std::vector<BoardView>& views, cv::Size size_px,
                                  const CalibrationOptions& options, const ProgressFn& progress) {
  CheckInput(board, views, options);
  const auto advance = [&](double fraction) {
    if (progress) progress(fraction);
  };
  CalibrationResult result;
  ViewList used;
  for (const BoardView& view : views)
    if (BoardHomography(board, view)) used.push_back(&view);
  result.status = CalibrationStatus::kTooFewViews;
  result.views.resize(views.size());
  if (static_cast<int>(used.size()) < options.fewest_views) return result;

  result.status = CalibrationStatus::kFailed;
  const LensModel lens = options.lens.value_or(LensModel::kK1K2P1P2);
  auto state = Start(board, size_px, lens, &used);
  double& noise_px = result.corner_sigma_px;
  if (!state || !DropBadViews(board, lens, options, &used, &*state, &noise_px)) return result;
  if (static_cast<int>(used.size()) < options.fewest_views) {
    result.status = CalibrationStatus::kTooFewViews;
    return result;
  }
  advance(0.3);
  result.lens =
      options.lens ? *options.lens : SelectLensModel(board, used, LossOf_px(noise_px), *state);
  advance(0.8);
  const RefinementResult refined = RefineToNoise(board, used, result.lens, &*state, &noise_px);
  if (!refined.is_done) return result;
  result.camera = state->camera;
  result.views.clear();
  DescribeViews(board, views, used, *state, &result);
  result.sigma = noise_px * refined.covariance.diagonal().cwiseSqrt();
  result.status = Judge(*state, result.rms_px, refined.has_covariance, result.sigma, options);
  if (result.IsUsable())
    result.view_sigma = JackknifeSigma(board, used, *state, result.lens, LossOf_px(noise_px));
  advance(1.0);
  return result;
}

}  // namespace poselift
