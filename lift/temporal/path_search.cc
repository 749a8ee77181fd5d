// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/path_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kStride = 2;  // frames of the database
constexpr int kLags[] = {0, 2, 6, 12, 18, 24, 30};
// So few frames of all points stay in the cache.
constexpr Eigen::Index kBlock = 1024;
constexpr int kNewtonSteps = 5;
constexpr double kLongestStep_rad = 0.5;
// Speeds tell less of a pose than angles do.
constexpr double kVelocityShare = 0.3;

double WithoutTurns(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

Eigen::Vector2d Level(const Eigen::Vector3d& x) { return {x.x(), x.z()}; }

// The least of -2 length cos(x) + stiffness (x - wanted)^2 near the wanted x.
double TurnBetween(double length, double stiffness, double wanted) {
  double x = stiffness > 0.0 ? wanted * stiffness / (length + stiffness) : 0.0;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double slope = length * std::sin(x) + stiffness * (x - wanted);
    const double curvature = std::max(length * std::cos(x) + stiffness, 1e-9);
    x -= std::clamp(slope / curvature, -kLongestStep_rad, kLongestStep_rad);
  }
  return x;
}

}  // namespace

std::string PathSearchOptions::Validate() const {
  const auto wrong = [](const char* name, double value, const char* wanted) {
    return fmt::format("PathSearchOptions::{} = {}, wanted {}", name, value, wanted);
  };
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (num_nearest < 1) return wrong("num_nearest", num_nearest, "at least 1");
  if (exclusion_frames < 0) return wrong("exclusion_frames", exclusion_frames, "at least 0");
  if (num_candidates < num_nearest)
    return wrong("num_candidates", num_candidates, "at least num_nearest");
  if (!positive(decay_frames)) return wrong("decay_frames", decay_frames, "more than 0");
  if (!positive(path_sigma_m)) return wrong("path_sigma_m", path_sigma_m, "more than 0");
  if (!positive(heading_sigma_rad))
    return wrong("heading_sigma_rad", heading_sigma_rad, "more than 0");
  if (!(pose_weight >= 0.0 && std::isfinite(pose_weight)))
    return wrong("pose_weight", pose_weight, "at least 0");
  return "";
}

PathSearch::PathSearch(const MotionDatabase& database, const PathSearchOptions& options)
    : database_(database), options_(options), row_weights_(RowWeights(database)) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
  row_weights_.tail<3>() *= kVelocityShare;
  const Articulation body(database.skeleton);
  joints_.resize(Eigen::NoChange, (database.NumFrames() + kStride - 1) / kStride);
  roots_.reserve(static_cast<size_t>(database.NumFrames()));
  BoneFrames frames;
  for (const Trial& trial : database.trials) {
    SkeletonPose pose = SkeletonPose::Rest(database.skeleton);
    pose.root_in_world_m.setZero();
    for (int f = trial.first_frame; f < trial.first_frame + trial.num_frames; ++f) {
      pose = PoseFromFeatures(database.features.col(f).cast<double>(), pose, database.frame_time_s);
      roots_.push_back({pose.root_in_world_m, pose.world_from_root, {}});
      if (f % kStride != 0) continue;
      ForwardKinematics(body.skeleton, pose, &frames);
      joints_.col(f / kStride) = JointPositions(body.sites, frames).reshaped().cast<float>();
    }
  }
}

PointPaths PathSearch::Paths(const std::vector<std::vector<Landmark::Part>>& points) const {
  PointPaths paths;
  const Eigen::Index count = joints_.cols();
  paths.sum_x_ = paths.sum_z_ = paths.squares_ = Eigen::ArrayXf::Zero(count);
  for (const auto& parts : points) {
    Eigen::Matrix3Xf point_m = Eigen::Matrix3Xf::Zero(3, count);
    for (const Landmark::Part& part : parts)
      point_m += static_cast<float>(part.weight) * joints_.middleRows<3>(3 * part.joint);
    paths.x_.push_back(point_m.row(0));
    paths.y_.push_back(point_m.row(1));
    paths.z_.push_back(point_m.row(2));
    paths.sum_x_ += paths.x_.back();
    paths.sum_z_ += paths.z_.back();
    paths.squares_ += point_m.colwise().squaredNorm().transpose().array();
  }
  for (auto* array : {&paths.dot_, &paths.cross_, &paths.heights_, &paths.mean_x_, &paths.mean_z_,
                      &paths.square_, &paths.energy_})
    array->resize(count);
  return paths;
}

