// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up skeleton before made-up cameras; the detector is the real one. The truth that
// comes with a picture is checked against the picture itself: corners against detected
// ones, what is visible against the pixels that a tag changes, blur and noise against
// their definitions.
#include "src/testing/body_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/tag_detector.h"
#include "calib/tag_family.h"
#include "lift/ik/inverse_kinematics.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "tests/support/cmu_like_skeleton.h"
#include "tests/support/planted_walk.h"
#include "tests/support/support.h"

namespace poselift::testing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TagPrint Print36h11(int id) {
  static const TagFamily kFamily("tag36h11");
  return {kFamily.Image(id), kFamily.cells_of_size()};
}

TagPrint Plain(uchar level) { return {cv::Mat(1, 1, CV_8U, cv::Scalar(level)), 1}; }

SkeletonPose Standing() {
  SkeletonPose pose = SkeletonPose::Rest(TrimmedCmuLikeSkeleton());
  pose.root_in_world_m.y() = 0.95;
  return pose;
}

Motion Still(const SkeletonPose& pose) { return {TrimmedCmuLikeSkeleton(), 1.0, {pose}}; }

BodyRenderer::PoseAt Always(const SkeletonPose& pose) {
  return [pose](double) { return pose; };
}

BodyRenderer Before(const Motion& motion, double distance_m, const RenderOptions& options = {},
                    const Camera& camera = Webcam(),
                    const BodyRenderer::PrintOf& print_of = Print36h11) {
  const PlacedCamera placed = CameraBefore(motion, distance_m, 0.0, camera);
  return {motion.skeleton,
          DefaultTagPlacement(motion.skeleton),
          print_of,
          placed.camera,
          placed.cam_from_world,
          options};
}

const TagTruth& TruthOf(const FrameTruth& truth, const std::string& name) {
  const BodyTags tags = DefaultTagPlacement(TrimmedCmuLikeSkeleton());
  for (size_t i = 0; i < tags.tags.size(); ++i)
    if (tags.tags[i].name == name) return truth.tags[i];
  throw std::logic_error("no such tag: " + name);
}

// The left hand before the chest, on the way to a camera ahead.
SkeletonPose HandBeforeChest() {
  const Skeleton skeleton = TrimmedCmuLikeSkeleton();
  const InverseKinematics ik(skeleton);
  Pose3 target_m = JointPositions(ik.body(), Standing());
  IkHints hints;
  hints.joint_weights = Eigen::VectorXd::Ones(kNumJoints);
  hints.joint_weights[joint::kLeftElbow] = 0.0;
  target_m.col(joint::kLeftWrist) = target_m.col(joint::kUpperBack) + Vector3d(0.07, 0.0, 0.3);
  target_m.col(joint::kLeftHand) = target_m.col(joint::kUpperBack) + Vector3d(-0.03, 0.02, 0.3);
  hints.start = Standing();
  return ik.Solve(target_m, hints).pose;
}

struct CornerErrors {
  int num_corners = 0;
  Vector2d bias_px = Vector2d::Zero();
  double rms_px = 0.0;
  double worst_px = 0.0;
};

// Of tags that are whole and not too steep.
CornerErrors DetectedCorners(const BodyRenderer& renderer, const BodyRenderer::PoseAt& pose_at,
                             const std::vector<double>& times_s) {
  TagDetector detector(TagFamily("tag36h11"));
  CornerErrors errors;
  for (const double time_s : times_s) {
    const RenderedFrame frame = renderer.Render(pose_at, time_s);
    const std::vector<TagDetection> detections = detector.Detect(frame.picture);
    for (const TagTruth& tag : frame.truth.tags) {
      if (tag.visible_share < 1.0 || tag.facing_rad > std::numbers::pi / 4) continue;
      const auto seen = std::find_if(detections.begin(), detections.end(),
                                     [&](const TagDetection& d) { return d.id == tag.id; });
      if (seen == detections.end()) continue;
      for (int i = 0; i < 4; ++i) {
        const Vector2d error_px = seen->corners_px.col(i) - tag.corners_px.col(i);
        ++errors.num_corners;
        errors.bias_px += error_px;
        errors.rms_px += error_px.squaredNorm();
        errors.worst_px = std::max(errors.worst_px, error_px.norm());
      }
    }
  }
  errors.bias_px /= errors.num_corners;
  errors.rms_px = std::sqrt(errors.rms_px / errors.num_corners);
  return errors;
}

