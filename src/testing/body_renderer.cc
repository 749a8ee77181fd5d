// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/testing/body_renderer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/tag_detection.h"
#include "src/testing/body_painter.h"

namespace poselift::testing {
namespace {

constexpr double kSpeedStep_s = 1e-3;

// cv::RNG's seed of a frame: the bits of both, mixed (splitmix64).
std::uint64_t FrameSeed(std::uint64_t seed, double time_s) {
  std::uint64_t z =
      seed + 0x9e3779b97f4a7c15u * (static_cast<std::uint64_t>(std::llround(time_s * 1e6)) + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// A grey wall with stains of all sizes, a little of them in colour.
cv::Mat MadeUpWall(cv::Size size_px, std::uint64_t seed) {
  cv::RNG rng(FrameSeed(seed, -1.0));
  cv::Mat wall(size_px, CV_32FC3, cv::Scalar::all(135));
  for (const auto& [grain_px, levels] : {std::pair{3, 6.0}, {12, 8.0}, {50, 12.0}, {200, 16.0}}) {
    const cv::Size grains(size_px.width / grain_px + 2, size_px.height / grain_px + 2);
    for (const double in_color : {0.0, 0.15}) {
      cv::Mat noise(grains, in_color > 0.0 ? CV_32FC3 : CV_32FC1), stains;
      rng.fill(noise, cv::RNG::NORMAL, cv::Scalar::all(0),
               cv::Scalar::all((in_color > 0.0 ? in_color : 1.0) * levels));
      cv::resize(noise, stains, size_px, 0, 0, cv::INTER_CUBIC);
      if (stains.channels() == 1) cv::cvtColor(stains, stains, cv::COLOR_GRAY2BGR);
      wall += stains;
    }
  }
  return wall;
}

cv::Mat Background(const RenderOptions& options, cv::Size size_px) {
  cv::Mat background;
  if (options.background.empty()) {
    background = MadeUpWall(size_px, options.seed);
  } else {
    cv::resize(options.background, background, size_px, 0, 0, cv::INTER_AREA);
    background.convertTo(background, CV_32F);
  }
  if (options.color && background.channels() == 1)
    cv::cvtColor(background, background, cv::COLOR_GRAY2BGR);
  if (!options.color && background.channels() == 3)
    cv::cvtColor(background, background, cv::COLOR_BGR2GRAY);
  return background;
}

void CheckPrint(const TagPrint& print, int id) {
  const bool is_right = print.cells.type() == CV_8UC1 && print.cells.rows == print.cells.cols &&
                        print.cells_of_size > 0 && print.cells_of_size <= print.cells.cols;
  if (!is_right)
    throw std::invalid_argument(
        fmt::format("found the print of tag {}: {} x {} cells, {} of size, wanted a square of "
                    "8-bit grey and no more of size",
                    id, print.cells.cols, print.cells.rows, print.cells_of_size));
}

std::vector<WornTag> Wear(const Skeleton& skeleton, const BodyTags& tags,
                          const BodyRenderer::PrintOf& print_of, double paper_margin) {
  std::vector<WornTag> worn;
  for (const BodyTag& tag : tags.tags) {
    if (!tag.on_bone)
      throw InputError(fmt::format("found tag {} without its place on a bone", tag.id));
    const auto bone = skeleton.FindBone(tag.on_bone->bone);
    if (!bone)
      throw InputError(fmt::format("found tag {} on the bone '{}', which '{}' does not have",
                                   tag.id, tag.on_bone->bone, skeleton.name));
    const TagPrint print = print_of(tag.id);
    CheckPrint(print, tag.id);
    worn.push_back(
        {tag.id, *bone, tag.on_bone->bone_from_tag, tag.size_m, paper_margin * tag.size_m, print});
  }
  return worn;
}

const Camera& Checked(const Camera& camera) {
  if (const std::string flaw = camera.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  return camera;
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TagTruth TruthOf(const WornTag& worn, const Eigen::Isometry3d& cam_from_tag, const Camera& camera) {
  TagTruth truth{worn.id, cam_from_tag};
  const Eigen::Matrix<double, 3, 4> corners_m = cam_from_tag * TagCorners_m(worn.size_m);
  for (int i = 0; i < 4; ++i) truth.corners_px.col(i) = camera.Project(corners_m.col(i));
  for (int i = 0; i < 4; ++i)
    truth.size_px += 0.25 * (truth.corners_px.col(i) - truth.corners_px.col((i + 1) % 4)).norm();
  truth.facing_rad = AngleBetween(cam_from_tag.linear().col(2), cam_from_tag.translation());
  return truth;
}

}  // namespace

std::string RenderOptions::Validate() const {
  if (!(exposure_s >= 0.0 && exposure_s <= 1.0))
    return fmt::format("found an exposure of {} s, wanted 0 to 1", exposure_s);
  if (!(noise_grey_levels >= 0.0 && noise_grey_levels < 256.0))
    return fmt::format("found noise of {} grey levels, wanted 0 to 255", noise_grey_levels);
  if (!background.empty() && background.type() != CV_8UC1 && background.type() != CV_8UC3)
    return "found a background that is not 8-bit grey or BGR";
  if (!(paper_margin >= 0.0 && std::isfinite(paper_margin)))
    return fmt::format("found a paper margin of {} tag sizes, wanted at least 0", paper_margin);
  if (!(ambient >= 0.0 && ambient <= 1.0))
    return fmt::format("found the ambient brightness {}, wanted 0 to 1", ambient);
  if (!(towards_light_in_cam.allFinite() && towards_light_in_cam.norm() > 0.0))
    return "found a light without a direction";
  return "";
}

BodyRenderer::BodyRenderer(const Skeleton& skeleton, const BodyTags& tags, const PrintOf& print_of,
                           const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                           const RenderOptions& options)
    : skeleton_(skeleton),
      parts_(BodyAround(skeleton)),
      tags_(Wear(skeleton, tags, print_of, options.paper_margin)),
      camera_(Checked(camera)),
      cam_from_world_(cam_from_world),
      options_(options),
      rays_(camera) {
  if (const std::string flaw = options.Validate(); !flaw.empty()) throw std::invalid_argument(flaw);
  background_ = Background(options, {camera.width_px, camera.height_px});
}

SeenBody BodyRenderer::SeenAt(const SkeletonPose& pose) const {
  BoneFrames frames;
  ForwardKinematics(skeleton_, pose, &frames);
  return {parts_, tags_, frames, camera_, cam_from_world_};
}

FrameTruth BodyRenderer::Truth(const PoseAt& pose_at, double time_s) const {
  FrameTruth truth{time_s, pose_at(time_s)};
  truth.joints_in_cam_m =
      (cam_from_world_.linear() * JointPositions(skeleton_, truth.pose)).colwise() +
      cam_from_world_.translation();
  const SeenBody body = SeenAt(truth.pose), before = SeenAt(pose_at(time_s - kSpeedStep_s)),
                 after = SeenAt(pose_at(time_s + kSpeedStep_s));
  for (size_t i = 0; i < tags_.size(); ++i) {
    TagTruth tag = TruthOf(tags_[i], body.cam_from_tag(i), camera_);
    tag.visible_share = body.VisibleShare(i, camera_);
    const auto centre_px = [&](const SeenBody& at) {
      return camera_.Project(at.cam_from_tag(i).translation());
    };
    tag.speed_px_per_s = (centre_px(after) - centre_px(before)).norm() / (2 * kSpeedStep_s);
    truth.tags.push_back(tag);
  }
  return truth;
}

// How far the fastest joint goes on the picture during the exposure.
double BodyRenderer::Blur_px(const PoseAt& pose_at, double time_s) const {
  if (options_.exposure_s == 0.0) return 0.0;
  const auto joints_in_cam_m = [&](double part) -> Pose3 {
    const SkeletonPose pose = pose_at(time_s + part * options_.exposure_s);
    return (cam_from_world_.linear() * JointPositions(skeleton_, pose)).colwise() +
           cam_from_world_.translation();
  };
  const Pose3 first_m = joints_in_cam_m(-0.5), last_m = joints_in_cam_m(0.5);
  double blur_px = 0.0;
  for (int j = 0; j < kNumJoints; ++j) {
    const double moved_px =
        (camera_.Project(last_m.col(j)) - camera_.Project(first_m.col(j))).norm();
    if (moved_px > blur_px) blur_px = moved_px;  // not for NaN
  }
  return blur_px;
}

RenderedFrame BodyRenderer::Render(const PoseAt& pose_at, double time_s) const {
  constexpr int kMostMoments = 32;
  const double blur_px = Blur_px(pose_at, time_s);
  const int moments = std::clamp(static_cast<int>(std::ceil(1.5 * blur_px)), 1, kMostMoments);
  // Of edges that are smeared anyway few rays a moment are enough.
  const int rays = moments > 7   ? kStepsOfPixel / 4
                   : moments > 2 ? kStepsOfPixel / 2
                                 : kStepsOfPixel;
  const Light light{options_.towards_light_in_cam.normalized().cast<float>(),
                    static_cast<float>(options_.ambient)};
  const BodyPainter painter(rays_, light, background_);
  cv::Mat sum = background_.clone();
  for (int i = 0; i < moments; ++i) {
    const double at_s = time_s + options_.exposure_s * ((i + 0.5) / moments - 0.5);
    painter.Add(SeenAt(pose_at(at_s)), i * rays, rays, 1.0f / static_cast<float>(moments), &sum);
  }
  if (options_.noise_grey_levels > 0.0) {
    cv::Mat noise(sum.size(), sum.type());
    cv::RNG(FrameSeed(options_.seed, time_s))
        .fill(noise, cv::RNG::NORMAL, cv::Scalar::all(0),
              cv::Scalar::all(options_.noise_grey_levels));
    sum += noise;
  }
  RenderedFrame frame{{}, Truth(pose_at, time_s)};
  sum.convertTo(frame.picture, CV_8U);
  return frame;
}

}  // namespace poselift::testing
