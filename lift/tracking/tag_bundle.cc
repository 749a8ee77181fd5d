// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tag_bundle.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/covariance.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/rotation.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "lift/ik/pose_costs.h"

namespace poselift {
namespace {

constexpr double kPull_per_rad = 0.02;
constexpr int kMaxIterations = 50;
// How focal lengths (their logarithm) and k1 of cameras differ.
constexpr double kFocalSigma = 0.3, kRadialSigma = 0.1;
// A mount that was only said to be by a joint may turn freely.
constexpr double kFree_m = 0.2, kFree_rad = 10.0;

ceres::Manifold* Turns() {
  static ceres::EigenQuaternionManifold manifold;
  return &manifold;
}

// [ (t - t_0) / sigma_m; log(R_0^-1 R) / sigma_rad ].
struct MountCost {
  Eigen::Vector3d t0;
  Eigen::Quaterniond R0;
  double per_m, per_rad;

  template <typename T>
  bool operator()(const T* t, const T* r, T* residuals) const {
    const Eigen::Quaternion<T> R(Eigen::Map<const Eigen::Quaternion<T>>{r});
    const Eigen::Quaternion<T> turn = R0.conjugate().cast<T>() * R;
    const T wxyz[] = {turn.w(), turn.x(), turn.y(), turn.z()};
    T w[3];
    ceres::QuaternionToAngleAxis(wxyz, w);
    for (int i = 0; i < 3; ++i) {
      residuals[i] = per_m * (t[i] - t0[i]);
      residuals[3 + i] = per_rad * w[i];
    }
    return true;
  }
};

// (mount x_joint - tip exp(rho)) / sigma_m: the joint at the bone's end, as the tag has it.
struct JointCost {
  Eigen::Vector3d joint_in_tag_m, tip_m;
  int group;
  double per_m;

  template <typename T>
  bool operator()(const T* t, const T* r, const T* ratios, T* residuals) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Quaternion<T> R(Eigen::Map<const Eigen::Quaternion<T>>{r});
    const T length = group < 0 ? T(1.0) : exp(ratios[group]);
    const Vector off =
        R * joint_in_tag_m.cast<T>() + Vector(t[0], t[1], t[2]) - length * tip_m.cast<T>();
    for (int i = 0; i < 3; ++i) residuals[i] = per_m * off[i];
    return true;
  }
};

// whitening (rho - mean).
struct RatiosCost {
  GroupMatrix whitening;

  template <typename T>
  bool operator()(const T* ratios, T* residuals) const {
    Eigen::Map<Eigen::Matrix<T, kNumBoneGroups, 1>> r(residuals);
    r = whitening.cast<T>() * Eigen::Map<const Eigen::Matrix<T, kNumBoneGroups, 1>>(ratios);
    return true;
  }
};

struct LensCost {
  template <typename T>
  bool operator()(const T* lens, T* residuals) const {
    residuals[0] = lens[0] / kFocalSigma;
    residuals[1] = lens[1] / kRadialSigma;
    return true;
  }
};

}  // namespace

Eigen::Isometry3d TagMount::BoneFromTag() const {
  Eigen::Isometry3d bone_from_tag(R);
  bone_from_tag.translation() = t;
  return bone_from_tag;
}

void TagMount::Set(const Eigen::Isometry3d& bone_from_tag) {
  t = bone_from_tag.translation();
  R = Eigen::Quaterniond(bone_from_tag.linear());
  is_known = true;
}

std::string TagFitOptions::Validate() const {
  if (num_frames < 2)
    return fmt::format("TagFitOptions::num_frames = {}, wanted at least 2", num_frames);
  if (rounds < 1) return fmt::format("TagFitOptions::rounds = {}, wanted at least 1", rounds);
  if (!(corner_sigma_px > 0.0 && loss > 0.0 && prior_weight >= 0.0 && depth_sigma >= 0.0 &&
        least_sigma_m > 0.0 && least_sigma_rad > 0.0))
    return "TagFitOptions: sigmas and loss are above 0, prior_weight and depth_sigma are not below";
  return "";
}

