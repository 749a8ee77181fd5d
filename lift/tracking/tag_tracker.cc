// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tag_tracker.h"

#include <ceres/cost_function.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lift/body_smoothing.h"
#include "lift/ik/pose_problem.h"
#include "lift/ik/rotation_derivative.h"
#include "lift/temporal/pose_prediction.h"
#include "lift/tracking/tag_observation.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kFunctionTolerance = 1e-4;
constexpr double kMuchBetter = 0.7;  // misfit of a pose found anew, to take it
constexpr double kShortestPause_s = 0.3, kLongestPause_s = 5.0;  // between such tries
constexpr double kForget_s = 1.0;                                // a doubt
constexpr double kPull_per_rad = 0.5;  // to rest, in a second: of dofs that nothing shows
constexpr double kLimitStiffness_per_rad = 10.0;  // as that of sequences
constexpr double kOutlier = 7.0;                  // standard deviations of all corners together

// The diagonal of a covariance by root, its small turn and the dofs, as PoseDifference.
FeatureVector FeatureVariances(const Eigen::MatrixXd& covariance, const SkeletonPose& pose) {
  const Eigen::Matrix3d heading_from_world =
      Eigen::AngleAxisd(-Yaw(pose.world_from_root), Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto turned = [&](Eigen::Index first) -> Eigen::Vector3d {
    return (heading_from_world * covariance.block<3, 3>(first, first) *
            heading_from_world.transpose())
        .diagonal();
  };
  const Eigen::Vector3d place = turned(0), turn = turned(3);
  FeatureVector variances;
  variances << covariance.diagonal().tail<kNumAngles>(), place.y(), turn.x(), turn.z(), place.x(),
      place.z(), turn.y();
  return variances;
}

// Of elbows and knees alone, which bend one way. Captured motion leaves the limits of the
// others often, and tags see it.
DofLimits HingeLimits(const Articulation& body) {
  DofLimits limits(body, false);
  const DofLimits all(body, true);
  for (size_t b = 0; b < body.skeleton.bones.size(); ++b) {
    if (body.skeleton.bones[b].dofs.size() != 1) continue;
    const int d = body.dof_starts[b];
    limits.lower[d] = all.lower[d];
    limits.upper[d] = all.upper[d];
  }
  return limits;
}

// The mean over tags of rho(sigmas^2), as the loss has it.
double Misfit(const std::vector<TrackedTag>& tags, double loss) {
  double sum = 0.0;
  for (const TrackedTag& tag : tags)
    sum += loss * loss * std::log1p(tag.sigmas * tag.sigmas / (loss * loss));
  return tags.empty() ? 0.0 : sum / static_cast<double>(tags.size());
}

std::ptrdiff_t NumBelieved(const std::vector<TrackedTag>& tags) {
  return std::count_if(tags.begin(), tags.end(),
                       [](const TrackedTag& tag) { return tag.is_believed; });
}

}  // namespace

std::string TagTrackerOptions::Validate() const {
  if (const std::string error = filter.Validate(); !error.empty()) return error;
  if (!(corner_sigma_px > 0.0))
    return fmt::format("TagTrackerOptions::corner_sigma_px = {}, wanted > 0", corner_sigma_px);
  if (!(depth_sigma >= 0.0))
    return fmt::format("TagTrackerOptions::depth_sigma = {}, wanted >= 0", depth_sigma);
  if (!(prior_weight >= 0.0))
    return fmt::format("TagTrackerOptions::prior_weight = {}, wanted >= 0", prior_weight);
  if (!(loss > 0.0)) return fmt::format("TagTrackerOptions::loss = {}, wanted > 0", loss);
  if (least_tags < 1)
    return fmt::format("TagTrackerOptions::least_tags = {}, wanted at least 1", least_tags);
  return "";
}

