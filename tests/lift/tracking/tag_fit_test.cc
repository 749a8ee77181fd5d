// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: the models that ship. Made up: a person with longer thighs than the standard, in tags
// that do not sit where the tags file says. Checked: what the fit finds against the truth.
#include "lift/tracking/tag_fit.h"

#include <gtest/gtest.h>

#include <random>

#include "lift/dictionary_file.h"
#include "lift/normalize.h"
#include "lift/temporal/motion_codebook_file.h"
#include "lift/tracking/person_skeleton.h"
#include "src/input_error.h"
#include "src/level_camera.h"
#include "tests/support/support.h"
#include "tests/support/tagged_person.h"

namespace poselift {
namespace {

GroupVector LongThighs() {
  GroupVector ratios = GroupVector::Zero();
  for (int g = 0; g < kNumBoneGroups; ++g)
    if (BoneGroupNames()[static_cast<size_t>(g)] == "thigh") ratios[g] = 0.06;
  return ratios;
}

class TagFitTest : public ::testing::Test {
 protected:
  TagFitTest()
      : dictionary_(ReadDictionary(testing::SourcePath("data/default.pldict"))),
        codebook_(std::make_shared<MotionCodebook>(
            WithMirrored(ReadMotionCodebook(testing::SourcePath("data/default.plmotion"))))),
        lifter_(dictionary_),
        person_(WithProportions(dictionary_.skeleton, LongThighs())) {}

  // Tags 12 mm and some degrees from where they sit.
  BodyTags Said() {
    std::normal_distribution<double> normal;
    const auto draw = [&] { return Eigen::Vector3d(normal(rng_), normal(rng_), normal(rng_)); };
    BodyTags said = person_.worn;
    for (BodyTag& tag : said.tags) {
      tag.on_bone->bone_from_tag.translation() += 0.012 * draw();
      const Eigen::Vector3d turn = 0.08 * draw();
      tag.on_bone->bone_from_tag.linear() *=
          Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
      tag.on_bone->sigma_m = 0.012;
      tag.on_bone->sigma_rad = 0.08;
    }
    return said;
  }

  std::vector<SightedFrame> Movement(int num_frames) {
    std::vector<SightedFrame> frames;
    for (int f = 0; f < num_frames; ++f)
      frames.push_back({f / 15.0, person_.Sight(person_.PoseAt(f / 15.0), 0.1, &rng_)});
    return frames;
  }

  TagFit Fit(const std::vector<SightedFrame>& frames, const BodyTags& said,
             const TagFitOptions& options = {.num_frames = 40}) const {
    return Fit(frames, said, options, person_.camera);
  }
  TagFit Fit(const std::vector<SightedFrame>& frames, const BodyTags& said,
             const TagFitOptions& options, const Camera& camera) const {
    return FitTags(frames, said, camera, kLevelFromCam, lifter_, codebook_, options);
  }

  double Mean_mm(const BodyTags& tags, const std::vector<std::string>& bones) const {
    double sum = 0.0;
    int count = 0;
    for (const BodyTag& tag : tags.tags) {
      if (std::find(bones.begin(), bones.end(), tag.on_bone->bone) == bones.end()) continue;
      sum += (tag.on_bone->bone_from_tag.translation() -
              person_.worn.Find(tag.id)->on_bone->bone_from_tag.translation())
                 .norm();
      ++count;
    }
    return 1e3 * sum / count;
  }

