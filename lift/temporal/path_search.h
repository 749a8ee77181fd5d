// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "lift/ik/articulation.h"
#include "lift/temporal/motion_database.h"
#include "src/layout.h"
#include "src/skeleton.h"

namespace poselift {

// The frames k of a database at which points of the body came along a path like
// the observed one, wherever it lies on the floor and whichever way it heads:
//
//   E_k = min over psi, t of
//           sum_l w_l / n sum_i |u_i(-l) - (R_psi v_i(k - l) + t)|^2 / path_sigma^2
//         + (heading_k-1 + psi - heading)^2 / heading_sigma^2
//         + pose_weight |W o (features_k-1 - features)|^2
//
// u: the n points now and l frames ago, l = 0, 2, 6, 12 ... 30, as far back as
// they are known; v: those of the database. R_psi turns about the vertical, t is
// level. w_l falls off with l and has sum 1. heading and features are those of
// the last pose, W the row weights (RowWeights). Without the second term psi and
// t have a closed form, a 2D Procrustes alignment; with it psi takes a few Newton
// steps. Every second frame is looked at.
struct PathSearchOptions {
  int num_nearest = 100;
  // Frames of one trial within so many of each other: only the nearest.
  int exclusion_frames = 15;
  // Of so many paths, nearest without regard to heading and pose, are those taken.
  int num_candidates = 3000;
  double decay_frames = 20.0;  // w_l ~ exp(-l / decay_frames)
  double path_sigma_m = 0.05;
  double heading_sigma_rad = 0.3;
  double pose_weight = 0.3;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// A frame of the database and where its root is with the paths aligned.
struct PathMatch {
  int frame = 0;        // frame - 1 is of the same trial
  double energy = 0.0;  // E_k
  Eigen::Vector3d root_in_world_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
};

// What of the past is known: the points' places, the oldest first, the last of
// them now, each 3 x n; and the last pose.
struct PathQuery {
  std::vector<Eigen::Matrix3Xd> points_in_world_m;
  FeatureVector features = FeatureVector::Zero();
  SkeletonPose pose;
};

// The places of some points of the body all over a database, and storage: one a
// sequence and thread. About 6 n megabytes for half an hour of motion.
class PointPaths {
 public:
  size_t num_points() const { return x_.size(); }

 private:
  friend class PathSearch;
  std::vector<Eigen::ArrayXf> x_, y_, z_;              // a point each
  Eigen::ArrayXf sum_x_, sum_z_, squares_;             // over the points
  Eigen::ArrayXf dot_, cross_, heights_;               // with the query's
  Eigen::ArrayXf mean_x_, mean_z_, square_, energy_;   // over points and lags
  std::vector<std::pair<float, Eigen::Index>> order_;  // energy, place
  std::vector<PathMatch> candidates_;
};

class PathSearch {
 public:
  // The database must outlive it. Throws InputError for wrong options.
  explicit PathSearch(const MotionDatabase& database, const PathSearchOptions& options = {});

  PointPaths Paths(const std::vector<std::vector<Landmark::Part>>& points) const;

  // *matches: nearest first; at equal energy the earlier one. Without points the
  // last pose alone counts. Throws std::invalid_argument for sizes that do not fit.
  void FindNearest(const PathQuery& query, PointPaths* paths,
                   std::vector<PathMatch>* matches) const;

 private:
  // Of the query, its weighted means taken from a point of its own.
  struct Moments {
    std::vector<std::pair<int, float>> lags;  // frames; weight a point
    Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
    Eigen::Vector2d mean_m = Eigen::Vector2d::Zero();
    double square_m2 = 0.0;  // about the mean, heights about the floor
  };
  Moments MomentsOf(const PathQuery& query, size_t num_points) const;
  void Correlate(const PathQuery& query, const Moments& moments, PointPaths* paths) const;
  void TakeCandidates(int longest_lag, PointPaths* paths) const;
  PathMatch Align(const PathQuery& query, const Moments& moments, const PointPaths& paths,
                  Eigen::Index place) const;

  const MotionDatabase& database_;
  PathSearchOptions options_;
  FeatureVector row_weights_;
  // Every second frame, in a world of its trial's.
  Eigen::Matrix<float, 3 * kNumJoints, Eigen::Dynamic> joints_;
  std::vector<SkeletonPose> roots_;  // of all frames, without dofs
};

}  // namespace poselift