TEST(BodyRendererTest, TrueCornersAreWhereADetectorFindsThem) {
  const Motion walk = OnTheSpot(PlantWalk(61, 0.6, 0.0).motion);
  Camera strong = Webcam();
  strong.distortion = {.k1 = -0.25, .k2 = 0.08, .p1 = 0.002, .p2 = -0.003};
  for (const Camera& camera : {Webcam(), strong}) {
    const CornerErrors errors = DetectedCorners(Before(walk, 2.5, {}, camera), PosesOver(walk),
                                                {0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9});
    EXPECT_GT(errors.num_corners, 100);
    EXPECT_LT(errors.bias_px.norm(), 0.02);
    EXPECT_LT(errors.rms_px, 0.06);
    EXPECT_LT(errors.worst_px, 0.25);
  }
}

// What a tag changes of the picture when it is black instead of white, by what all of it
// would.
TEST(BodyRendererTest, TheVisibleShareIsThatOfThePixelsThatATagChanges) {
  const Motion walk = PlantWalk(40, 0.6, 0.0).motion;
  const Skeleton& skeleton = walk.skeleton;
  SkeletonPose hidden = HandBeforeChest();
  const Camera small{480, 270, 340, 340, 240, 135, {.k1 = -0.06}};
  int whole = 0, partly = 0, none = 0;
  for (const SkeletonPose& pose : {hidden, walk.frames[12], walk.frames[33]}) {
    // From the side some limbs hide others, near the edge some tags are cut.
    for (const double azimuth_rad : {0.0, 0.6}) {
      const PlacedCamera placed = CameraBefore(Still(pose), 1.9, azimuth_rad, small);
      const BodyTags tags = DefaultTagPlacement(skeleton);
      const auto render = [&](int black_id) {
        const auto print_of = [&](int id) { return Plain(id == black_id ? 0 : 255); };
        return BodyRenderer(skeleton, tags, print_of, placed.camera, placed.cam_from_world)
            .Render(Always(pose), 0.0);
      };
      const RenderedFrame white = render(-1);
      for (const TagTruth& tag : white.truth.tags) {
        cv::Mat change;
        cv::absdiff(white.picture, render(tag.id).picture, change);
        double most = 0.0;
        cv::minMaxLoc(change, nullptr, &most);
        const double changed_px = most > 0.0 ? cv::sum(change)[0] / most : 0.0;
        double twice_area_px = 0.0;
        for (int i = 0; i < 4; ++i) {
          const Vector2d a = tag.corners_px.col(i), b = tag.corners_px.col((i + 1) % 4);
          twice_area_px += a.x() * b.y() - b.x() * a.y();
        }
        // From behind its corners go round the other way.
        const double share = twice_area_px > 0.0 ? changed_px / (0.5 * twice_area_px) : 0.0;
        EXPECT_NEAR(tag.visible_share, share, 0.05) << tag.id << " " << azimuth_rad;
        (tag.visible_share == 1.0 ? whole : tag.visible_share > 0.0 ? partly : none)++;
      }
    }
  }
  EXPECT_GT(whole, 20);
  EXPECT_GT(partly, 5);
  EXPECT_GT(none, 2);
}

