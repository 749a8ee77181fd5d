// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up rows of results.
#include "ui/cli/sequence_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/planted_walk.h"

namespace poselift::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Motion Walk() { return testing::PlantWalk(20, 0.6, 0.0).motion; }

SequenceEvaluation Row(const char* method, const char* trial, double noise_px, double cam_mm) {
  SequenceEvaluation row{method, trial, noise_px};
  row.errors[measure::kCam_mm] = cam_mm;
  row.poses = Walk().frames;
  return row;
}

SequenceReport TwoMethods() {
  return SequenceReport({Row("true joints", "a", 5.0, 0.0), Row("alone", "a", 5.0, 80.0),
                         Row("alone", "b", 5.0, 100.0), Row("alone", "c", 5.0, 90.0),
                         Row("filtered", "a", 5.0, 70.0), Row("filtered", "b", 5.0, 60.0),
                         Row("alone", "a", 2.0, 50.0)});
}

TEST(SequenceReport, TrialsCountTheSame) {
  const SequenceMean mean = TwoMethods().MeanOf("alone", 5.0);
  EXPECT_NEAR(mean.mean[measure::kCam_mm], 90.0, 1e-12);
  EXPECT_NEAR(mean.standard_error[measure::kCam_mm], 10.0 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(TwoMethods().MeanOf("alone", 2.0).mean[measure::kCam_mm], 50.0, 1e-12);
  EXPECT_EQ(TwoMethods().MeanOf("alone", 2.0).standard_error[measure::kCam_mm], 0.0);
}

TEST(SequenceReport, TheBestIsNoTruthAndNoneThatIsLeftOut) {
  EXPECT_EQ(TwoMethods().Best(5.0, {}), "filtered");
  EXPECT_EQ(TwoMethods().Best(5.0, {"filtered"}), "alone");
  EXPECT_EQ(TwoMethods().Best(5.0, {"filtered", "alone"}), "");
  EXPECT_EQ(TwoMethods().Best(2.0, {}), "alone");
}

TEST(SequenceReport, DrawsTrialsAndTheirMean) {
  const std::string svg = TwoMethods().Chart({"alone", "filtered"}, 5.0);
  for (const char* text : {">a<", ">b<", ">c<", ">mean<", ">alone<", ">filtered<", "5 px"})
    EXPECT_THAT(svg, HasSubstr(text));
}

TEST(SequenceReport, PlotsTheMethodsThatLiftedTheTrial) {
  const SequenceTrial trial{"b", Walk(), Walk()};
  const std::string svg =
      TwoMethods().Plot({"alone", "never run"}, 5.0, trial, "left_knee.flexion");
  for (const char* text : {">alone<", ">truth<", "left_knee.flexion"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("never run")));
}

}  // namespace
}  // namespace poselift::cli
