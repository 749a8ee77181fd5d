// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Pictures of random texture are moved by a motion that is known at any time, to
// fractions of a pixel and not along lines, so that every label has its truth.
// Real: the flow. Painted: everything it sees, with noise of a camera. The last
// test leaves out every second of the labels that a person made in a real video.
#include "src/label_propagation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "src/input_error.h"
#include "src/io/labels.h"
#include "src/io/video.h"
#include "src/observation.h"
#include "tests/support/made_up_video.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Eigen::Vector2d;
using testing::PaintedVideo;
using testing::TestRng;

constexpr double kFrame_s = 1.0 / 30.0;
const cv::Size kSize_px(400, 320);

std::vector<double> Times(int count) {
  std::vector<double> times_s;
  for (int i = 0; i < count; ++i) times_s.push_back(i * kFrame_s);
  return times_s;
}

// Turns, grows and swings about the middle of the picture.
Eigen::Affine2d Motion(double time_s) {
  const Vector2d centre(kSize_px.width / 2.0, kSize_px.height / 2.0);
  Eigen::Affine2d motion = Eigen::Affine2d::Identity();
  motion.translate(centre + Vector2d(30.0 * std::sin(4.0 * time_s), 12.0 * std::cos(7.0 * time_s)));
  motion.rotate(0.25 * std::sin(3.0 * time_s));
  motion.scale(1.0 + 0.1 * std::sin(2.0 * time_s));
  motion.translate(-centre);
  return motion;
}

// The texture under the motion, with a camera's noise.
class MovingTexture {
 public:
  MovingTexture() : texture_(testing::Texture(kSize_px * 2, &rng_)) {}

  cv::Mat operator()(double time_s) {
    const Eigen::Affine2d motion =
        Motion(time_s) * Eigen::Translation2d(-kSize_px.width / 2.0, -kSize_px.height / 2.0);
    const cv::Matx23d matrix(motion(0, 0), motion(0, 1), motion(0, 2), motion(1, 0), motion(1, 1),
                             motion(1, 2));
    cv::Mat picture, noise(kSize_px, CV_16SC3);
    cv::warpAffine(texture_, picture, matrix, kSize_px, cv::INTER_CUBIC);
    cv::theRNG().state = static_cast<uint64_t>(time_s * 1e6) + 1;
    cv::randn(noise, 0.0, 2.0);
    cv::add(picture, noise, picture, cv::noArray(), CV_8U);
    return picture;
  }

 private:
  std::mt19937_64 rng_ = TestRng();
  cv::Mat texture_;
};

const std::vector<std::string> kNames = {"neck",       "pelvis",     "left_knee",
                                         "left_elbow", "right_knee", "head_top"};

Vector2d Start_px(size_t landmark) {
  const std::vector<Vector2d> starts = {{200, 100}, {180, 190}, {250, 210},
                                        {150, 140}, {230, 150}, {205, 60}};
  return starts[landmark];
}

Vector2d Truth_px(size_t landmark, double time_s) { return Motion(time_s) * Start_px(landmark); }

FrameLabels KeyAt(int frame) {
  FrameLabels key;
  key.frame = frame;
  PersonLabels& person = key.people.emplace_back();
  for (size_t l = 0; l < kNames.size(); ++l)
    person.landmarks.push_back(
        {kNames[l], Truth_px(l, frame * kFrame_s), LabelState::kVisible, 1.0});
  return key;
}

Labels KeysAt(const std::vector<int>& frames) {
  Labels keys{"body15", {}};
  for (const int frame : frames) keys.frames.push_back(KeyAt(frame));
  return keys;
}

// What Observe takes for the standard deviation of an axis.
double Sigma_px(const LandmarkLabel& label) {
  const double factor =
      label.state == LabelState::kOccluded ? ObserveOptions().occluded_sigma_factor : 1.0;
  return factor * label.radius_px.value();
}

const FrameLabels& FrameOf(const Labels& labels, int frame) {
  for (const FrameLabels& found : labels.frames)
    if (found.frame == frame) return found;
  throw std::logic_error("no such frame");
}