TEST(BodyRendererTest, AnArmBeforeTheChestHidesItsTag) {
  TagDetector detector(TagFamily("tag36h11"));
  const auto finds_chest = [&](const RenderedFrame& frame, const TagTruth& chest) {
    for (const TagDetection& tag : detector.Detect(frame.picture))
      if (tag.id == chest.id) return true;
    return false;
  };
  const RenderedFrame open = Before(Still(Standing()), 2.0).Render(Always(Standing()), 0.0);
  const TagTruth& seen = TruthOf(open.truth, "chest front");
  EXPECT_EQ(seen.visible_share, 1.0);
  EXPECT_TRUE(finds_chest(open, seen));
  const SkeletonPose pose = HandBeforeChest();
  const RenderedFrame closed = Before(Still(pose), 2.0).Render(Always(pose), 0.0);
  const TagTruth& hidden = TruthOf(closed.truth, "chest front");
  EXPECT_LT(hidden.visible_share, 0.8);
  EXPECT_FALSE(finds_chest(closed, hidden));
  EXPECT_TRUE(MatrixNear(hidden.corners_px, seen.corners_px, 30.0));  // it is still there
}

TEST(BodyRendererTest, TagsAreSeenFromBeforeAlone) {
  SkeletonPose turned = Standing();
  turned.world_from_root = Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitY());
  const BodyRenderer renderer = Before(Still(Standing()), 2.5);  // before one not turned
  const RenderedFrame frame = renderer.Render(Always(turned), 0.0);
  for (const TagTruth& tag : frame.truth.tags)
    EXPECT_TRUE(tag.facing_rad < std::numbers::pi / 2 || tag.visible_share == 0.0);
  EXPECT_GT(TruthOf(frame.truth, "chest front").facing_rad, 3.0);
  EXPECT_TRUE(TagDetector(TagFamily("tag36h11")).Detect(frame.picture).empty());
}

// Place and length of the left edge of the chest's tag, along its middle row: of a step
// smeared over a length L the slope has the variance L^2 / 12, 2 / 12 more by pixels and
// by differences between them.
struct Edge {
  double at_px;
  double square_length_px2;
};
Edge LeftEdge(const RenderedFrame& frame) {
  const TagTruth& chest = TruthOf(frame.truth, "chest front");
  const Vector2d middle_px = 0.5 * (chest.corners_px.col(0) + chest.corners_px.col(3));
  const int row = static_cast<int>(std::lround(middle_px.y()));
  const int first = static_cast<int>(middle_px.x()) - 10;  // the paper ends 18 px away
  double sum = 0.0, mean = 0.0, square = 0.0;
  for (int x = first; x < first + 21; ++x) {
    const double slope = frame.picture.at<uchar>(row, x) - frame.picture.at<uchar>(row, x + 1);
    const double from_edge_px = x + 0.5 - middle_px.x();
    sum += slope;
    mean += slope * from_edge_px;
    square += slope * from_edge_px * from_edge_px;
  }
  mean /= sum;
  return {mean, 12 * (square / sum - mean * mean) - 2};
}

TEST(BodyRendererTest, BlurIsAsLongAsTheWayDuringTheExposure) {
  constexpr double kDistance_m = 2.0, kSpeed_m_per_s = 1.5;
  const Camera pinhole{1280, 720, 900, 900, 640, 360};
  const auto pose_at = [](double time_s) {
    SkeletonPose pose = Standing();
    pose.root_in_world_m.x() = kSpeed_m_per_s * (time_s - 1.0);
    return pose;
  };
  const auto black = [](int) { return Plain(0); };
  for (const double exposure_s : {0.0, 1.0 / 250, 1.0 / 120, 1.0 / 60}) {
    const RenderOptions options{.exposure_s = exposure_s, .paper_margin = 0.5};
    const BodyRenderer renderer = Before(Still(Standing()), kDistance_m, options, pinhole, black);
    const RenderedFrame frame = renderer.Render(pose_at, 1.0);
    const TagTruth& chest = TruthOf(frame.truth, "chest front");
    EXPECT_NEAR(chest.speed_px_per_s, 900 * kSpeed_m_per_s / chest.cam_from_tag.translation().z(),
                1.0);
    const Edge edge = LeftEdge(frame);
    EXPECT_NEAR(edge.square_length_px2, std::pow(chest.speed_px_per_s * exposure_s, 2), 2.0)
        << exposure_s;
    EXPECT_NEAR(edge.at_px, 0.0, 0.1) << exposure_s;
  }
}