PathSearch::Moments PathSearch::MomentsOf(const PathQuery& query, size_t num_points) const {
  Moments moments;
  if (num_points == 0) return moments;
  const auto& points_m = query.points_in_world_m;
  double sum = 0.0;
  for (const int lag : kLags) {
    if (static_cast<size_t>(lag) >= points_m.size()) break;
    moments.lags.emplace_back(lag, std::exp(-lag / options_.decay_frames));
    sum += moments.lags.back().second * static_cast<double>(num_points);
  }
  moments.origin_m = points_m.back().col(0);
  moments.origin_m.y() = 0.0;
  for (auto& [lag, weight] : moments.lags) {
    weight /= static_cast<float>(sum);
    const Eigen::Matrix3Xd now_m =
        points_m[points_m.size() - 1 - static_cast<size_t>(lag)].colwise() - moments.origin_m;
    moments.mean_m += weight * Level(now_m.rowwise().sum());
    moments.square_m2 += weight * now_m.squaredNorm();
  }
  moments.square_m2 -= moments.mean_m.squaredNorm();
  return moments;
}

// All the sums over points and lags that the alignment takes, of all frames.
void PathSearch::Correlate(const PathQuery& query, const Moments& moments,
                           PointPaths* paths) const {
  PointPaths& p = *paths;
  for (auto* sums : {&p.dot_, &p.cross_, &p.heights_, &p.mean_x_, &p.mean_z_, &p.square_})
    sums->setZero();
  const Eigen::Index count = joints_.cols();
  for (Eigen::Index block = 0; block < count; block += kBlock)
    for (const auto& [lag, weight] : moments.lags) {
      const Eigen::Index back = lag / kStride;
      const Eigen::Index first = std::max(block, back);
      const Eigen::Index size = std::min(block + kBlock, count) - first;
      if (size <= 0) continue;
      const auto now = [&](Eigen::ArrayXf& array) { return array.segment(first, size); };
      const auto then = [&](const Eigen::ArrayXf& array) {
        return array.segment(first - back, size);
      };
      now(p.mean_x_) += weight * then(p.sum_x_);
      now(p.mean_z_) += weight * then(p.sum_z_);
      now(p.square_) += weight * then(p.squares_);
      const auto& points_m =
          query.points_in_world_m[query.points_in_world_m.size() - 1 - static_cast<size_t>(lag)];
      for (size_t i = 0; i < p.x_.size(); ++i) {
        const Eigen::Vector3f u =
            weight * (points_m.col(static_cast<Eigen::Index>(i)) - moments.origin_m).cast<float>();
        now(p.dot_) += u.x() * then(p.x_[i]) + u.z() * then(p.z_[i]);
        now(p.cross_) += u.z() * then(p.x_[i]) - u.x() * then(p.z_[i]);
        now(p.heights_) += u.y() * then(p.y_[i]);
      }
    }
  // Centred; and the energy of the best alignment but for the query's own part.
  const float mean_x = static_cast<float>(moments.mean_m.x());
  const float mean_z = static_cast<float>(moments.mean_m.y());
  p.dot_ -= mean_x * p.mean_x_ + mean_z * p.mean_z_;
  p.cross_ -= mean_z * p.mean_x_ - mean_x * p.mean_z_;
  p.square_ -= p.mean_x_.square() + p.mean_z_.square() + 2.0f * p.heights_;
  p.energy_ = p.square_ - 2.0f * (p.dot_.square() + p.cross_.square()).sqrt();
}

void PathSearch::TakeCandidates(int longest_lag, PointPaths* paths) const {
  auto& order = paths->order_;
  order.clear();
  for (const Trial& trial : database_.trials) {
    const int first = trial.first_frame + std::max(longest_lag, 1);
    const int end = trial.first_frame + trial.num_frames;
    for (int place = (first + kStride - 1) / kStride; place * kStride < end; ++place)
      order.emplace_back(paths->energy_[place], place);
  }
  const auto wanted = static_cast<size_t>(options_.num_candidates);
  if (paths->num_points() == 0 || order.size() <= wanted) return;
  std::nth_element(order.begin(), order.begin() + options_.num_candidates, order.end());
  order.resize(wanted);
}