const LandmarkLabel& LabelOf(const Labels& labels, int frame, const std::string& name) {
  for (const LandmarkLabel& label : FrameOf(labels, frame).people.at(0).landmarks)
    if (label.name == name) return label;
  throw std::logic_error("no such landmark");
}

TEST(LabelPropagation, FollowsMotionToFractionsOfAPixel) {
  PaintedVideo video(Times(21), MovingTexture());
  const Labels labels = PropagateLabels(KeysAt({0, 20}), &video);
  ASSERT_EQ(labels.frames.size(), 21u);
  double worst_px = 0.0, worst_line_px = 0.0;
  for (int f = 0; f <= 20; ++f) {
    const double time_s = f * kFrame_s;
    EXPECT_EQ(labels.frames[static_cast<size_t>(f)].frame, f);
    EXPECT_DOUBLE_EQ(labels.frames[static_cast<size_t>(f)].time_s.value(), time_s);
    for (size_t l = 0; l < kNames.size(); ++l) {
      const LandmarkLabel& label = LabelOf(labels, f, kNames[l]);
      EXPECT_EQ(label.state, LabelState::kVisible);
      worst_px = std::max(worst_px, (label.x_px - Truth_px(l, time_s)).norm());
      const Vector2d line_px =
          (1.0 - f / 20.0) * Truth_px(l, 0.0) + f / 20.0 * Truth_px(l, 20 * kFrame_s);
      worst_line_px = std::max(worst_line_px, (line_px - Truth_px(l, time_s)).norm());
    }
  }
  EXPECT_LT(worst_px, 0.7);
  EXPECT_GT(worst_line_px, 15.0);  // so it was not the line
}

TEST(LabelPropagation, LeadsBothWaysFromOneFrameAsFarAsItMay) {
  PaintedVideo video(Times(60), MovingTexture());
  PropagationOptions options;
  options.max_gap_s = 10.5 * kFrame_s;
  const Labels labels = PropagateLabels(KeysAt({30}), &video, options);
  ASSERT_EQ(labels.frames.size(), 21u);
  EXPECT_EQ(labels.frames.front().frame, 20);
  EXPECT_EQ(labels.frames.back().frame, 40);
  EXPECT_LE(video.num_read(), 43u);  // no farther than needed
  for (const FrameLabels& frame : labels.frames)
    for (size_t l = 0; l < kNames.size(); ++l)
      EXPECT_LT((frame.people[0].landmarks[l].x_px - Truth_px(l, *frame.time_s)).norm(), 2.0);
  const auto sigma = [&](int f) { return Sigma_px(LabelOf(labels, f, "neck")); };
  EXPECT_LT(sigma(31), sigma(35));
  EXPECT_LT(sigma(35), sigma(40));
  EXPECT_LT(sigma(29), sigma(20));
}

TEST(LabelPropagation, LeavesAGapTooLongEmptyInItsMiddle) {
  PaintedVideo video(Times(41), MovingTexture());
  PropagationOptions options;
  options.max_gap_s = 10.5 * kFrame_s;
  const Labels labels = PropagateLabels(KeysAt({0, 40}), &video, options);
  ASSERT_EQ(labels.frames.size(), 41u);
  for (int f = 0; f <= 40; ++f) EXPECT_EQ(FrameOf(labels, f).people.empty(), f > 10 && f < 30) << f;
}

