// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/tracking/tag_fit.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kLatency_s = 0.3;
constexpr int kLeastFrames = 10;

// The farthest from all that were chosen, again and again.
std::vector<PosedFrame> MostDifferent(std::vector<PosedFrame> frames, int count) {
  if (std::ssize(frames) <= count) return frames;
  std::vector<double> distance(frames.size(), std::numeric_limits<double>::infinity());
  std::vector<size_t> chosen = {frames.size() / 2};
  while (std::ssize(chosen) < count) {
    for (size_t f = 0; f < frames.size(); ++f)
      distance[f] = std::min(distance[f],
                             (frames[f].pose.dofs - frames[chosen.back()].pose.dofs).squaredNorm());
    chosen.push_back(
        static_cast<size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin()));
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<PosedFrame> different;
  for (const size_t f : chosen) different.push_back(std::move(frames[f]));
  return different;
}

// The frames of which a pose is known.
std::vector<PosedFrame> Track(const std::vector<SightedFrame>& frames, TagTracker* tracker,
                              const ProgressFn& progress) {
  std::vector<PosedFrame> posed;
  size_t next = 0;
  const auto take = [&] {
    while (const auto tracked = tracker->Take()) {
      const SightedFrame& sighted = frames[next++];
      if (tracked->body.kind == SmoothedFrame::Kind::kMeasured)
        posed.push_back({&sighted, tracked->body.pose});
      if (progress) progress(static_cast<double>(next) / static_cast<double>(frames.size()));
    }
  };
  for (const SightedFrame& frame : frames) {
    tracker->Add(frame.time_s, frame.tags);
    take();
  }
  tracker->End();
  take();
  return posed;
}

// Of a tag that was only said to be by a joint: of the poses it has in all frames, the
// one that is nearest to the others.
void GuessMount(const std::vector<PosedFrame>& frames, const Skeleton& skeleton,
                const Eigen::Isometry3d& cam_from_world, TagMount* mount) {
  std::vector<Eigen::Isometry3d> candidates;
  BoneFrames bones;
  for (const PosedFrame& frame : frames)
    for (const TagSighting& tag : frame.sighted->tags) {
      if (tag.detection.id != mount->said->id || tag.poses.empty() || tag.is_ambiguous) continue;
      ForwardKinematics(skeleton, frame.pose, &bones);
      candidates.push_back((cam_from_world * WorldFromBone(bones, mount->bone)).inverse() *
                           tag.poses.front().cam_from_tag);
    }
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& candidate : candidates) {
    double sum = 0.0;
    for (const Eigen::Isometry3d& other : candidates)
      sum += std::min(1.0, (candidate.linear() - other.linear()).norm()) +
             std::min(1.0, 5.0 * (candidate.translation() - other.translation()).norm());
    if (sum >= least) continue;
    least = sum;
    mount->Set(candidate);
  }
}

void AddMounts(const BodyTags& said, const Skeleton& skeleton, TagBundle* bundle) {
  for (const BodyTag& tag : said.tags) {
    TagMount mount{.said = &tag};
    if (tag.on_bone) {
      mount.bone = skeleton.FindBone(tag.on_bone->bone).value_or(-1);
      mount.Set(tag.on_bone->bone_from_tag);
    } else if (tag.on_joint) {
      mount.bone = FindJoint(tag.on_joint->joint).value_or(-1);
    }
    bundle->mounts.emplace(tag.id, mount);
  }
}

// The tags as they were found, for the next round and the answer.
BodyTags FoundTags(const BodyTags& said, const TagBundle& bundle, const Skeleton& skeleton) {
  BodyTags found = said;
  for (BodyTag& tag : found.tags) {
    const TagMount& mount = bundle.mounts.at(tag.id);
    if (mount.num_frames == 0) continue;
    tag.on_bone = TagOnBone{skeleton.bones[static_cast<size_t>(mount.bone)].name,
                            mount.BoneFromTag(), mount.sigma_m, mount.sigma_rad};
    tag.on_joint.reset();
  }
  found.bone_lengths_m.clear();
  const Eigen::VectorXd lengths_m = BoneLengths(skeleton);
  for (int j = 1; j < kNumJoints; ++j)
    found.bone_lengths_m.emplace_back(Joints()[static_cast<size_t>(j)].name, lengths_m[j]);
  return found;
}

TagFitRow RowOf(const TagMount& mount, const TagBundle& bundle,
                const std::vector<PosedFrame>& frames) {
  TagFitRow row{.id = mount.said->id, .num_frames = mount.num_frames};
  if (row.num_frames == 0) return row;
  row.rms_px = bundle.Rms_px(frames, row.id);
  if (!mount.said->on_bone) return row;
  const Eigen::Isometry3d moved =
      mount.said->on_bone->bone_from_tag.inverse() * mount.BoneFromTag();
  row.moved_mm = 1e3 * moved.translation().norm();
  constexpr double kDeg = 180.0 / std::numbers::pi;
  row.turned_deg = kDeg * Eigen::AngleAxisd(moved.linear()).angle();
  row.leaned_deg = kDeg * std::acos(std::clamp(moved.linear()(2, 2), -1.0, 1.0));
  return row;
}

}  // namespace

TagFit FitTags(const std::vector<SightedFrame>& frames, const BodyTags& said, const Camera& camera,
               const Eigen::Quaterniond& cam_from_world, const PhotoLifter& lifter,
               const std::shared_ptr<const MotionCodebook>& codebook, const TagFitOptions& options,
               const ProgressFn& progress) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  const Skeleton& standard = lifter.dictionary().skeleton;
  TagBundle bundle(standard, lifter.dictionary().prior, camera, cam_from_world, options);
  const BodyTags said_on_bones = OnBones(said, standard);
  AddMounts(said_on_bones, standard, &bundle);
  TagFit fit{.tags = said, .skeleton = standard, .camera = camera};
  std::vector<PosedFrame> posed;
  for (int round = 0; round < options.rounds; ++round) {
    const ProgressFn part = [&](double fraction) {
      if (progress) progress((round + fraction) / options.rounds);
    };
    TagTracker tracker(fit.skeleton, fit.tags, fit.camera, cam_from_world, lifter, codebook,
                       {.filter = {.latency_s = kLatency_s, .variance_scale = 15.0},
                        .depth_sigma = options.depth_sigma});
    posed = MostDifferent(Track(frames, &tracker, part), options.num_frames);
    fit.num_frames = static_cast<int>(posed.size());
    if (fit.num_frames < kLeastFrames) {
      fit.message = fmt::format(
          "found a pose in {} of {} frames, wanted at least {}: show more tags at once, turn "
          "slowly, and check that they sit where the tags file says",
          fit.num_frames, frames.size(), kLeastFrames);
      return fit;
    }
    for (auto& [id, mount] : bundle.mounts)
      if (!mount.is_known)
        GuessMount(posed, fit.skeleton, Eigen::Isometry3d(cam_from_world), &mount);
    if (!bundle.Solve(&posed)) {
      fit.message = "the adjustment of all frames together broke down";
      return fit;
    }
    fit.skeleton = WithProportions(standard, bundle.ratios);
    fit.tags = FoundTags(said, bundle, fit.skeleton);
    fit.camera = bundle.FoundCamera();
  }
  fit.is_usable = true;
  fit.focal_sigma = std::sqrt(bundle.lens_covariance(0, 0));
  fit.proportions = {bundle.ratios, bundle.ratios_covariance};
  for (const auto& [id, mount] : bundle.mounts) fit.rows.push_back(RowOf(mount, bundle, posed));
  return fit;
}

}  // namespace poselift
