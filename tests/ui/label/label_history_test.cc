// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the history and all edits. Made up: the labels. Properties: over random sequences undo and
// redo are each other's inverse, to the last bit, and undoing all leads to the first labels; edits
// that labels cannot hold are refused and change nothing.
#include "ui/label/label_history.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

#include "src/input_error.h"
#include "tests/support/random_labels.h"
#include "ui/label/label_edits.h"

namespace poselift {
namespace {

using testing::ExactText;
using testing::SomeLabels;

LabelHistory AfterSteps(const std::vector<std::uint32_t>& seeds) {
  LabelHistory history(SomeLabels());
  for (const std::uint32_t seed : seeds) testing::TakeRandomStep(seed, &history);
  return history;
}

TEST(LabelHistory, UndoThenRedoIsIdentity) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint32_t>& seeds) {
    LabelHistory history = AfterSteps(seeds);
    std::vector<std::string> texts = {ExactText(history)};
    std::vector<std::uint64_t> states = {history.state()};
    while (history.Undo()) {
      texts.push_back(ExactText(history));
      states.push_back(history.state());
    }
    RC_ASSERT(ExactText(history.labels()) == ExactText(SomeLabels()));
    RC_ASSERT(history.state() == 0u);
    for (size_t i = texts.size() - 1; i-- > 0;) {
      RC_ASSERT(history.Redo());
      RC_ASSERT(ExactText(history) == texts[i]);
      RC_ASSERT(history.state() == states[i]);
    }
  }));
}

TEST(LabelHistory, EveryStateHasItsOwnNumber) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint32_t>& seeds) {
    LabelHistory history(SomeLabels());
    std::map<std::uint64_t, std::string> labels_of_state = {{0, ExactText(SomeLabels())}};
    for (const std::uint32_t seed : seeds) {
      testing::TakeRandomStep(seed, &history);
      const std::string text = ExactText(history.labels());
      RC_ASSERT(labels_of_state.try_emplace(history.state(), text).first->second == text);
    }
  }));
}

TEST(LabelHistory, NamesTheStepsThatCanBeTaken) {
  LabelHistory history(SomeLabels());
  EXPECT_FALSE(history.CanUndo());
  EXPECT_EQ(history.UndoName(), "");
  EXPECT_FALSE(history.Undo());
  history.Apply(PlaceLandmark(history.labels(), {0, 0}, "left_knee", {3.0, 4.0}));
  EXPECT_EQ(history.UndoName(), "place left knee");
  EXPECT_EQ(history.RedoName(), "");
  EXPECT_FALSE(history.Redo());
  history.Undo();
  EXPECT_EQ(history.RedoName(), "place left knee");
  EXPECT_EQ(history.NumSteps(), 0u);
}

TEST(LabelHistory, AnEditAfterUndoEndsWhatCouldBeDoneAgain) {
  LabelHistory history(SomeLabels());
  history.Apply(AddPerson(history.labels(), {0, 1}));
  history.Undo();
  history.Apply(AddPerson(history.labels(), {0, 2}));
  EXPECT_FALSE(history.CanRedo());
  EXPECT_EQ(history.steps().all().size(), 1u);
}

TEST(LabelHistory, NudgesInARowAreOneStep) {
  LabelHistory history(SomeLabels());
  history.Apply(PlaceLandmark(history.labels(), {0, 0}, "left_knee", {3.0, 4.0}));
  const std::string placed = ExactText(history.labels());
  const auto nudge = [&](const char* landmark) {
    history.Apply(NudgeLandmark(history.labels(), {0, 0}, landmark, {1.0, 0.0}));
  };
  for (int i = 0; i < 5; ++i) nudge("left_knee");
  EXPECT_EQ(FindLandmark(history.labels(), {0, 0}, "left_knee")->x_px, Eigen::Vector2d(8.0, 4.0));
  EXPECT_EQ(history.NumSteps(), 2u);
  history.Seal();
  nudge("left_knee");
  EXPECT_EQ(history.NumSteps(), 3u);
  history.Undo();
  nudge("left_knee");  // not into the step that an undo has ended at
  EXPECT_EQ(history.NumSteps(), 3u);
  history.Undo();
  history.Undo();
  EXPECT_EQ(ExactText(history.labels()), placed);
}

TEST(LabelHistory, NudgesOfOtherLandmarksAreOtherSteps) {
  LabelHistory history(SomeLabels());
  for (const char* landmark : {"left_knee", "right_knee"})
    history.Apply(PlaceLandmark(history.labels(), {0, 0}, landmark, {3.0, 4.0}));
  for (const char* landmark : {"left_knee", "right_knee", "left_knee"})
    history.Apply(NudgeLandmark(history.labels(), {0, 0}, landmark, {1.0, 0.0}));
  EXPECT_EQ(history.NumSteps(), 5u);
}

TEST(LabelHistory, AnEditThatChangesNothingIsNoStep) {
  LabelHistory history(SomeLabels());
  EXPECT_FALSE(history.Apply({"nothing", {}, {}, {}, {}}));
  EXPECT_EQ(history.NumSteps(), 0u);
}

TEST(LabelHistory, RefusesWhatLabelsCannotHold) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto of_landmarks = [](std::vector<LandmarkLabel> landmarks) {
    return LabelEdit{"bad", {{0, {{0, std::move(landmarks)}}}}, {}, {}, {}};
  };
  using Kind = LabelHint::Kind;
  const auto of_hints = [](std::vector<LabelHint> hints) {
    return LabelEdit{"bad", {{0, {{0, {}, std::move(hints)}}}}, {}, {}, {}};
  };
  const LabelHint tall{Kind::kHeight, "", "", 1.8};
  const LandmarkLabel knee{"left_knee", {1.0, 2.0}, LabelState::kVisible, {}};
  LandmarkLabel far = knee, nowhere = knee, pointed = knee, unknown = knee;
  far.x_px.x() = 2e6;
  nowhere.x_px.y() = kNaN;
  pointed.radius_px = 0.0;
  unknown.name = "left_wing";
  FrameLabels half_sized, late, early;
  half_sized.width_px = 640;
  late.time_s = kNaN;
  early.frame = -1;
  const std::vector<LabelEdit> edits = {of_landmarks({far}),
                                        of_landmarks({nowhere}),
                                        of_landmarks({pointed}),
                                        of_landmarks({unknown}),
                                        of_landmarks({knee, knee}),
                                        of_hints({{Kind::kOnFloor, "tail"}}),
                                        of_hints({{Kind::kHeight, "", "", kNaN}}),
                                        of_hints({tall, tall}),
                                        {"twins", {{0, {{1, {}}, {1, {}}}}}, {}, {}, {}},
                                        {"no such frame", {{6, {}}}, {}, {}, {}},
                                        {"no such frame", {}, {{6, "a.jpg"}}, {}, {}},
                                        {.name = "too many", .people = {}, .dropped = 7},
                                        {.name = "gone", .people = {{5, {}}}, .dropped = 1},
                                        {"size", {}, {}, {half_sized}, {}},
                                        {"time", {}, {}, {late}, {}},
                                        {"frame", {}, {}, {early}, {}}};
  LabelHistory history(SomeLabels());
  for (size_t i = 0; i < edits.size(); ++i) {
    EXPECT_THROW(history.Apply(edits[i]), InputError) << i;
    EXPECT_EQ(ExactText(history), ExactText(LabelHistory(SomeLabels()))) << i;
  }
}

}  // namespace
}  // namespace poselift
