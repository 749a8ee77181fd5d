// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/tag_placement.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/testing/body_shape.h"
#include "src/testing/round_cone.h"

namespace poselift::testing {
namespace {

using Eigen::Vector3d;

// At rest a bone's axes are the world's, the arms are level and the palms down.
const Vector3d kFront(0, 0, 1), kBack(0, 0, -1), kUp(0, 1, 0), kDown(0, -1, 0), kLeft(1, 0, 0),
    kAlongBone(0, 0, 0);
// Around an arm, in thirds from its front turned outward by 30 degrees: four papers of 10 cm
// would go through each other.
const Vector3d kArmFront(0, 0.5, 0.866), kArmBack(0, 0.5, -0.866), kArmInner(0, -1, 0);

// Where a tag sits, on the left side or in the middle.
struct Site {
  const char* name;
  const char* bone;  // without l and r
  bool has_sides;
  double share;           // of the bone's length from its start
  const Vector3d& faces;  // away from the body
  const Vector3d& down;   // where the print's lower edge is
};

const std::vector<Site>& FrontSites() {
  static const std::vector<Site> kSites = {
      {"pelvis front", "root", false, 0, kFront, kDown},
      {"chest front", "thorax", false, 0.3, kFront, kDown},
      {"forehead", "head", false, 0.65, kFront, kDown},
      {"upper arm front", "humerus", true, 0.55, kArmFront, kAlongBone},
      {"forearm front", "radius", true, 0.75, kArmFront, kAlongBone},
      {"thigh front", "femur", true, 0.6, kFront, kAlongBone},
      {"shin front", "tibia", true, 0.5, kFront, kAlongBone},
      {"foot", "foot", true, 0.95, kUp, kAlongBone},
  };
  return kSites;
}

const std::vector<Site>& OtherSites() {
  static const std::vector<Site> kSites = {
      {"pelvis back", "root", false, 0, kBack, kDown},
      {"pelvis side", "root", true, 0, kLeft, kDown},
      {"chest back", "thorax", false, 0.3, kBack, kDown},
      {"head back", "head", false, 0.65, kBack, kDown},
      {"head side", "head", true, 0.65, kLeft, kDown},
      {"upper arm back", "humerus", true, 0.55, kArmBack, kAlongBone},
      {"upper arm inner", "humerus", true, 0.55, kArmInner, kAlongBone},
      {"forearm back", "radius", true, 0.75, kArmBack, kAlongBone},
      {"forearm inner", "radius", true, 0.75, kArmInner, kAlongBone},
      {"thigh outer", "femur", true, 0.6, kLeft, kAlongBone},
      {"thigh back", "femur", true, 0.6, kBack, kAlongBone},
      {"shin outer", "tibia", true, 0.5, kLeft, kAlongBone},
      {"shin back", "tibia", true, 0.5, kBack, kAlongBone},
  };
  return kSites;
}

class Placer {
 public:
  Placer(const Skeleton& skeleton, const TagPlacementOptions& options)
      : skeleton_(skeleton), options_(options), body_(BodyAround(skeleton)) {
    ForwardKinematics(skeleton, SkeletonPose::Rest(skeleton), &frames_);
  }

  void Place(const Site& site, BodyTags* tags) const {
    if (!site.has_sides) return Add(site, "", "", 1.0, tags);
    Add(site, "left ", "l", 1.0, tags);
    Add(site, "right ", "r", -1.0, tags);
  }

  // Moved out until no part of the body reaches through the paper, seen by an eye so
  // far before it that its rays are as good as parallel.
  Eigen::Isometry3d OnSurface(int bone, const Eigen::Isometry3d& bone_from_tag,
                              double size_m) const {
    constexpr double kFar_m = 20.0;
    constexpr double kReach_m = 0.3;  // a part of the body further off is not this one
    constexpr int kRays = 9;
    const Eigen::Isometry3d tag_from_rest =
        (Eigen::Translation3d(frames_.start_in_world_m.col(bone)) * bone_from_tag).inverse();
    const Eigen::Isometry3d eye_from_rest = Eigen::Translation3d(0, 0, kFar_m) * tag_from_rest;
    const double half_m = 0.5 * options_.paper_per_size * size_m;
    double nearest_m = kFar_m + kReach_m;
    for (const BodyPart& part : body_) {
      const SeenRoundCone seen(
          part.cone, eye_from_rest * Eigen::Translation3d(frames_.start_in_world_m.col(part.bone)));
      for (int i = 0; i < kRays * kRays; ++i) {
        const Eigen::Vector2d at_m =
            half_m * Eigen::Vector2d(2.0 * (i % kRays) / (kRays - 1) - 1,
                                     2.0 * (i / kRays) / (kRays - 1) - 1);  // NOLINT
        const double depth_m = seen.Depth_m((at_m / kFar_m).cast<float>());
        if (depth_m > kFar_m - kReach_m) nearest_m = std::min(nearest_m, depth_m);
      }
    }
    return bone_from_tag * Eigen::Translation3d(0, 0, nearest_m - kFar_m - options_.gap_m);
  }