TEST(LabelPropagation, KeyFramesStayAsTheyAre) {
  PaintedVideo video(Times(21), MovingTexture());
  Labels keys = KeysAt({5, 15});
  keys.frames[0].image = "a.mp4";
  keys.frames[1].people[0].landmarks[2].state = LabelState::kOccluded;
  const Labels labels = PropagateLabels(keys, &video);
  for (size_t k = 0; k < 2; ++k) {
    const FrameLabels& key = keys.frames[k];
    const FrameLabels& kept = FrameOf(labels, *key.frame);
    EXPECT_EQ(kept.width_px, kSize_px.width);
    EXPECT_EQ(kept.height_px, kSize_px.height);
    for (size_t l = 0; l < kNames.size(); ++l) {
      EXPECT_EQ(kept.people[0].landmarks[l].x_px, key.people[0].landmarks[l].x_px);
      EXPECT_EQ(kept.people[0].landmarks[l].state, key.people[0].landmarks[l].state);
      EXPECT_EQ(kept.people[0].landmarks[l].radius_px, key.people[0].landmarks[l].radius_px);
    }
  }
  EXPECT_EQ(FrameOf(labels, 7).image, "a.mp4");
}

// A label that slides over the texture, as joints do under skin and cloth.
TEST(LabelPropagation, DriftIsSetRightAndWidensTheRadius) {
  Labels keys = KeysAt({0, 20});
  const Vector2d slid_px(9.0, -6.0);
  keys.frames[1].people[0].landmarks[0].x_px += slid_px;
  PaintedVideo video(Times(21), MovingTexture());
  const Labels labels = PropagateLabels(keys, &video);
  for (int f = 1; f < 20; ++f) {
    const LandmarkLabel& label = LabelOf(labels, f, kNames[0]);
    const Vector2d truth_px = Truth_px(0, f * kFrame_s) + f / 20.0 * slid_px;
    EXPECT_LT((label.x_px - truth_px).norm(), 1.5) << f;
  }
  EXPECT_GT(Sigma_px(LabelOf(labels, 10, kNames[0])),
            1.5 * Sigma_px(LabelOf(labels, 10, kNames[1])));
}

// From frame 6 to 12 a grey disc without texture covers the pelvis.
cv::Mat WithDisc(MovingTexture* texture, double time_s) {
  cv::Mat picture = (*texture)(time_s);
  const int frame = static_cast<int>(std::lround(time_s / kFrame_s));
  const Vector2d x_px = Truth_px(1, time_s);
  if (frame >= 6 && frame <= 12)
    cv::circle(picture, cv::Point2d(x_px.x(), x_px.y()), 32, cv::Scalar::all(128), cv::FILLED);
  return picture;
}

TEST(LabelPropagation, WhatIsCoveredIsGuessedBetweenTheKeyFrames) {
  MovingTexture texture;
  PaintedVideo video(Times(19), [&](double time_s) { return WithDisc(&texture, time_s); });
  PropagationOptions options;
  options.max_sigma = 1.0;
  const Labels labels = PropagateLabels(KeysAt({0, 18}), &video, options);
  for (const int f : {3, 15}) {
    const LandmarkLabel& label = LabelOf(labels, f, "pelvis");
    EXPECT_EQ(label.state, LabelState::kVisible);
    EXPECT_LT((label.x_px - Truth_px(1, f * kFrame_s)).norm(), 2.0);
  }
  const LandmarkLabel& covered = LabelOf(labels, 9, "pelvis");
  EXPECT_EQ(covered.state, LabelState::kOccluded);
  EXPECT_LT((covered.x_px - Truth_px(1, 9 * kFrame_s)).norm(), 2.0 * Sigma_px(covered));
  EXPECT_GT(Sigma_px(covered), 2.0 * Sigma_px(LabelOf(labels, 3, "pelvis")));
  EXPECT_EQ(LabelOf(labels, 9, "neck").state, LabelState::kVisible);
}

TEST(LabelPropagation, WhatIsKnownTooBadlyIsAbsent) {
  MovingTexture texture;
  PaintedVideo video(Times(19), [&](double time_s) { return WithDisc(&texture, time_s); });
  PropagationOptions options;
  options.max_sigma = 0.02;
  const Labels labels = PropagateLabels(KeysAt({0, 18}), &video, options);
  EXPECT_EQ(LabelOf(labels, 9, "pelvis").state, LabelState::kAbsent);
  EXPECT_EQ(LabelOf(labels, 9, "neck").state, LabelState::kVisible);
}