TagTracker::TagTracker(const Skeleton& skeleton, const BodyTags& tags, const Camera& camera,
                       const Eigen::Quaterniond& cam_from_world, const PhotoLifter& lifter,
                       std::shared_ptr<const MotionCodebook> codebook,
                       const TagTrackerOptions& options)
    : body_(skeleton),
      worn_(skeleton, tags, camera, cam_from_world),
      lifter_(lifter),
      standard_(lifter.dictionary().skeleton),
      options_(options),
      filter_(codebook, skeleton, options.filter) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
  if (!IsSameBody(standard_.skeleton, codebook->skeleton))
    throw InputError(
        "found a dictionary and a motion model of different skeletons, wanted one skeleton: learn "
        "both from the same motions");
}

void TagTracker::Add(double time_s, const std::vector<TagSighting>& sightings) {
  const std::vector<SeenTag> seen = worn_.Known(sightings);
  const auto prediction = filter_.Next(time_s, !seen.empty());
  const double dt_s = time_s - std::exchange(last_s_, time_s);
  std::optional<Solution> solution;
  if (!seen.empty() && prediction) {
    solution = SolveOn(seen, *prediction, dt_s);
    if (NoteDoubts(time_s, solution ? solution->tags : std::vector<TrackedTag>()))
      TryAnew(time_s, seen, &solution);
  } else if (!seen.empty()) {
    solution = SolveAnew(seen);
  }
  Waiting& waiting = waiting_.emplace_back();
  if (!solution) return;
  filter_.Measure(solution->pose, FeatureVariances(solution->covariance, solution->pose));
  waiting = {std::move(solution->tags), std::move(solution->covariance)};
}

// A tag that was not doubted of late is news: worth a look at once.
bool TagTracker::NoteDoubts(double time_s, const std::vector<TrackedTag>& tags) {
  bool has_doubts = tags.empty();
  for (const TrackedTag& tag : tags) {
    if (tag.is_believed) continue;
    has_doubts = true;
    const auto [doubt, is_first] = doubted_s_.try_emplace(tag.id, time_s);
    if (is_first || time_s - doubt->second > kForget_s) {
      next_try_s_ = time_s;
      pause_s_ = kShortestPause_s / 2.0;
    }
    doubt->second = time_s;
  }
  return has_doubts;
}

// Where a tag speaks against what was foretold, that may have been wrong, or the tag is: less
// and less often.
void TagTracker::TryAnew(double time_s, const std::vector<SeenTag>& seen,
                         std::optional<Solution>* solution) {
  if (time_s < next_try_s_) return;
  auto anew = SolveAnew(seen);
  const bool is_better = anew && (!*solution || anew->misfit < kMuchBetter * (*solution)->misfit);
  pause_s_ = is_better ? kShortestPause_s : std::min(kLongestPause_s, 2.0 * pause_s_);
  next_try_s_ = time_s + pause_s_;
  if (!is_better) return;
  *solution = std::move(anew);
  filter_.StartAnew();
}

std::optional<TrackedFrame> TagTracker::Take() {
  auto frame = filter_.Take();
  if (!frame) return std::nullopt;
  Waiting& waiting = waiting_.front();
  TrackedFrame tracked{std::move(*frame), std::move(waiting.tags), std::move(waiting.covariance)};
  waiting_.pop_front();
  return tracked;
}

std::vector<TagDetection> TagTracker::Expected(double time_s) const {
  const auto pose = filter_.Ahead(time_s);
  if (!pose) return {};
  BoneFrames frames;
  ForwardKinematics(body_.skeleton, *pose, &frames);
  return worn_.Project(frames);
}

// The ends of the bones that wear tags, lifted.
std::vector<SkeletonPose> TagTracker::FirstPoses(const std::vector<SeenTag>& seen) const {
  const auto has_pose = [](const SeenTag& tag) { return !tag.sighting->poses.empty(); };
  if (std::count_if(seen.begin(), seen.end(), has_pose) < options_.least_tags) return {};
  const Observation observation = ObserveTags(seen, body_.skeleton);
  const Eigen::Isometry3d world_from_cam = worn_.view().cam_from_world.inverse();
  std::vector<SkeletonPose> poses;
  for (const LiftedPose& lifted : lifter_.LiftPhoto(observation).poses) {
    SkeletonPose pose = lifted.pose;
    pose.root_in_world_m = world_from_cam * MeanShift_m(observation, lifted.joints_in_cam_m);
    pose.world_from_root = Eigen::Quaterniond(world_from_cam.linear()) * pose.world_from_root;
    poses.push_back(std::move(pose));
  }
  return poses;
}

