// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/interpolation.h"

#include <fmt/format.h>

#include <cmath>

#include "src/input_error.h"

namespace poselift {
namespace {

// The values of one channel, as the curve goes through them.
struct Knots {
  std::vector<Eigen::Index> frames;
  std::vector<double> values;
  std::vector<double> second;  // x'' at the knots, per frame^2

  double Step(size_t i) const { return static_cast<double>(frames[i + 1] - frames[i]); }
  double Slope(size_t i) const { return (values[i + 1] - values[i]) / Step(i); }
};

// The values of a channel, parted where a gap is too long to fill.
std::vector<Knots> FindKnots(const Eigen::MatrixXd& curves, Eigen::Index channel,
                             int max_gap_frames) {
  std::vector<Knots> pieces;
  for (Eigen::Index t = 0; t < curves.cols(); ++t) {
    if (std::isnan(curves(channel, t))) continue;
    if (pieces.empty() || t - pieces.back().frames.back() - 1 > max_gap_frames)
      pieces.emplace_back();
    pieces.back().frames.push_back(t);
    pieces.back().values.push_back(curves(channel, t));
  }
  for (Knots& knots : pieces) knots.second.assign(knots.frames.size(), 0.0);
  return pieces;
}

// The tridiagonal system of the header, by elimination; its diagonal dominates,
// so nothing need be exchanged.
void BendNaturally(Knots* knots) {
  const size_t last = knots->frames.size() - 1;
  std::vector<double> upper(last + 1, 0.0);
  for (size_t i = 1; i < last; ++i) {
    const double before = knots->Step(i - 1);
    const double after = knots->Step(i);
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    const double right = 6.0 * (knots->Slope(i) - knots->Slope(i - 1));
    upper[i] = after / pivot;
    knots->second[i] = (right - before * knots->second[i - 1]) / pivot;
  }
  for (size_t i = last; i-- > 1;) knots->second[i] -= upper[i] * knots->second[i + 1];
}

// Between knots i and i+1.
double Evaluate(const Knots& knots, size_t i, Eigen::Index frame) {
  const double h = knots.Step(i);
  const double u = static_cast<double>(frame - knots.frames[i]) / h;
  const double w = 1.0 - u;
  const double bend = (w * w * w - w) * knots.second[i] + (u * u * u - u) * knots.second[i + 1];
  return w * knots.values[i] + u * knots.values[i + 1] + h * h / 6.0 * bend;
}

void FillBetween(const Knots& knots, Eigen::MatrixXd::RowXpr curve) {
  for (size_t i = 0; i + 1 < knots.frames.size(); ++i)
    for (Eigen::Index t = knots.frames[i] + 1; t < knots.frames[i + 1]; ++t)
      curve[t] = Evaluate(knots, i, t);
}

void HoldEnds(const Knots& first, const Knots& last, int max_gap_frames,
              Eigen::MatrixXd::RowXpr curve) {
  if (first.frames.front() <= max_gap_frames)
    curve.head(first.frames.front()).setConstant(first.values.front());
  const Eigen::Index behind = curve.size() - last.frames.back() - 1;
  if (behind <= max_gap_frames) curve.tail(behind).setConstant(last.values.back());
}

}  // namespace

FilledCurves FillGaps(const Eigen::MatrixXd& curves, GapFill method, int max_gap_frames) {
  RequireCurves(curves);
  if (max_gap_frames < 0)
    throw InputError(
        fmt::format("FillGaps: max_gap_frames = {}, wanted 0 or more", max_gap_frames));
  FilledCurves result{curves, {}, {}};
  for (Eigen::Index c = 0; c < curves.rows(); ++c) {
    std::vector<Knots> pieces = FindKnots(curves, c, max_gap_frames);
    if (pieces.empty()) {
      result.empty_channels.push_back(static_cast<int>(c));
      continue;
    }
    for (Knots& knots : pieces) {
      if (method == GapFill::kNaturalSpline) BendNaturally(&knots);
      FillBetween(knots, result.curves.row(c));
    }
    HoldEnds(pieces.front(), pieces.back(), max_gap_frames, result.curves.row(c));
  }
  result.filled = curves.array().isNaN() && !result.curves.array().isNaN();
  return result;
}

}  // namespace poselift
