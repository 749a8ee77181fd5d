// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "lift/body_proportions.h"
#include "lift/pose_prior.h"
#include "lift/tracking/tag_cost.h"
#include "src/body_tags.h"
#include "src/camera.h"
#include "src/tag_detection.h"

namespace ceres {
class Problem;
}

namespace poselift {

struct TagFitOptions {
  int num_frames = 100;  // that are adjusted together, as different as can be
  int rounds = 2;        // of tracking and adjusting
  double corner_sigma_px = 0.15;
  double depth_sigma = 0.0;   // TagSigmas: of a camera that is guessed
  double loss = 6.0;          // Cauchy, as in TagTrackerOptions
  double prior_weight = 0.1;  // of the pose prior
  // Of a camera that nobody calibrated the focal length and k1 are found as well.
  bool finds_lens = false;
  // What a mount is never known better than: skin moves on bones.
  double least_sigma_m = 0.003;
  double least_sigma_rad = 0.02;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// A frame of the movement, and a pose of the body in it: world y up, the camera at the origin.
struct SightedFrame {
  double time_s = 0.0;
  std::vector<TagSighting> tags;
};
struct PosedFrame {
  const SightedFrame* sighted = nullptr;
  SkeletonPose pose;
};

// Where a tag sits.
struct TagMount {
  const BodyTag* said = nullptr;
  int bone = -1;
  Eigen::Vector3d t = Eigen::Vector3d::Zero();  // bone_from_tag
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  bool is_known = false;  // at least about
  int num_frames = 0;     // it was adjusted in
  double sigma_m = 0.0, sigma_rad = 0.0;

  Eigen::Isometry3d BoneFromTag() const;
  void Set(const Eigen::Isometry3d& bone_from_tag);
};

// Where tags sit on a body, and how long its bones are, from frames that show them
// (bundle adjustment). Of frames t and tags k, over poses q_t, mounts bone_from_tag_k and
// log ratios rho of the bones' lengths (body_proportions.h), and a lens l if it is asked for:
//
//   min sum_tk  rho(|corners_k(q_t, mount_k, rho, l) - corners_tk|^2 / sigma_px^2)
//     + sum_t   |prior_weight whitening (f_0(q_t) - mean)|^2     the pose prior
//     + sum_k   how far each mount is from where it was said to be
//     + |rho - mean|^2_covariance                                how people differ
//     + |l|^2_covariance                                         how cameras differ
//
// A joint that bends between two tags is found where both say it is; what no movement
// shows (the direction of a forearm whose hand has no tag) stays as it was said to be.
class TagBundle {
 public:
  // standard: the skeleton that poses were learned on, whose bones end at the 23 joints.
  TagBundle(const Skeleton& standard, const PosePrior& prior, const Camera& camera,
            const Eigen::Quaterniond& cam_from_world, const TagFitOptions& options);

  GroupVector ratios = GroupVector::Zero();
  GroupMatrix ratios_covariance = GroupMatrix::Zero();
  LensVector lens = LensVector::Zero();
  Eigen::Matrix2d lens_covariance = Eigen::Matrix2d::Zero();
  std::map<int, TagMount> mounts;  // by the tags' ids; those that are not known are left out

  // False when the solver breaks down.
  bool Solve(std::vector<PosedFrame>* frames);
  Camera FoundCamera() const;
  // Of a tag's corners, over the frames that show it.
  double Rms_px(const std::vector<PosedFrame>& frames, int id) const;

 private:
  Eigen::Matrix<double, 8, 8> Whitening(const TagCorners& corners_px, double sigma_px) const;
  void AddFrame(PosedFrame* frame, ceres::Problem* problem);
  void AddMount(TagMount* mount, ceres::Problem* problem);
  void FindCovariances(ceres::Problem* problem);

  Articulation standard_;
  PosePrior weighted_;
  Camera camera_;
  TagView view_;
  TagFitOptions options_;
};

}  // namespace poselift