TEST(BodyRendererTest, NoiseIsAsWideAsAskedAndHasNoMean) {
  const Motion still = Still(Standing());
  const RenderedFrame clean = Before(still, 3.0).Render(Always(Standing()), 0.0);
  for (const double sigma : {1.0, 4.0}) {
    const RenderedFrame noisy =
        Before(still, 3.0, {.noise_grey_levels = sigma}).Render(Always(Standing()), 0.0);
    cv::Mat noise, mean, deviation;
    cv::subtract(noisy.picture, clean.picture, noise, cv::noArray(), CV_64F);
    cv::meanStdDev(noise, mean, deviation);
    EXPECT_NEAR(mean.at<double>(0), 0.0, 0.02);
    EXPECT_NEAR(deviation.at<double>(0), std::sqrt(sigma * sigma + 1.0 / 12), 0.07 * sigma);
  }
}

TEST(BodyRendererTest, TheSameSeedMakesTheSameBytesInAnyOrder) {
  const Motion walk = OnTheSpot(PlantWalk(31, 0.6, 0.0).motion);
  const auto bytes = [&](std::uint64_t seed, const std::vector<double>& times_s) {
    const RenderOptions options{
        .exposure_s = 0.01, .noise_grey_levels = 2.0, .seed = seed, .color = true};
    const BodyRenderer renderer = Before(walk, 3.0, options);
    cv::Mat last;
    for (const double time_s : times_s) last = renderer.Render(PosesOver(walk), time_s).picture;
    return last;
  };
  const cv::Mat first = bytes(5, {0.2, 0.3});
  EXPECT_EQ(cv::norm(first, bytes(5, {0.3}), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, bytes(6, {0.3}), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, bytes(5, {0.2}), cv::NORM_INF), 0.0);
}

TEST(BodyRendererTest, TheGreyPictureIsThatOfTheColours) {
  const Motion still = Still(Standing());
  const cv::Mat color = Before(still, 3.0, {.color = true}).Render(Always(Standing()), 0.0).picture;
  const cv::Mat grey = Before(still, 3.0).Render(Always(Standing()), 0.0).picture;
  ASSERT_EQ(color.type(), CV_8UC3);
  ASSERT_EQ(grey.type(), CV_8UC1);
  cv::Mat of_color;
  cv::cvtColor(color, of_color, cv::COLOR_BGR2GRAY);
  EXPECT_LE(cv::norm(grey, of_color, cv::NORM_INF), 2.0);
}

TEST(BodyRendererTest, APhotoStandsBehindTheBodyAndNowhereElse) {
  const Motion still = Still(Standing());
  const cv::Mat photo(90, 160, CV_8UC3, cv::Scalar(200, 30, 30));
  const RenderedFrame frame =
      Before(still, 3.0, {.color = true, .background = photo}).Render(Always(Standing()), 0.0);
  ASSERT_EQ(frame.picture.size(), cv::Size(1280, 720));
  EXPECT_EQ(frame.picture.at<cv::Vec3b>(10, 10), cv::Vec3b(200, 30, 30));
  const Vector2d chest_px = TruthOf(frame.truth, "chest front").corners_px.col(0);
  EXPECT_NE(
      frame.picture.at<cv::Vec3b>(static_cast<int>(chest_px.y()), static_cast<int>(chest_px.x())),
      cv::Vec3b(200, 30, 30));
}