TEST(LabelPropagation, WhatIsOccludedAtAKeyFrameIsNotFollowed) {
  Labels keys = KeysAt({0, 10});
  for (FrameLabels& key : keys.frames) key.people[0].landmarks[3].state = LabelState::kOccluded;
  PaintedVideo video(Times(11), MovingTexture());
  const Labels labels = PropagateLabels(keys, &video);
  const LandmarkLabel& label = LabelOf(labels, 5, kNames[3]);
  EXPECT_EQ(label.state, LabelState::kOccluded);
  EXPECT_LT((label.x_px - (Truth_px(3, 0.0) + Truth_px(3, 10 * kFrame_s)) / 2.0).norm(), 1e-6);
}

TEST(LabelPropagation, WhatLeavesThePictureIsLost) {
  // A label at the right border, which the motion carries out of the picture.
  Labels keys = KeysAt({0});
  const Vector2d start_px = Motion(0.0).inverse() * Vector2d(396.0, 160.0);
  keys.frames[0].people[0].landmarks[4].x_px = Motion(0.0) * start_px;
  PaintedVideo video(Times(8), MovingTexture());
  const Labels labels = PropagateLabels(keys, &video);
  ASSERT_GT((Motion(7 * kFrame_s) * start_px).x(), kSize_px.width + 5.0);
  EXPECT_EQ(LabelOf(labels, 7, kNames[4]).state, LabelState::kAbsent);
  EXPECT_EQ(LabelOf(labels, 7, kNames[0]).state, LabelState::kVisible);
}

TEST(LabelPropagation, PeopleAreToldByTheirIds) {
  Labels keys = KeysAt({0, 10});
  for (FrameLabels& key : keys.frames) {
    PersonLabels& first = key.people[0];
    first.id = 7;
    PersonLabels second{3, {first.landmarks.begin() + 3, first.landmarks.end()}};
    first.landmarks.resize(3);
    key.people.push_back(second);
  }
  std::swap(keys.frames[1].people[0], keys.frames[1].people[1]);
  PaintedVideo video(Times(11), MovingTexture());
  const Labels labels = PropagateLabels(keys, &video);
  const FrameLabels& frame = FrameOf(labels, 5);
  ASSERT_EQ(frame.people.size(), 2u);
  EXPECT_EQ(frame.people[0].id, 7);
  ASSERT_EQ(frame.people[0].landmarks.size(), 3u);
  EXPECT_LT((frame.people[0].landmarks[0].x_px - Truth_px(0, 5 * kFrame_s)).norm(), 1.0);
  EXPECT_LT((frame.people[1].landmarks[0].x_px - Truth_px(3, 5 * kFrame_s)).norm(), 1.0);
}

// Labels as people click them, sliding over the texture at random: the errors
// must be what the radius says, neither larger nor far smaller.
TEST(LabelPropagation, RadiusIsTheErrorToExpect) {
  auto rng = TestRng();
  std::normal_distribution<double> normal;
  constexpr double kClick_px = 1.5, kSlide_px = 0.8;  // standard deviations; a slide is a step's
  int num = 0, num_within = 0, num_far_within = 0;
  MovingTexture texture;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<std::vector<Vector2d>> slid(kNames.size(), {Vector2d::Zero()});
    for (auto& path : slid)
      for (int f = 1; f <= 15; ++f)
        path.push_back(path.back() + kSlide_px * Vector2d(normal(rng), normal(rng)));
    Labels keys = KeysAt({0, 15});
    for (FrameLabels& key : keys.frames)
      for (size_t l = 0; l < kNames.size(); ++l) {
        LandmarkLabel& label = key.people[0].landmarks[l];
        label.x_px += slid[l][static_cast<size_t>(*key.frame)];
        label.x_px += kClick_px * Vector2d(normal(rng), normal(rng));
        label.radius_px = kClick_px;
      }
    PaintedVideo video(Times(16), std::ref(texture));
    const Labels labels = PropagateLabels(keys, &video);
    for (int f = 3; f <= 12; f += 3)
      for (size_t l = 0; l < kNames.size(); ++l) {
        const LandmarkLabel& label = LabelOf(labels, f, kNames[l]);
        const Vector2d truth_px = Truth_px(l, f * kFrame_s) + slid[l][static_cast<size_t>(f)];
        const double error_px = (label.x_px - truth_px).norm();
        ++num;
        num_within += error_px < 2.0 * Sigma_px(label) ? 1 : 0;
        num_far_within += error_px < 0.5 * Sigma_px(label) ? 1 : 0;
      }
  }
  // Of a normal error in the plane 86 % and 12 %.
  EXPECT_GT(num_within, 0.8 * num);
  EXPECT_LT(num_far_within, 0.4 * num);
}