std::optional<TagTracker::Solution> TagTracker::SolveOn(const std::vector<SeenTag>& seen,
                                                        const MotionFilter::Prediction& prediction,
                                                        double dt_s) const {
  const double share = std::sqrt(std::min(1.0, dt_s));
  auto solution = Solve(seen, prediction.pose, prediction, share, options_.loss);
  if (solution && NumBelieved(solution->tags) == std::ssize(solution->tags)) return solution;
  // A tag that is far off may be wrong, or just too far for its loss: with all believed
  // at first it is found out.
  const auto firm = Solve(seen, prediction.pose, prediction, share, 0.0);
  if (!firm) return solution;
  auto other = Solve(seen, firm->pose, prediction, share, options_.loss);
  return other && (!solution || other->cost < solution->cost) ? other : solution;
}

std::optional<TagTracker::Solution> TagTracker::SolveAnew(const std::vector<SeenTag>& seen) const {
  std::optional<Solution> best;
  for (const SkeletonPose& start : FirstPoses(seen))
    if (auto solution = Solve(seen, start, std::nullopt, 1.0, options_.loss))
      if (!best || solution->cost < best->cost) best = std::move(solution);
  return best;
}

TagInPicture TagTracker::InPicture(const SeenTag& tag, const BoneFrames& frames) const {
  const TagOnBone& mount = *tag.worn->tag.on_bone;
  const Eigen::Isometry3d cam_from_tag =
      worn_.CamFromBone(frames, tag.worn->bone) * mount.bone_from_tag;
  const double size_m = tag.worn->tag.size_m;
  return {tag.worn->bone, mount.bone_from_tag, size_m, tag.corners_px,
          TagWhitening(worn_.view(), cam_from_tag, size_m,
                       {CornerSigma_px(tag.sighting->detection, options_.corner_sigma_px),
                        mount.sigma_m, mount.sigma_rad, options_.depth_sigma})};
}

// The joint as the tag has it; of the two ways it may lean, the one that is nearer.
PointInSpace TagTracker::InSpace(const SeenTag& tag, const BoneFrames& frames) const {
  const TagOnJoint& mount = *tag.worn->tag.on_joint;
  const Bone& bone = body_.skeleton.bones[static_cast<size_t>(tag.worn->joint)];
  const Eigen::Vector3d expected_m = worn_.CamFromBone(frames, tag.worn->joint) * bone.tip_m;
  const auto off = [&](const TagPose& pose) {
    return (pose.cam_from_tag * mount.joint_in_tag_m - expected_m).norm();
  };
  const TagPose& pose =
      *std::min_element(tag.sighting->poses.begin(), tag.sighting->poses.end(),
                        [&](const TagPose& a, const TagPose& b) { return off(a) < off(b); });
  Eigen::Matrix<double, 3, 6> by_pose;  // by a turn and a shift in cam
  by_pose << -Cross(pose.cam_from_tag.linear() * mount.joint_in_tag_m), Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d in_cam = by_pose * pose.covariance * by_pose.transpose() +
                                 mount.sigma_m * mount.sigma_m * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d world_from_cam = worn_.view().cam_from_world.linear().transpose();
  return {tag.worn->joint, bone.tip_m,
          worn_.view().cam_from_world.inverse() * (pose.cam_from_tag * mount.joint_in_tag_m),
          InverseRoot(in_cam) * world_from_cam.transpose()};
}

