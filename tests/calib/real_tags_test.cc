// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real pictures of tags of three projects (../shared/tags), skipped without them: the corners
// that AprilTag's authors have written beside theirs, a pose series, a board held by hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/tag_detector.h"
#include "calib/tag_pose.h"
#include "src/io/image.h"
#include "src/units.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

cv::Mat ReadGrey(const std::filesystem::path& path) {
  cv::Mat grey;
  cv::cvtColor(ReadImage(path), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

using Corners = Eigen::Matrix<double, 2, 4>;

// All of them are the tag 0 of tag36h11, at 0.5 + pixel and from the bottom left.
std::vector<Corners> ReadCornerTruth(const std::filesystem::path& path) {
  std::vector<Corners> tags;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    Corners c;
    int id = 0;
    if (std::sscanf(line.c_str(), "%d, (%lf %lf), (%lf %lf), (%lf %lf), (%lf %lf)", &id, &c(0, 3),
                    &c(1, 3), &c(0, 2), &c(1, 2), &c(0, 1), &c(1, 1), &c(0, 0), &c(1, 0)) == 9)
      tags.emplace_back(c.array() - 0.5);
  }
  return tags;
}

// A detector tells ids apart and not prints: each is looked for by itself.
bool FindAt(const cv::Mat& grey, const Corners& truth_px, TagDetector* detector, Corners* found) {
  const Eigen::Vector2d centre = truth_px.rowwise().mean();
  const double reach = (truth_px.colwise() - centre).colwise().norm().maxCoeff();
  for (const double times : {2.0, 1.6, 1.4}) {
    const Eigen::Vector2d first = centre.array() - times * reach,
                          last = centre.array() + times * reach;
    const cv::Rect region =
        cv::Rect(cv::Point(static_cast<int>(first.x()), static_cast<int>(first.y())),
                 cv::Point(static_cast<int>(last.x()), static_cast<int>(last.y()))) &
        cv::Rect({0, 0}, grey.size());
    for (const TagDetection& tag : detector->Detect(grey(region))) {
      *found = tag.corners_px.colwise() + Eigen::Vector2d(region.x, region.y);
      if (tag.id == 0 && (found->rowwise().mean() - centre).norm() < 3.0) return true;
    }
  }
  return false;
}

TEST(RealTagsTest, CornersAreThoseOfApriltagsAuthors) {
  POSELIFT_DATA_OR_SKIP(data);
  TagDetector detector(TagFamily("tag36h11"), {});
  int num_tags = 0, num_found = 0;
  double squares = 0.0;
  Eigen::Vector2d bias_px = Eigen::Vector2d::Zero();
  for (const char* name :
       {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c", "34139872896_defdb2f8d9_c"}) {
    const std::filesystem::path stem = data / "tags/aprilrobotics" / name;
    const cv::Mat grey = ReadGrey(stem.string() + ".jpg");
    for (const Corners& truth_px : ReadCornerTruth(stem.string() + ".txt")) {
      ++num_tags;
      Corners found_px;
      if (!FindAt(grey, truth_px, &detector, &found_px)) continue;
      ++num_found;
      squares += (found_px - truth_px).squaredNorm() / 8.0;
      bias_px += (found_px - truth_px).rowwise().mean();
    }
  }
  RecordProperty("rms_px", std::to_string(std::sqrt(squares / num_found)));
  RecordProperty("found", std::to_string(num_found) + " of " + std::to_string(num_tags));
  EXPECT_EQ(num_tags, 47);
  EXPECT_GE(num_found, 45);  // one is 13 px large, one seen from the side
  EXPECT_LT(std::sqrt(squares / num_found), 0.4);
  EXPECT_LT((bias_px / num_found).norm(), 0.15);  // half a pixel would be 0.7
}

TEST(RealTagsTest, ThePoseSeriesTurnsByItsAngles) {
  POSELIFT_DATA_OR_SKIP(data);
  const Camera camera{.width_px = 1056,
                      .height_px = 792,
                      .fx_px = 329.8729619143081,
                      .fy_px = 332.94611303946357,
                      .cx_px = 528.0,
                      .cy_px = 396.0};
  TagDetector detector(TagFamily("tag36h11"), {});
  std::vector<Eigen::Isometry3d> poses;
  for (const char* angle : {"0", "-40", "30"}) {
    const cv::Mat grey =
        ReadGrey(data / "tags/duckietown" / (std::string("test_image_rotation_") + angle + ".png"));
    const std::vector<TagDetection> tags = detector.Detect(grey);
    ASSERT_EQ(tags.size(), 1U) << angle;
    EXPECT_EQ(tags[0].id, 76);
    const TagPoses found = FindTagPoses(camera, tags[0].corners_px, 0.065);
    ASSERT_FALSE(found.poses.empty());
    EXPECT_FALSE(found.is_ambiguous);
    poses.push_back(found.poses[0].cam_from_tag);
  }
  const auto turned_deg = [&](size_t k) {
    return kDegFromRad *
           Eigen::AngleAxisd(poses[0].linear().transpose() * poses[k].linear()).angle();
  };
  RecordProperty("turned by 40", std::to_string(turned_deg(1)));
  RecordProperty("turned by 30", std::to_string(turned_deg(2)));
  EXPECT_NEAR(turned_deg(1), 40.0, 3.0);
  EXPECT_NEAR(turned_deg(2), 30.0, 3.0);
  // It turns about itself: it stays where it is.
  for (const size_t k : {1, 2})
    EXPECT_LT((poses[k].translation() - poses[0].translation()).norm(), 0.01);
}

TEST(RealTagsTest, SeveralTagsAndAHeldBoardAreFoundInEveryFrame) {
  POSELIFT_DATA_OR_SKIP(data);
  TagDetector detector(TagFamily("tag36h11"), {});
  EXPECT_EQ(detector.Detect(ReadGrey(data / "tags/duckietown/test_image_multiple_01.png")).size(),
            6U);
  EXPECT_EQ(detector.Detect(ReadGrey(data / "tags/duckietown/test_image_multiple_05.png")).size(),
            4U);
  for (int k = 0; k < 10; ++k) {
    const std::string name = "clipboard0" + std::to_string(k) + ".png";
    EXPECT_GE(detector.Detect(ReadGrey(data / "tags/clipboard" / name)).size(), 14U) << name;
  }
}

}  // namespace
}  // namespace poselift