TagBundle::TagBundle(const Skeleton& standard, const PosePrior& prior, const Camera& camera,
                     const Eigen::Quaterniond& cam_from_world, const TagFitOptions& options)
    : standard_(standard),
      weighted_{prior.mean_m, options.prior_weight * prior.whitening},
      camera_(camera),
      view_{camera.fx_px, Eigen::Isometry3d(cam_from_world)},
      options_(options) {}

// As TagWhitening, of a tag whose mount is what is looked for.
Eigen::Matrix<double, 8, 8> TagBundle::Whitening(const TagCorners& corners_px,
                                                 double sigma_px) const {
  const Eigen::Map<const Eigen::Matrix<double, 8, 1>> c(corners_px.data());
  return InverseRoot<8>(sigma_px * sigma_px * Eigen::Matrix<double, 8, 8>::Identity() +
                        options_.depth_sigma * options_.depth_sigma * c * c.transpose());
}

void TagBundle::AddFrame(PosedFrame* frame, ceres::Problem* problem) {
  SkeletonPose& pose = frame->pose;
  double* const root = pose.root_in_world_m.data();
  double* const turn = pose.world_from_root.coeffs().data();
  double* const dofs = pose.dofs.data();
  problem->AddParameterBlock(turn, 4, Turns());
  for (const TagSighting& tag : frame->sighted->tags) {
    const auto mount = mounts.find(tag.detection.id);
    if (mount == mounts.end() || !mount->second.is_known) continue;
    TagInPicture picture{.bone = mount->second.bone,
                         .size_m = mount->second.said->size_m,
                         .corners_px = CornersWithoutLens(camera_, tag.detection.corners_px)};
    if (!picture.corners_px.allFinite()) continue;
    picture.whitening =
        Whitening(picture.corners_px, CornerSigma_px(tag.detection, options_.corner_sigma_px));
    problem->AddResidualBlock(MakeTagFitCost(standard_, view_, picture).release(),
                              new ceres::CauchyLoss(options_.loss), root, turn, dofs,
                              mount->second.t.data(), mount->second.R.coeffs().data(),
                              ratios.data(), lens.data());
    ++mount->second.num_frames;
  }
  if (weighted_.mean_m.size() > 0)
    problem->AddResidualBlock(MakePriorCost(standard_, weighted_).release(), nullptr, dofs);
  problem->AddResidualBlock(
      MakeSpringCost({DofLimits(standard_, false), Eigen::VectorXd::Zero(standard_.num_dofs),
                      kPull_per_rad, 0.0})
          .release(),
      nullptr, dofs);
}

void TagBundle::AddMount(TagMount* mount, ceres::Problem* problem) {
  double* const t = mount->t.data();
  double* const R = mount->R.coeffs().data();
  problem->AddParameterBlock(t, 3);
  problem->AddParameterBlock(R, 4, Turns());
  const std::optional<TagOnBone>& on_bone = mount->said->on_bone;
  const MountCost said = on_bone ? MountCost{on_bone->bone_from_tag.translation(),
                                             Eigen::Quaterniond(on_bone->bone_from_tag.linear()),
                                             1.0 / on_bone->sigma_m, 1.0 / on_bone->sigma_rad}
                                 : MountCost{mount->t, mount->R, 1.0 / kFree_m, 1.0 / kFree_rad};
  problem->AddResidualBlock(
      new ceres::AutoDiffCostFunction<MountCost, 6, 3, 4>(new MountCost(said)), nullptr, t, R);
  if (!mount->said->on_joint) return;
  const TagOnJoint& on_joint = *mount->said->on_joint;
  const JointCost joint{on_joint.joint_in_tag_m,
                        standard_.skeleton.bones[static_cast<size_t>(mount->bone)].tip_m,
                        GroupOfJoint(mount->bone), 1.0 / on_joint.sigma_m};
  problem->AddResidualBlock(
      new ceres::AutoDiffCostFunction<JointCost, 3, 3, 4, kNumBoneGroups>(new JointCost(joint)),
      nullptr, t, R, ratios.data());
}