TEST(BodyRendererTest, TrueJointsAreThoseOfThePose) {
  const Motion walk = PlantWalk(31, 0.6, 0.0).motion;
  const PlacedCamera placed = CameraBefore(walk, 3.0);
  const BodyRenderer renderer = Before(walk, 3.0);
  const FrameTruth truth = renderer.Truth(PosesOver(walk), 0.25);
  const Pose3 joints_m = JointPositions(walk.skeleton, walk.frames[15]);
  for (int j = 0; j < kNumJoints; ++j)
    EXPECT_TRUE(MatrixNear(truth.joints_in_cam_m.col(j),
                           placed.cam_from_world * Vector3d(joints_m.col(j)), 1e-9));
  for (const TagTruth& tag : truth.tags)
    EXPECT_TRUE(MatrixNear(tag.corners_px.col(2),
                           placed.camera.Project(tag.cam_from_tag * Vector3d(0.04, 0.04, 0)),
                           1e-9));
}

// A person who comes so near that parts are beside and behind the camera.
TEST(BodyRendererTest, ABodyAtTheCameraIsDrawnAsFarAsItIsSeen) {
  const Camera small{160, 90, 110, 110, 80, 45};
  const BodyRenderer renderer = Before(Still(Standing()), 2.0, {}, small);
  for (const double z_m : {1.5, 1.8, 2.3, 5.0}) {
    SkeletonPose pose = Standing();
    pose.root_in_world_m.z() = z_m;
    const RenderedFrame frame = renderer.Render(Always(pose), 0.0);
    for (const TagTruth& tag : frame.truth.tags)
      EXPECT_TRUE(tag.cam_from_tag.translation().z() > -0.1 || tag.visible_share == 0.0);
  }
}

// Beyond its fold a lens has no ray for a pixel.
TEST(BodyRendererTest, WhereTheLensShowsNothingTheBackgroundStays) {
  const Camera folding{320, 240, 150, 150, 160, 120, {.k1 = -0.5}};
  const cv::Mat dark(1, 1, CV_8U, cv::Scalar(7));
  // So near that the body is behind every pixel of the middle row.
  const BodyRenderer renderer = Before(Still(Standing()), 0.32, {.background = dark}, folding);
  const RenderedFrame frame = renderer.Render(Always(Standing()), 0.0);
  int shown = 0, dead = 0;
  for (int x = 0; x < folding.width_px; ++x) {
    const bool is_dead = !folding.Undistort(Vector2d(x, 120)).allFinite();
    (is_dead ? dead : shown)++;
    if (is_dead) {
      EXPECT_EQ(frame.picture.at<uchar>(120, x), 7) << x;
    }
  }
  EXPECT_GT(dead, 50);
  EXPECT_GT(shown, 100);
  EXPECT_GT(frame.picture.at<uchar>(120, 160), 7);
}

TEST(BodyRendererTest, BadInputIsRefused) {
  const Motion still = Still(Standing());
  EXPECT_THROW(Before(still, 3.0, {.exposure_s = -1.0}), std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {.noise_grey_levels = NAN}), std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {.background = cv::Mat(2, 2, CV_32F)}), std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {.paper_margin = -0.1}), std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {.towards_light_in_cam = Vector3d::Zero()}),
               std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {.ambient = 1.1}), std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {}, Camera{}), std::invalid_argument);
  EXPECT_THROW(Before(still, 3.0, {}, Webcam(), [](int) { return TagPrint{}; }),
               std::invalid_argument);
  const PlacedCamera placed = CameraBefore(still, 3.0);
  BodyTags tags{.tags = {{.id = 1, .size_m = 0.08}}};
  const auto wear = [&] {
    BodyRenderer(still.skeleton, tags, Print36h11, placed.camera, placed.cam_from_world);
  };
  EXPECT_THROW(wear(), InputError);
  tags.tags[0].on_bone = TagOnBone{.bone = "tail"};
  EXPECT_THROW(wear(), InputError);
  tags.tags[0].on_bone->bone = "head";
  EXPECT_NO_THROW(wear());
}

}  // namespace
}  // namespace poselift::testing
