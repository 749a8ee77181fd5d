// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the models that ship. Made up: a person in tags, and tags files with one mistake each.
// Checked: that the fit is told for what it is, and a good one is not.
#include "lift/tracking/fit_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "calib/tag_pose.h"
#include "lift/dictionary_file.h"
#include "lift/normalize.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/level_camera.h"
#include "tests/support/support.h"
#include "tests/support/tagged_person.h"

namespace poselift {
namespace {

using ::testing::HasSubstr;

class FitCheckTest : public ::testing::Test {
 protected:
  FitCheckTest()
      : dictionary_(ReadDictionary(testing::SourcePath("data/default.pldict"))),
        codebook_(std::make_shared<MotionCodebook>(
            WithMirrored(ReadMotionCodebook(testing::SourcePath("data/default.plmotion"))))),
        lifter_(dictionary_),
        person_(dictionary_.skeleton) {}

  // What the check says of a fit that begins with this tags file.
  std::string FlawOf(BodyTags said) {
    for (BodyTag& tag : said.tags) {
      tag.on_bone->sigma_m = 0.02;
      tag.on_bone->sigma_rad = 0.3;
    }
    std::vector<SightedFrame> frames;
    for (int f = 0; f < 60; ++f) {
      std::vector<TagSighting> seen = person_.Sight(person_.PoseAt(f / 15.0), 0.1, &rng_);
      for (TagSighting& tag : seen) {
        TagPoses found = FindTagPoses(person_.camera, tag.detection.corners_px,
                                      said.Find(tag.detection.id)->size_m);
        tag.poses = std::move(found.poses);
        tag.is_ambiguous = found.is_ambiguous;
      }
      frames.push_back({f / 15.0, std::move(seen)});
    }
    const TagFit fit = FitTags(frames, said, person_.camera, kLevelFromCam, lifter_, codebook_,
                               {.num_frames = 30});
    EXPECT_TRUE(fit.is_usable) << fit.message;
    return ImplausibleFit(dictionary_.skeleton, fit);
  }

  // The tags of two bones change places in the file.
  BodyTags WithSwapped(const std::vector<std::pair<std::string, std::string>>& bones) const {
    BodyTags said = person_.worn;
    for (const auto& [a, b] : bones) {
      const auto on = [&](const std::string& bone) {
        return std::find_if(said.tags.begin(), said.tags.end(),
                            [&](const BodyTag& tag) { return tag.on_bone->bone == bone; });
      };
      const auto first = on(a), second = on(b);
      std::swap(first->on_bone, second->on_bone);
    }
    return said;
  }

  Dictionary dictionary_;
  std::shared_ptr<const MotionCodebook> codebook_;
  PhotoLifter lifter_;
  testing::TaggedPerson person_;
  std::mt19937_64 rng_ = testing::TestRng();
};

TEST_F(FitCheckTest, AGoodFitIsPlausible) { EXPECT_EQ(FlawOf(person_.worn), ""); }

TEST_F(FitCheckTest, AWrongTagSizeIsTold) {
  BodyTags said = person_.worn;
  for (BodyTag& tag : said.tags) tag.size_m *= 1.8;
  EXPECT_THAT(FlawOf(said), HasSubstr("Is the tags' size right?"));
}

TEST_F(FitCheckTest, LeftAndRightSwappedAreTold) {
  const std::string flaw = FlawOf(WithSwapped({{"lhumerus", "rhumerus"},
                                               {"lradius", "rradius"},
                                               {"lfemur", "rfemur"},
                                               {"ltibia", "rtibia"},
                                               {"lfoot", "rfoot"}}));
  EXPECT_THAT(flaw, HasSubstr("Is a left tag on the right"));
}

TEST_F(FitCheckTest, ATagOnAnotherBoneIsTold) {
  EXPECT_THAT(FlawOf(WithSwapped({{"lfemur", "ltibia"}})), HasSubstr("on another bone"));
}

TEST_F(FitCheckTest, PeopleOfAllKindsArePlausibleBodiesAndOthersAreNot) {
  const Skeleton& standard = dictionary_.skeleton;
  GroupVector ratios = GroupVector::Constant(std::log(0.6));
  EXPECT_EQ(ImplausibleBody(standard, WithProportions(standard, ratios)), "");  // a child
  ratios.setConstant(std::log(1.2));
  EXPECT_EQ(ImplausibleBody(standard, WithProportions(standard, ratios)), "");
  ratios.setConstant(std::log(1.0 / 2.2));
  EXPECT_THAT(ImplausibleBody(standard, WithProportions(standard, ratios)),
              HasSubstr("about 2.20"));
  ratios.setZero();
  ratios[0] = std::log(1.55);
  EXPECT_THAT(ImplausibleBody(standard, WithProportions(standard, ratios)), HasSubstr("hip +55 %"));
}

TEST_F(FitCheckTest, BonesOfBothSidesAreAlike) {
  Eigen::VectorXd lengths_m = BoneLengths(dictionary_.skeleton);
  lengths_m[joint::kLeftKnee] *= 1.1;
  EXPECT_EQ(ImplausibleBody(dictionary_.skeleton, WithBoneLengths(dictionary_.skeleton, lengths_m)),
            "");
  lengths_m[joint::kLeftKnee] *= 1.1;
  EXPECT_THAT(
      ImplausibleBody(dictionary_.skeleton, WithBoneLengths(dictionary_.skeleton, lengths_m)),
      HasSubstr("left_knee"));
}

}  // namespace
}  // namespace poselift
