// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/fit_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "lift/body_proportions.h"
#include "lift/normalize.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr double kSmallest = 0.50, kLargest = 1.23;  // of an adult: a child of three, a giant
constexpr double kMostOff = 1.33, kForearmMostOff = 1.67, kMostUneven = 1.15;
constexpr const char* kOtherPlace =
    "Is a left tag on the right or the other way round, or a tag on another bone than the tags "
    "file says?";

double Median(const GroupVector& values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2];
}

bool IsBeyond(double log_ratio, double most) { return std::abs(log_ratio) > std::log(most); }

// "left_knee" for "right_knee"; nothing for what is in the middle.
std::optional<int> OfOtherSide(int joint) {
  constexpr std::string_view kRight = "right_";
  const std::string_view name = Joints()[static_cast<size_t>(joint)].name;
  if (!name.starts_with(kRight)) return std::nullopt;
  return FindJoint("left_" + std::string(name.substr(kRight.size())));
}

}  // namespace

std::string ImplausibleBody(const Skeleton& standard, const Skeleton& person) {
  const Eigen::VectorXd lengths_m = BoneLengths(person), standard_m = BoneLengths(standard);
  const GroupVector ratios = LogRatios(lengths_m, standard_m);
  const double size = Median(ratios);
  if (size < std::log(kSmallest) || size > std::log(kLargest))
    return fmt::format(
        "the bones come out {:.2f} times as long as an adult's. Is the tags' size right? It is the "
        "edge of the square between the black and the white border; about {:.2f} of what the tags "
        "file says would fit.",
        std::exp(size), std::exp(-size));
  std::string found;
  const auto add = [&](const std::string& what) { found += (found.empty() ? "" : ", ") + what; };
  for (int g = 0; g < kNumBoneGroups; ++g) {
    const std::string_view name = BoneGroupNames()[static_cast<size_t>(g)];
    if (IsBeyond(ratios[g] - size, name == "forearm" ? kForearmMostOff : kMostOff))
      add(fmt::format("{} {:+.0f} %", name, 100.0 * std::expm1(ratios[g])));
  }
  for (int j = 1; j < kNumJoints; ++j) {
    const auto other = OfOtherSide(j);
    if (other && IsBeyond(std::log(lengths_m[*other] / lengths_m[j]), kMostUneven))
      add(fmt::format("{} {:.0f} mm and {} {:.0f} mm", Joints()[static_cast<size_t>(*other)].name,
                      1e3 * lengths_m[*other], Joints()[static_cast<size_t>(j)].name,
                      1e3 * lengths_m[j]));
  }
  if (found.empty()) return "";
  return fmt::format("no human has these bones: {} against the standard skeleton. {}", found,
                     kOtherPlace);
}

std::string ImplausibleFit(const Skeleton& standard, const TagFit& fit) {
  std::string flaw = ImplausibleBody(standard, fit.skeleton);
  if (!flaw.empty()) return flaw;
  for (const TagFitRow& row : fit.rows)
    if (row.rms_px > kWorstFit_px || row.moved_mm > kFarthestMoved_mm ||
        row.leaned_deg > kFarthestLeaned_deg)
      flaw +=
          fmt::format("{}{} ({:.0f} mm and {:.0f} degrees off, {:.1f} px)",
                      flaw.empty() ? "" : ", ", row.id, row.moved_mm, row.leaned_deg, row.rms_px);
  if (flaw.empty()) return "";
  return fmt::format("tags sit far from where the tags file has them, or move unlike it: {}. {}",
                     flaw, kOtherPlace);
}

}  // namespace poselift
