// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up rows of results.
#include "ui/cli/motion_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/input_error.h"
#include "ui/cli/motion_experiment.h"

namespace poselift::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MotionEvaluation Row(const char* method, const char* action, double position_mm) {
  return {method, action, "trial", "6", 10, position_mm, 0.1 * position_mm, 1.0, 2.0};
}

MotionReport TwoActions() {
  return MotionReport({Row("a", "walking", 10.0), Row("a", "walking", 20.0),
                       Row("a", "walking", 30.0), Row("a", "golf", 100.0), Row("b", "walking", 7.0),
                       Row("b", "golf", 9.0)});
}

TEST(MotionReport, TrialsCountTheSameInAnActionAndActionsInTheMean) {
  const MotionReport report = TwoActions();
  EXPECT_NEAR(report.MeanOf("a", "6", "walking").position_mm, 20.0, 1e-12);
  EXPECT_NEAR(report.MeanOf("a", "6").position_mm, 60.0, 1e-12);
  EXPECT_NEAR(report.MeanOf("a", "6").angle_deg, 6.0, 1e-12);
  EXPECT_NEAR(report.MeanOf("b", "6").ms_per_frame, 2.0, 1e-12);
  EXPECT_TRUE(report.HasPoints("6"));
  EXPECT_FALSE(report.HasPoints("4"));
}

TEST(MotionReport, DrawsTheMethodsThatWereRun) {
  const std::string svg = TwoActions().Chart({"a", "b", "never run"}, "6", true);
  for (const char* text : {">a<", ">b<", ">walking<", ">golf<", ">degrees<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("never run")));
  EXPECT_THROW(TwoActions().Chart({"never run"}, "6", false), InputError);
}

// A trial that is looked at to choose settings is no test of them.
TEST(PaperActions, HeldOutTrialsAreNoTestTrials) {
  for (const Action& action : PaperActions())
    for (const Action& other : PaperActions())
      for (const std::string& trial : action.trials)
        EXPECT_THAT(other.held_out, Not(::testing::Contains(trial)));
}

}  // namespace
}  // namespace poselift::cli