TEST(LabelPropagation, RefusesKeysThatAreNone) {
  PaintedVideo video(Times(5), MovingTexture());
  Labels keys = KeysAt({0});
  keys.frames[0].frame.reset();
  EXPECT_THROW(PropagateLabels(keys, &video), std::invalid_argument);
  EXPECT_THROW(PropagateLabels(KeysAt({3, 1}), &video), std::invalid_argument);
  EXPECT_THROW(PropagateLabels(KeysAt({2, 2}), &video), std::invalid_argument);
  EXPECT_THROW(PropagateLabels(KeysAt({2, 9}), &video), InputError);
}

TEST(LabelPropagation, OptionsSayWhatIsWrong) {
  PropagationOptions options;
  EXPECT_EQ(options.Validate(), "");
  options.max_gap_s = NAN;
  EXPECT_NE(options.Validate().find("max_gap_s"), std::string::npos);
  options = {};
  options.flow.window = 0.0;
  EXPECT_NE(options.Validate().find("window"), std::string::npos);
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// 20 frames, two thirds of a second and a whole step, from key to key.
TEST(LabelPropagation, FindsTheLabelsThatWereLeftOutOfARealVideo) {
  POSELIFT_DATA_OR_SKIP(data);
  const auto path = data / "photos" / "walk-side.mp4";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "real video absent: " << path;
  const Labels all = ReadLabels(testing::SourcePath("samples/walk/walk-side.labels.json"));
  Labels keys{all.layout, {}};
  for (size_t k = 0; k < all.frames.size(); k += 2) keys.frames.push_back(all.frames[k]);
  VideoFile video(path);
  const Labels labels = PropagateLabels(keys, &video);
  std::vector<double> errors_px, line_errors_px;
  size_t within = 0;
  for (size_t k = 1; k + 1 < all.frames.size(); k += 2)
    for (size_t l = 0; l < all.frames[k].people[0].landmarks.size(); ++l) {
      const auto label_at = [&](size_t f) { return all.frames[f].people[0].landmarks[l]; };
      const LandmarkLabel truth = label_at(k);
      const LandmarkLabel& found = LabelOf(labels, *all.frames[k].frame, truth.name);
      if (truth.state != LabelState::kVisible || found.state == LabelState::kAbsent) continue;
      errors_px.push_back((found.x_px - truth.x_px).norm());
      line_errors_px.push_back(
          ((label_at(k - 1).x_px + label_at(k + 1).x_px) / 2.0 - truth.x_px).norm());
      within += errors_px.back() < 2.0 * Sigma_px(found) ? 1 : 0;
    }
  std::printf(
      "%zu labels left out: median error %.1f px, of the line %.1f px, %.0f %% within 2 "
      "sigma\n",
      errors_px.size(), Median(errors_px), Median(line_errors_px),
      100.0 * static_cast<double>(within) / static_cast<double>(errors_px.size()));
  EXPECT_GT(errors_px.size(), 35u);
  EXPECT_LT(Median(errors_px), 8.0);
  EXPECT_LT(Median(errors_px), 0.5 * Median(line_errors_px));
  EXPECT_GT(static_cast<double>(within), 0.85 * static_cast<double>(errors_px.size()));
}

}  // namespace
}  // namespace poselift