// How far the tags are from where the pose has them.
std::vector<TrackedTag> TagTracker::Judge(const std::vector<SeenTag>& seen,
                                          const SkeletonPose& pose) const {
  BoneFrames frames;
  ForwardKinematics(body_.skeleton, pose, &frames);
  std::vector<TrackedTag> tags;
  for (const SeenTag& tag : seen) {
    TrackedTag tracked{.id = tag.worn->tag.id, .is_ambiguous = tag.sighting->is_ambiguous};
    if (tag.worn->bone >= 0) {
      const TagInPicture picture = InPicture(tag, frames);
      const TagCorners off_px =
          ProjectTag(worn_.view(), worn_.CamFromBone(frames, picture.bone) * picture.bone_from_tag,
                     picture.size_m) -
          picture.corners_px;
      tracked.error_px = off_px.norm() / 2.0;
      tracked.sigmas =
          (picture.whitening * Eigen::Map<const Eigen::Matrix<double, 8, 1>>(off_px.data())).norm();
    } else if (!tag.sighting->poses.empty()) {
      const PointInSpace point = InSpace(tag, frames);
      const Eigen::Vector3d x_in_cam_m = worn_.CamFromBone(frames, point.bone) * point.x_in_bone_m;
      const Eigen::Vector3d seen_in_cam_m = worn_.view().cam_from_world * point.x_in_world_m;
      tracked.error_px =
          worn_.view().focal_px * (x_in_cam_m.hnormalized() - seen_in_cam_m.hnormalized()).norm();
      tracked.sigmas = (point.whitening *
                        (worn_.view().cam_from_world.inverse() * x_in_cam_m - point.x_in_world_m))
                           .norm();
    }
    tracked.is_believed = tracked.sigmas < kOutlier;
    tags.push_back(tracked);
  }
  return tags;
}

// Tags and what was foretold.
void TagTracker::AddTerms(const std::vector<SeenTag>& seen, const SkeletonPose& start,
                          const std::optional<MotionFilter::Prediction>& prediction, double loss,
                          PoseProblem* problem) const {
  BoneFrames frames;
  ForwardKinematics(body_.skeleton, start, &frames);
  for (const SeenTag& tag : seen) {
    if (tag.worn->bone >= 0)
      problem->AddPoseTerm(MakeTagCost(body_, worn_.view(), InPicture(tag, frames)), loss);
    else if (!tag.sighting->poses.empty())
      problem->AddPoseTerm(MakePointCost(body_, InSpace(tag, frames)), loss);
  }
  if (!prediction) return;
  const FeatureVector whitening = prediction->variances.cwiseSqrt().cwiseInverse();
  problem->AddPoseTerm(MakePredictionCost({prediction->pose, whitening.asDiagonal()}, 1.0));
}

std::optional<TagTracker::Solution> TagTracker::Solve(
    const std::vector<SeenTag>& seen, const SkeletonPose& start,
    const std::optional<MotionFilter::Prediction>& prediction, double share, double loss) const {
  const DofLimits limits = HingeLimits(body_);
  DofSprings springs{limits, limits.Clamp(Eigen::VectorXd::Zero(body_.num_dofs)),
                     share * kPull_per_rad, kLimitStiffness_per_rad};
  PoseProblem problem(body_, start, springs);
  AddTerms(seen, start, prediction, loss, &problem);
  const PosePrior& prior = lifter_.dictionary().prior;
  const double prior_weight = share * options_.prior_weight;
  const PosePrior weighted{prior.mean_m, prior_weight * prior.whitening};
  if (!prior.Empty() && prior_weight > 0.0) problem.AddDofsTerm(MakePriorCost(standard_, weighted));
  if (!IsUsable(problem.Solve(kMaxIterations, kFunctionTolerance).status)) return std::nullopt;
  const SkeletonPose& pose = problem.pose();
  Eigen::MatrixXd covariance;
  if (prediction) {
    // How common a pose is, said again in each frame, is no measurement: of a limb that
    // nothing shows the filter would be surer and surer.
    springs.pull = 0.0;
    PoseProblem measured(body_, pose, springs);
    AddTerms(seen, pose, prediction, loss, &measured);
    covariance = measured.Covariance();
  } else {
    covariance = problem.Covariance();
  }
  if (covariance.size() == 0) return std::nullopt;
  Solution solution{pose, std::move(covariance), problem.Cost()};
  solution.tags = Judge(seen, pose);
  solution.misfit = Misfit(solution.tags, options_.loss);
  return solution;
}

}  // namespace poselift
