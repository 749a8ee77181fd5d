// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The environment is real, the programs are names of files that need not be
// there: where a program looks follows from where it stands.
#include "lift/default_dictionary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "src/input_error.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::ScratchDir;
using ::testing::SizeIs;
using testing::SourcePath;
using testing::WriteScratch;

// The variable, put back as it was in the end.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name_)) before_ = before;
    setenv(name_, value.c_str(), 1);
  }
  ~ScopedVariable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(DefaultDictionary, IsTheOneOfTheEnvironment) {
  const std::string path = WriteScratch("mine.pldict", "x");
  const ScopedVariable variable("POSELIFT_DICTIONARY", path);
  EXPECT_EQ(DefaultDictionaryPath(), path);
}

TEST(DefaultMotionModel, HasAVariableAndAFileOfItsOwn) {
  const std::string path = WriteScratch("mine.plmotion", "x");
  const ScopedVariable variable("POSELIFT_MOTION_MODEL", path);
  EXPECT_EQ(DefaultMotionModelPath(), path);
  EXPECT_EQ(DefaultModelPlaces(DefaultModel::kMotion, "/opt/body/bin/program").front(),
            "/opt/body/share/poselift/default.plmotion");
  EXPECT_THAT(MessageOf([] { FirstModelOf(DefaultModel::kMotion, {"/no/a.plmotion"}); }),
              AllOf(HasSubstr("/no/a.plmotion"), HasSubstr("POSELIFT_MOTION_MODEL"),
                    HasSubstr("train --motion")));
}

TEST(DefaultDictionary, DoesNotFallBackWhenTheEnvironmentIsWrong) {
  const auto absent = ScratchDir() / "absent.pldict";
  const ScopedVariable variable("POSELIFT_DICTIONARY", absent);
  EXPECT_THAT(MessageOf([] { DefaultDictionaryPath(); }),
              AllOf(HasSubstr(absent.string()), HasSubstr("POSELIFT_DICTIONARY")));
}

TEST(DefaultDictionary, IsLookedForBesideAnInstalledProgram) {
  const auto places = DefaultModelPlaces(DefaultModel::kDictionary, "/opt/body/bin/program");
  EXPECT_EQ(places.front(), "/opt/body/share/poselift/default.pldict");
  EXPECT_THAT(places, Not(Contains(SourcePath("data/default.pldict"))));
}

TEST(DefaultDictionary, IsLookedForInTheSourceTreeByProgramsOfTheBuildTree) {
  const fs::path program = fs::canonical(POSELIFT_PROGRAM);
  EXPECT_THAT(DefaultModelPlaces(DefaultModel::kDictionary, program),
              Contains(SourcePath("data/default.pldict")));
  // A folder whose name only begins like the build tree's.
  const fs::path stranger = program.parent_path().string() + "-other/program";
  EXPECT_THAT(DefaultModelPlaces(DefaultModel::kDictionary, stranger),
              Not(Contains(SourcePath("data/default.pldict"))));
}

TEST(DefaultDictionary, IsLookedForUnderThePrefixByAProgramOfUnknownPlace) {
  EXPECT_THAT(DefaultModelPlaces(DefaultModel::kDictionary, ""), SizeIs(1));
  EXPECT_TRUE(DefaultModelPlaces(DefaultModel::kDictionary, "").front().is_absolute());
}

TEST(DefaultDictionary, IsTheFirstThatIsAFile) {
  const fs::path first = WriteScratch("first.pldict", "x");
  const fs::path second = WriteScratch("second.pldict", "x");
  EXPECT_EQ(FirstModelOf(DefaultModel::kDictionary,
                         {ScratchDir(), ScratchDir() / "absent", first, second}),
            first);
}

TEST(DefaultDictionary, SaysEveryPlaceLookedAt) {
  EXPECT_THAT(MessageOf([] {
                FirstModelOf(DefaultModel::kDictionary, {"/no/a.pldict", "/no/b.pldict"});
              }),
              AllOf(HasSubstr("/no/a.pldict"), HasSubstr("/no/b.pldict"),
                    HasSubstr("POSELIFT_DICTIONARY")));
}

}  // namespace
}  // namespace poselift
