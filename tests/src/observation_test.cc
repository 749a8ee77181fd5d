// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up labels in every layout: what is observed, with what weight.
#include "src/observation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

namespace poselift {
namespace {

using ::testing::HasSubstr;

// Every landmark of a layout, spread over 400 x 800 px.
PersonLabels AllLabels(const Layout& layout) {
  PersonLabels labels;
  const auto count = layout.landmarks.size();
  for (size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    labels.landmarks.push_back(
        {std::string(layout.landmarks[i].name), {400.0 * share, 800.0 * share}});
  }
  return labels;
}

const ObservedPoint& Point(const Observation& observation, std::string_view name) {
  for (const ObservedPoint& point : observation.points)
    if (point.name == name) return point;
  throw std::out_of_range(std::string(name));
}

TEST(Layouts, WeightsOfALandmarkSumToOneOverJointsThatExist) {
  for (const Layout& layout : AllLayouts())
    for (const Landmark& landmark : layout.landmarks) {
      if (landmark.parts.empty()) continue;
      double sum = 0.0;
      for (const auto& [joint, weight] : landmark.parts) {
        EXPECT_GE(joint, 0);
        EXPECT_LT(joint, kNumJoints);
        EXPECT_NE(weight, 0.0);
        EXPECT_LT(std::abs(weight), 2.0);  // no far extrapolation
        sum += weight;
      }
      EXPECT_NEAR(sum, 1.0, 1e-14) << layout.name << " " << landmark.name;
      EXPECT_GE(landmark.offset_sigma_m, 0.0);
    }
}

TEST(Layouts, NamesAreDifferentAndFound) {
  for (const Layout& layout : AllLayouts()) {
    EXPECT_EQ(FindLayout(layout.name), &layout);
    std::set<std::string_view> names;
    for (size_t i = 0; i < layout.landmarks.size(); ++i) {
      EXPECT_TRUE(names.insert(layout.landmarks[i].name).second);
      EXPECT_EQ(layout.Find(layout.landmarks[i].name), static_cast<int>(i));
    }
    EXPECT_EQ(layout.Find("tail"), std::nullopt);
  }
  EXPECT_EQ(FindLayout("body16"), nullptr);
}

TEST(Layouts, LeftAndRightAreMirrored) {
  for (const Layout& layout : AllLayouts())
    for (const Landmark& left : layout.landmarks) {
      if (!left.name.starts_with("left_")) continue;
      const auto right = layout.Find("right_" + std::string(left.name.substr(5)));
      ASSERT_TRUE(right) << left.name;
      const Landmark& mirrored = layout.landmarks[*right];
      ASSERT_EQ(mirrored.parts.size(), left.parts.size());
      for (size_t i = 0; i < left.parts.size(); ++i) {
        EXPECT_EQ(mirrored.parts[i].joint, Joints()[left.parts[i].joint].mirror);
        EXPECT_EQ(mirrored.parts[i].weight, left.parts[i].weight);
      }
      EXPECT_EQ(mirrored.offset_sigma_m, left.offset_sigma_m);
    }
}

TEST(Observe, TakesEveryLandmarkThatIsASumOfJoints) {
  for (const Layout& layout : AllLayouts()) {
    const Observation observation = Observe(AllLabels(layout), layout);
    size_t expected = 0;
    for (const Landmark& landmark : layout.landmarks)
      if (!landmark.parts.empty()) ++expected;
    EXPECT_EQ(observation.points.size(), expected);
    EXPECT_EQ(observation.Count(ObservedPoint::Kind::k2D), static_cast<int>(expected));
    EXPECT_EQ(observation.Count(ObservedPoint::Kind::k3D), 0);
    for (const ObservedPoint& point : observation.points) {
      EXPECT_GT(point.sigma, 0.0);
      EXPECT_EQ(point.x.z(), 0.0);
      EXPECT_EQ(point.x.y(), 2.0 * point.x.x());
    }
  }
}

TEST(Observe, LeavesOutWhatIsAbsentOrUnknown) {
  const Layout& layout = *FindLayout("body15");
  PersonLabels labels = AllLabels(layout);
  labels.landmarks[2].state = LabelState::kAbsent;
  labels.landmarks[2].x_px.setConstant(std::nan(""));
  labels.landmarks[3].name = "left_antenna";
  const Observation observation = Observe(labels, layout);
  EXPECT_EQ(observation.points.size(), 13u);
  for (const ObservedPoint& point : observation.points) {
    EXPECT_NE(point.name, "head_top");
    EXPECT_NE(point.name, "left_antenna");
    EXPECT_TRUE(std::isfinite(point.sigma));
  }
}

TEST(Observe, AbsentLabelsDoNotStretchTheBody) {
  const Layout& layout = *FindLayout("body15");
  PersonLabels labels = AllLabels(layout);
  const double sigma = Point(Observe(labels, layout), "pelvis").sigma;
  PersonLabels with_absent = labels;
  with_absent.landmarks[1].state = LabelState::kAbsent;
  with_absent.landmarks[1].x_px << 1e9, -1e9;
  EXPECT_EQ(Point(Observe(with_absent, layout), "pelvis").sigma, sigma);
}

TEST(Observe, SigmaIsAShareOfTheExtentOrTheLabelsOwn) {
  const Layout& layout = *FindLayout("body15");
  PersonLabels labels = AllLabels(layout);
  labels.landmarks[0].radius_px = 7.5;
  const Observation observation = Observe(labels, layout, {.relative_sigma = 0.02});
  EXPECT_NEAR(Point(observation, "pelvis").sigma, 7.5, 1e-12);
  EXPECT_NEAR(Point(observation, "left_knee").sigma, 0.02 * 800.0, 1e-12);
}

TEST(Observe, OccludedLabelsWeighLess) {
  const Layout& layout = *FindLayout("body15");
  PersonLabels labels = AllLabels(layout);
  const double visible = Point(Observe(labels, layout), "left_knee").sigma;
  labels.landmarks[*layout.Find("left_knee")].state = LabelState::kOccluded;
  const Observation observation = Observe(labels, layout, {.occluded_sigma_factor = 4.0});
  EXPECT_NEAR(Point(observation, "left_knee").sigma, 4.0 * visible, 1e-12);
  EXPECT_EQ(Point(observation, "left_knee").state, LabelState::kOccluded);
  EXPECT_NEAR(Point(observation, "right_knee").sigma, visible, 1e-12);
}

TEST(Observe, LandmarksBesideTheirJointsWeighLess) {
  const Layout& layout = *FindLayout("coco17");
  const Observation observation = Observe(AllLabels(layout), layout);
  const double joint = Point(observation, "left_knee").sigma;
  const double ear = Point(observation, "left_ear").sigma;
  const double offset_px = layout.landmarks[*layout.Find("left_ear")].offset_sigma_m * 800.0 / 1.6;
  EXPECT_NEAR(ear, std::hypot(joint, offset_px), 1e-9);
}

TEST(Observe, NoRadiusMakesAWeightInfinite) {
  const Layout& layout = *FindLayout("body15");
  for (const double radius : {0.0, -3.0, 1e-300, std::nan("")}) {
    PersonLabels labels = AllLabels(layout);
    for (LandmarkLabel& label : labels.landmarks) label.radius_px = radius;
    for (const ObservedPoint& point : Observe(labels, layout).points)
      EXPECT_GE(point.sigma, 0.1) << radius;
  }
}

TEST(Observe, NoLabelsAreNoPoints) {
  EXPECT_TRUE(Observe({}, *FindLayout("body15")).points.empty());
}

TEST(ObservePose, TakesTheJointsThatAreThere) {
  Pose3 joints = Pose3::Random(3, kNumJoints);
  joints.col(4).setConstant(std::nan(""));
  joints(1, 9) = std::nan("");
  const Observation observation = ObservePose(joints, 0.02);
  EXPECT_EQ(observation.points.size(), 21u);
  EXPECT_EQ(observation.Count(ObservedPoint::Kind::k3D), 21);
  for (const ObservedPoint& point : observation.points) {
    ASSERT_EQ(point.parts.size(), 1u);
    EXPECT_EQ(point.x, joints.col(point.parts[0].joint));
    EXPECT_EQ(point.parts[0].weight, 1.0);
    EXPECT_EQ(point.sigma, 0.02);
  }
}

TEST(ObserveOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(ObserveOptions().Validate(), "");
  EXPECT_THAT(ObserveOptions{.relative_sigma = 0}.Validate(), HasSubstr("relative_sigma = 0"));
  EXPECT_THAT(ObserveOptions{.occluded_sigma_factor = 0.5}.Validate(),
              HasSubstr("occluded_sigma_factor = 0.5"));
}

}  // namespace
}  // namespace poselift