 private:
  void Add(const Site& site, const std::string& side_name, const std::string& prefix, double side,
           BodyTags* tags) const {
    std::string bone_name = prefix + site.bone;
    auto bone = skeleton_.FindBone(bone_name);
    if (!bone) bone = skeleton_.FindBone(bone_name = site.bone);  // sides of head and pelvis
    if (!bone)
      throw InputError("found no bone '" + bone_name + "' in '" + skeleton_.name +
                       "', wanted a CMU skeleton");
    BodyTag tag{options_.first_id + static_cast<int>(tags->tags.size()), options_.size_m,
                side_name + site.name};
    tag.on_bone.emplace().bone = bone_name;
    tag.on_bone->bone_from_tag = OnSurface(*bone, Upright(site, *bone, side), tag.size_m);
    tags->tags.push_back(std::move(tag));
  }

  // Through the bone, not yet at the surface.
  Eigen::Isometry3d Upright(const Site& site, int bone, double side) const {
    const Vector3d mirror(side, 1, 1), tip_m = skeleton_.bones[bone].tip_m;
    const Vector3d down = (site.down.isZero() ? tip_m : site.down).normalized();
    const Vector3d faces = mirror.cwiseProduct(site.faces);
    Eigen::Isometry3d bone_from_tag = Eigen::Isometry3d::Identity();
    bone_from_tag.linear().col(1) = down;
    bone_from_tag.linear().col(2) = -(faces - faces.dot(down) * down).normalized();
    bone_from_tag.linear().col(0) = down.cross(bone_from_tag.linear().col(2));
    bone_from_tag.translation() = site.share * tip_m;
    return bone_from_tag;
  }

  const Skeleton& skeleton_;
  const TagPlacementOptions& options_;
  std::vector<BodyPart> body_;
  BoneFrames frames_;
};

}  // namespace

std::string TagPlacementOptions::Validate() const {
  if (!(size_m > 0.0 && size_m < 1.0))
    return fmt::format("found a tag of {} m, wanted more than 0 and less than 1", size_m);
  if (!(paper_per_size >= 1.0 && std::isfinite(paper_per_size)))
    return fmt::format("found paper of {} tag sizes, wanted at least 1", paper_per_size);
  if (!(gap_m >= 0.0 && gap_m < 1.0))
    return fmt::format("found a gap of {} m, wanted 0 to 1", gap_m);
  if (first_id < 0) return fmt::format("found the first id {}, wanted at least 0", first_id);
  return "";
}

BodyTags DefaultTagPlacement(const Skeleton& skeleton, const TagPlacementOptions& options) {
  if (const std::string flaw = options.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  const Placer placer(skeleton, options);
  BodyTags tags;
  for (const Site& site : FrontSites()) placer.Place(site, &tags);
  if (options.around)
    for (const Site& site : OtherSites()) placer.Place(site, &tags);
  return tags;
}

BodyTags OnSurface(BodyTags tags, const Skeleton& skeleton, const TagPlacementOptions& options) {
  const Placer placer(skeleton, options);
  for (BodyTag& tag : tags.tags) {
    const auto bone = tag.on_bone ? skeleton.FindBone(tag.on_bone->bone) : std::nullopt;
    if (!bone) throw InputError(fmt::format("found the tag {} on no bone of the skeleton", tag.id));
    tag.on_bone->bone_from_tag = placer.OnSurface(*bone, tag.on_bone->bone_from_tag, tag.size_m);
  }
  return tags;
}

}  // namespace poselift::testing