PathMatch PathSearch::Align(const PathQuery& query, const Moments& moments, const PointPaths& paths,
                            Eigen::Index place) const {
  const auto frame = static_cast<size_t>(place) * kStride;
  const SkeletonPose& before = roots_[frame - 1];
  const SkeletonPose& root = roots_[frame];
  const double sigma_2 = std::pow(options_.path_sigma_m, 2);
  const double stiffness = sigma_2 / std::pow(options_.heading_sigma_rad, 2);
  // Positive angles turn z to x, as yaw does.
  const double length = std::hypot(paths.dot_[place], paths.cross_[place]);
  const double by_path_rad = -std::atan2(paths.cross_[place], paths.dot_[place]);
  const double wanted_rad =
      WithoutTurns(Yaw(query.pose.world_from_root) - Yaw(before.world_from_root) - by_path_rad);
  const double rest_rad =
      paths.num_points() > 0 ? TurnBetween(length, stiffness, wanted_rad) : wanted_rad;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(by_path_rad + rest_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  PathMatch match;
  match.frame = static_cast<int>(frame);
  match.yaw_rad = Yaw(root.world_from_root) + by_path_rad + rest_rad;
  const FeatureVector change = row_weights_.cwiseProduct(
      database_.features.col(match.frame - 1).cast<double>() - query.features);
  match.energy = options_.pose_weight * change.squaredNorm();
  Eigen::Vector3d from_m = before.root_in_world_m, to_m = query.pose.root_in_world_m;
  if (paths.num_points() > 0) {
    from_m << paths.mean_x_[place], 0.0, paths.mean_z_[place];
    to_m = moments.origin_m + Eigen::Vector3d(moments.mean_m.x(), 0.0, moments.mean_m.y());
    const double squares_m2 =
        moments.square_m2 + paths.square_[place] - 2.0 * length * std::cos(rest_rad);
    match.energy +=
        (std::max(0.0, squares_m2) + stiffness * std::pow(rest_rad - wanted_rad, 2)) / sigma_2;
  }
  match.root_in_world_m = to_m + turn * (root.root_in_world_m - from_m);
  match.root_in_world_m.y() = root.root_in_world_m.y();
  return match;
}

void PathSearch::FindNearest(const PathQuery& query, PointPaths* paths,
                             std::vector<PathMatch>* matches) const {
  const auto num_points = static_cast<Eigen::Index>(paths->num_points());
  if (num_points > 0 && query.points_in_world_m.empty())
    throw std::invalid_argument("path search: a query without points");
  for (const auto& points_m : query.points_in_world_m)
    if (points_m.cols() != num_points)
      throw std::invalid_argument(
          fmt::format("path search: {} points, wanted {}", points_m.cols(), num_points));
  matches->clear();
  const Moments moments = MomentsOf(query, paths->num_points());
  Correlate(query, moments, paths);
  TakeCandidates(moments.lags.empty() ? 0 : moments.lags.back().first, paths);
  auto& candidates = paths->candidates_;
  candidates.clear();
  for (const auto& [energy, place] : paths->order_)
    candidates.push_back(Align(query, moments, *paths, place));
  std::sort(candidates.begin(), candidates.end(), [](const PathMatch& a, const PathMatch& b) {
    return std::tie(a.energy, a.frame) < std::tie(b.energy, b.frame);
  });
  // Trials lie side by side; at their borders a neighbour too many is left out.
  const auto near = [&](const PathMatch& a, const PathMatch& b) {
    return std::abs(a.frame - b.frame) <= options_.exclusion_frames;
  };
  for (const PathMatch& candidate : candidates) {
    if (matches->size() == static_cast<size_t>(options_.num_nearest)) return;
    if (std::none_of(matches->begin(), matches->end(),
                     [&](const PathMatch& match) { return near(match, candidate); }))
      matches->push_back(candidate);
  }
}

}  // namespace poselift