  Dictionary dictionary_;
  std::shared_ptr<const MotionCodebook> codebook_;
  PhotoLifter lifter_;
  testing::TaggedPerson person_;
  std::mt19937_64 rng_ = testing::TestRng();
};

TEST_F(TagFitTest, FindsTagsOnLegsAndTheLengthOfThighs) {
  const BodyTags said = Said();
  const TagFit fit = Fit(Movement(60), said);
  ASSERT_TRUE(fit.is_usable) << fit.message;
  const std::vector<std::string> legs = {"lfemur", "rfemur", "ltibia", "rtibia"};
  EXPECT_LT(Mean_mm(fit.tags, legs), 0.6 * Mean_mm(said, legs));
  for (const TagFitRow& row : fit.rows) EXPECT_LT(row.rms_px, 0.3) << row.id;
  Eigen::Index thigh = 0;
  LongThighs().maxCoeff(&thigh);
  EXPECT_NEAR(fit.proportions.log_ratios[thigh], 0.06, 0.025);
  // What is written is what was found.
  const Skeleton person = PersonSkeleton(dictionary_.skeleton, fit.tags);
  EXPECT_LT((BoneLengths(person) - BoneLengths(fit.skeleton)).norm(), 1e-9);
}

TEST_F(TagFitTest, FindsTheFocalLengthOfACameraThatNobodyCalibrated) {
  Camera guess = person_.camera;
  guess.fx_px = guess.fy_px *= 1.25;
  guess.distortion = {};
  const std::vector<SightedFrame> frames = Movement(60);
  const TagFit found = Fit(frames, Said(), {.num_frames = 40, .finds_lens = true}, guess);
  ASSERT_TRUE(found.is_usable) << found.message;
  EXPECT_NEAR(found.camera.fx_px / person_.camera.fx_px, 1.0, 0.05);
  EXPECT_EQ(found.camera.fx_px, found.camera.fy_px);
  EXPECT_GT(found.focal_sigma, 0.0);
  EXPECT_LT(found.focal_sigma, 0.05);
  // A camera that is known stays as it is.
  const TagFit kept = Fit(frames, Said(), {.num_frames = 15, .rounds = 1}, guess);
  EXPECT_EQ(kept.camera.fx_px, guess.fx_px);
  EXPECT_EQ(kept.focal_sigma, 0.0);
}

TEST_F(TagFitTest, SaysWhatToDoWhenNobodyIsSeen) {
  std::vector<SightedFrame> frames = Movement(20);
  for (SightedFrame& frame : frames) frame.tags.clear();
  const TagFit fit = Fit(frames, Said());
  EXPECT_FALSE(fit.is_usable);
  EXPECT_NE(fit.message.find("0 of 20 frames"), std::string::npos) << fit.message;
}

TEST_F(TagFitTest, AnUnseenTagStaysAsItWas) {
  std::vector<SightedFrame> frames = Movement(30);
  const int id = person_.worn.tags.back().id;
  for (SightedFrame& frame : frames)
    std::erase_if(frame.tags, [&](const TagSighting& tag) { return tag.detection.id == id; });
  const BodyTags said = Said();
  const TagFit fit = Fit(frames, said, {.num_frames = 15, .rounds = 1});
  ASSERT_TRUE(fit.is_usable) << fit.message;
  EXPECT_TRUE(
      fit.tags.Find(id)->on_bone->bone_from_tag.isApprox(said.Find(id)->on_bone->bone_from_tag));
}

TEST_F(TagFitTest, WrongOptionsAreRefused) {
  EXPECT_THROW(Fit({}, Said(), {.num_frames = 1}), InputError);
  EXPECT_THROW(Fit({}, Said(), {.corner_sigma_px = -1.0}), InputError);
}

TEST(PersonSkeletonTest, TakesLengthsByJointAndRefusesWhatIsNone) {
  const Dictionary dictionary = ReadDictionary(testing::SourcePath("data/default.pldict"));
  BodyTags tags;
  EXPECT_EQ(BoneLengths(PersonSkeleton(dictionary.skeleton, tags)),
            BoneLengths(dictionary.skeleton));
  tags.bone_lengths_m = {{"left_knee", 0.5}};
  const Eigen::VectorXd lengths_m = BoneLengths(PersonSkeleton(dictionary.skeleton, tags));
  EXPECT_NEAR(lengths_m[joint::kLeftKnee], 0.5, 1e-12);
  EXPECT_NEAR(lengths_m[joint::kRightKnee], BoneLengths(dictionary.skeleton)[joint::kRightKnee],
              1e-12);
  tags.bone_lengths_m = {{"tail", 0.5}};
  EXPECT_THROW(PersonSkeleton(dictionary.skeleton, tags), InputError);
  tags.bone_lengths_m = {{"left_knee", 50.0}};
  EXPECT_THROW(PersonSkeleton(dictionary.skeleton, tags), InputError);
}

}  // namespace
}  // namespace poselift
