// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The program on a few frames of real motion, with the default dictionary.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/mutation.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using nlohmann::json;
using testing::FileText;
using ::testing::HasSubstr;
using testing::ProgramRun;
using testing::RunProgram;
using testing::ScratchDir;

std::string Arguments(const std::filesystem::path& data) {
  return "evaluate sequence --trials 07_05 --train 01,05 --frames 14 --noise-px 3 --dictionary " +
         testing::SourcePath("data/default.pldict").string() + " --mocap " +
         (data / "mocap" / "cmu").string();
}

TEST(EvaluateSequence, WritesTheTableItPrints) {
  POSELIFT_DATA_OR_SKIP(data);
  const ProgramRun run = RunProgram(Arguments(data) + " --json out.json --plots plots");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("1 trials, 14 frames at 30 Hz"));
  const json report = json::parse(FileText(ScratchDir() / "out.json"));
  EXPECT_EQ(report["command"], "evaluate sequence");
  EXPECT_EQ(report["data"], "cmu");
  EXPECT_EQ(report["split"]["test_trials"], json({"07_05"}));
  EXPECT_EQ(report["rows"].size(), report["trials"].size());
  EXPECT_EQ(report["rows"][0]["method"], "true joints");
  EXPECT_EQ(report["rows"][0]["root_mm"], 0.0);
  double alone_jitter_mm = 0.0, filtered_jitter_mm = 0.0;
  for (const json& row : report["rows"]) {
    EXPECT_THAT(run.out, HasSubstr(row["method"].get<std::string>()));
    if (row["method"] == "each frame alone") alone_jitter_mm = row["jitter_mm"];
    if (row["method"] == "Butterworth 3 Hz") filtered_jitter_mm = row["jitter_mm"];
  }
  EXPECT_GT(filtered_jitter_mm, 0.0);
  EXPECT_LT(filtered_jitter_mm, 0.5 * alone_jitter_mm);
  EXPECT_TRUE(exists(ScratchDir() / "plots" / "sequence_3px_mm.svg"));
  EXPECT_TRUE(exists(ScratchDir() / "plots" / "sequence_3px_07_05.svg"));
}

TEST(EvaluateSequence, RefusesTrialsThatAreNotThere) {
  POSELIFT_DATA_OR_SKIP(data);
  const ProgramRun run =
      RunProgram("evaluate sequence --trials 07_77 --mocap " + (data / "mocap" / "cmu").string());
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.err, HasSubstr("07_77"));
}

TEST(EvaluateSequence, WantsFramesEnoughForALag) {
  EXPECT_EQ(RunProgram("evaluate sequence --mocap . --frames 11").code, 2);
}

}  // namespace
}  // namespace poselift
