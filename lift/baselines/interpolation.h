// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "lift/baselines/curves.h"

namespace poselift {

// On captured motion the spline is nearer in gaps up to about a third of a
// second; over longer ones, or beside values that jump, it swings out and the
// straight line is nearer.
enum class GapFill { kLinear, kNaturalSpline };

struct FilledCurves {
  Eigen::MatrixXd curves;                                     // C x T
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> filled;  // C x T: was missing, now is not
  std::vector<int> empty_channels;  // ascending; without any value: they stay NaN
};

inline constexpr int kAnyLength = std::numeric_limits<int>::max();

// Fills the gaps of every channel from the frames t_0 < ... < t_n that have a
// value v_i; those keep it bit for bit. Between t_i and t_i+1, with
// h = t_i+1 - t_i, u = (t - t_i) / h and w = 1 - u:
//
//   linear:  x(t) = w v_i + u v_i+1
//   spline:  x(t) = w v_i + u v_i+1 + h^2/6 ((w^3 - w) m_i + (u^3 - u) m_i+1)
//
// where m_i = x''(t_i) makes x' continuous and m_0 = m_n = 0, the natural ends:
//
//   h_i-1 m_i-1 + 2 (h_i-1 + h_i) m_i + h_i m_i+1
//     = 6 ((v_i+1 - v_i) / h_i - (v_i - v_i-1) / h_i-1)
//
// (C. de Boor, A Practical Guide to Splines, 1978, chapter IV). Of all curves
// through the values it has the least integral of x''^2. Frames before the
// first value or after the last hold that value: a cubic would run away there.
//
// A gap of more than max_gap_frames missing frames, at an end or between two
// values, stays as it is, and the spline ends (naturally) on either side of it.
//
// curves: as in curves.h, of any frame rate. Throws InputError when an entry is
// infinite or max_gap_frames is negative.
FilledCurves FillGaps(const Eigen::MatrixXd& curves, GapFill method = GapFill::kNaturalSpline,
                      int max_gap_frames = kAnyLength);

}  // namespace poselift