bool TagBundle::Solve(std::vector<PosedFrame>* frames) {
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  problem.AddParameterBlock(ratios.data(), kNumBoneGroups);
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<RatiosCost, kNumBoneGroups, kNumBoneGroups>(
          new RatiosCost{InverseRoot(ProportionPrior().covariance)}),
      nullptr, ratios.data());
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LensCost, 2, 2>(new LensCost), nullptr,
                           lens.data());
  if (!options_.finds_lens) problem.SetParameterBlockConstant(lens.data());
  for (auto& [id, mount] : mounts) {
    mount.num_frames = 0;
    if (mount.is_known) AddMount(&mount, &problem);
  }
  for (PosedFrame& frame : *frames) AddFrame(&frame, &problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMaxIterations;
  options.function_tolerance = 1e-5;
  options.num_threads = 2;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  FindCovariances(&problem);
  return true;
}

Camera TagBundle::FoundCamera() const {
  Camera camera = camera_;
  camera.fx_px *= std::exp(lens[0]);
  camera.fy_px *= std::exp(lens[0]);
  camera.distortion.k1 += lens[1];
  return camera;
}

// Of the lengths, the lens and the mounts. In the tangent of EigenQuaternionManifold d is half a
// turn.
void TagBundle::FindCovariances(ceres::Problem* problem) {
  std::vector<std::pair<const double*, const double*>> blocks = {{ratios.data(), ratios.data()}};
  if (options_.finds_lens) blocks.emplace_back(lens.data(), lens.data());
  for (auto& [id, mount] : mounts) {
    if (!mount.is_known) continue;
    const double* const R = mount.R.coeffs().data();
    blocks.emplace_back(mount.t.data(), mount.t.data());
    blocks.emplace_back(R, R);
  }
  ceres::Covariance::Options options;
  options.num_threads = 2;
  ceres::Covariance covariance(options);
  const bool found = covariance.Compute(blocks, problem);
  if (found) covariance.GetCovarianceBlock(ratios.data(), ratios.data(), ratios_covariance.data());
  if (found && options_.finds_lens)
    covariance.GetCovarianceBlock(lens.data(), lens.data(), lens_covariance.data());
  for (auto& [id, mount] : mounts) {
    if (!mount.is_known) continue;
    Eigen::Matrix3d place = Eigen::Matrix3d::Zero(), turn = Eigen::Matrix3d::Zero();
    const double* const R = mount.R.coeffs().data();
    if (found) {
      covariance.GetCovarianceBlock(mount.t.data(), mount.t.data(), place.data());
      covariance.GetCovarianceBlockInTangentSpace(R, R, turn.data());
    }
    mount.sigma_m = std::max(options_.least_sigma_m, std::sqrt(place.trace() / 3.0));
    mount.sigma_rad = std::max(options_.least_sigma_rad, 2.0 * std::sqrt(turn.trace() / 3.0));
  }
}

double TagBundle::Rms_px(const std::vector<PosedFrame>& frames, int id) const {
  const TagMount& mount = mounts.at(id);
  const Skeleton skeleton = WithProportions(standard_.skeleton, ratios);
  BoneFrames bones;
  double sum = 0.0;
  int count = 0;
  for (const PosedFrame& frame : frames) {
    ForwardKinematics(skeleton, frame.pose, &bones);
    for (const TagSighting& tag : frame.sighted->tags) {
      if (tag.detection.id != id) continue;
      const TagCorners off_px =
          ProjectTag(WithLens(view_, lens),
                     view_.cam_from_world * WorldFromBone(bones, mount.bone) * mount.BoneFromTag(),
                     mount.said->size_m) -
          CornersWithoutLens(camera_, tag.detection.corners_px);
      if (!off_px.allFinite()) continue;
      sum += off_px.squaredNorm() / 4.0;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace poselift
