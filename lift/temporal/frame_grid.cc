// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/frame_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kMostFrames = 1e7;
constexpr double kEvenToFrames = 0.05;

std::vector<double> Steps(std::span<const double> times_s) {
  if (times_s.size() < 2)
    throw InputError(fmt::format("found {} frame with a time, wanted two or more to know the rate",
                                 times_s.size()));
  std::vector<double> steps_s;
  for (size_t i = 1; i < times_s.size(); ++i) {
    steps_s.push_back(times_s[i] - times_s[i - 1]);
    if (!(steps_s.back() > 0.0))
      throw InputError(
          fmt::format("found the time {} s after {} s (frames {} and {}), wanted times that grow",
                      times_s[i], times_s[i - 1], i - 1, i));
  }
  return steps_s;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The line t = first + n dt through the places, by least squares.
void FitLine(std::span<const double> times_s, FrameGrid* grid) {
  const auto count = static_cast<double>(times_s.size());
  double mean_n = 0.0, mean_s = 0.0;
  for (size_t i = 0; i < times_s.size(); ++i) {
    mean_n += grid->places[i] / count;
    mean_s += times_s[i] / count;
  }
  double over = 0.0, under = 0.0;
  for (size_t i = 0; i < times_s.size(); ++i) {
    over += (grid->places[i] - mean_n) * (times_s[i] - mean_s);
    under += (grid->places[i] - mean_n) * (grid->places[i] - mean_n);
  }
  grid->frame_time_s = over / under;
  grid->first_s = mean_s - mean_n * grid->frame_time_s;
}

bool FitsEvenly(std::span<const double> times_s, const FrameGrid& grid) {
  for (size_t i = 0; i < times_s.size(); ++i) {
    const double place = (times_s[i] - grid.first_s) / grid.frame_time_s;
    if (!(std::abs(place - grid.places[i]) <= kEvenToFrames)) return false;
    if (i > 0 && grid.places[i] == grid.places[i - 1]) return false;
  }
  return true;
}

}  // namespace

FrameGrid FitFrameGrid(std::span<const double> times_s) {
  const std::vector<double> steps_s = Steps(times_s);
  const double median_s = Median(steps_s);
  if (!((times_s.back() - times_s.front()) / median_s < kMostFrames))
    throw InputError(fmt::format("found times of {} s in steps of {} s, wanted at most {} frames",
                                 times_s.back() - times_s.front(), median_s, kMostFrames));
  FrameGrid grid;
  grid.places = {0};
  for (const double step_s : steps_s)
    grid.places.push_back(grid.places.back() + static_cast<int>(std::lround(step_s / median_s)));
  if (grid.places.back() > 0) FitLine(times_s, &grid);
  grid.is_even = grid.frame_time_s > 0.0 && FitsEvenly(times_s, grid);
  if (!grid.is_even) grid = {times_s.front(), median_s, false, {}};
  return grid;
}

}  // namespace poselift
