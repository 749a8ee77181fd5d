// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Files of made-up codebooks: every bit comes back, every damage is refused. What
// all array files have in common is tested with the dictionary's.
#include "lift/temporal/motion_codebook_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "lift/dictionary_file.h"
#include "src/input_error.h"
#include "tests/support/mutation.h"
#include "tests/support/random_codebook.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::FileText;
using ::testing::HasSubstr;
using testing::RandomCodebook;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

std::string BytesOf(const MotionCodebook& codebook) {
  const auto path = ScratchDir() / "written.plmotion";
  WriteMotionCodebook(codebook, path);
  return FileText(path);
}

std::string RefusalOf(const std::filesystem::path& path) {
  try {
    ReadMotionCodebook(path);
    return "not refused";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(MotionCodebookFile, GivesBackEveryBit) {
  MotionCodebook written = RandomCodebook(11);
  written.sample_time_s = 0.1;
  const std::string bytes = BytesOf(written);
  const MotionCodebook read = ReadMotionCodebook(WriteScratch("a.plmotion", bytes));
  EXPECT_EQ(read.segments, written.segments);
  EXPECT_EQ(read.rates, written.rates);
  EXPECT_EQ(read.deviations, written.deviations);
  EXPECT_EQ(read.accelerations.means, written.accelerations.means);
  EXPECT_EQ(read.accelerations.directions, written.accelerations.directions);
  EXPECT_EQ(read.accelerations.responses, written.accelerations.responses);
  EXPECT_EQ(read.accelerations.deviations, written.accelerations.deviations);
  EXPECT_EQ(read.sample_time_s, written.sample_time_s);
  EXPECT_EQ(read.skeleton.bones.size(), written.skeleton.bones.size());
  EXPECT_EQ(read.record.sources, written.record.sources);
  EXPECT_EQ(read.record.command, written.record.command);
  EXPECT_EQ(read.record.commit, written.record.commit);
  EXPECT_EQ(read.record.num_segments, written.record.num_segments);
  EXPECT_EQ(read.record.seed, written.record.seed);
  EXPECT_EQ(read.record.rms_error_mm, written.record.rms_error_mm);
  EXPECT_EQ(BytesOf(read), bytes);
}

TEST(MotionCodebookFile, IsRefusedWithAnyByteAltered) {
  const auto path = ScratchDir() / "altered.plmotion";
  WriteMotionCodebook(RandomCodebook(1), path);
  std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
  const auto flip = [&](size_t offset) {
    stream.seekg(static_cast<std::streamoff>(offset));
    const int flipped = stream.get() ^ 0x10;
    stream.seekp(static_cast<std::streamoff>(offset));
    stream.put(static_cast<char>(flipped)).flush();
  };
  for (size_t i = 0; i < std::filesystem::file_size(path); ++i) {
    flip(i);
    EXPECT_NE(RefusalOf(path), "not refused") << "byte " << i;
    flip(i);
  }
  EXPECT_EQ(RefusalOf(path), "not refused");
}

TEST(MotionCodebookFile, IsRefusedAtAnyOtherLength) {
  const std::string bytes = BytesOf(RandomCodebook(1));
  const std::filesystem::path path = WriteScratch("cut.plmotion", bytes);
  for (size_t size = bytes.size() - 1; size > 0; --size) {
    std::filesystem::resize_file(path, size);
    EXPECT_THAT(RefusalOf(path), HasSubstr("is cut short")) << size;
  }
  EXPECT_THAT(RefusalOf(WriteScratch("empty.plmotion", "")), HasSubstr("empty"));
  EXPECT_THAT(RefusalOf(WriteScratch("long.plmotion", bytes + '\0')), HasSubstr("is altered"));
}

TEST(MotionCodebookFile, SaysWhatAStrangeFileIs) {
  auto rng = TestRng();
  const auto dictionary = ScratchDir() / "d.pldict";
  WriteDictionary(testing::RandomDictionary(2, &rng), dictionary);
  EXPECT_THAT(RefusalOf(dictionary),
              HasSubstr("is no motion codebook; wanted a .plmotion file, as `poselift train "
                        "--motion` writes"));
  std::string newer = BytesOf(RandomCodebook(1));
  newer[8] = 3;
  EXPECT_THAT(RefusalOf(WriteScratch("newer.plmotion", newer)), HasSubstr("newer poselift"));
  EXPECT_THROW(ReadDictionary(ScratchDir() / "written.plmotion"), InputError);
  EXPECT_THROW(ReadMotionCodebook(ScratchDir() / "absent.plmotion"), InputError);
}

TEST(MotionCodebookFile, IsNotWrittenWithAFlaw) {
  const auto path = ScratchDir() / "flawed.plmotion";
  const auto expect_flaw = [&](const char* flaw, auto damage) {
    MotionCodebook codebook = RandomCodebook(3);
    EXPECT_EQ(CodebookFlaw(codebook), "");
    damage(&codebook);
    EXPECT_THAT(CodebookFlaw(codebook), HasSubstr(flaw));
    EXPECT_THROW(WriteMotionCodebook(codebook, path), std::invalid_argument);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_flaw("not finite", [&](MotionCodebook* c) { c->segments(100, 2) = nan; });
  expect_flaw("not finite", [&](MotionCodebook* c) { c->rates(1, 1) = 1e9f; });
  expect_flaw("not finite", [&](MotionCodebook* c) { c->deviations(1, 1) = nan; });
  expect_flaw("below 0", [](MotionCodebook* c) { c->deviations(5, 0) = -0.1f; });
  expect_flaw("below 0", [](MotionCodebook* c) { c->accelerations.deviations(5, 0) = -0.1f; });
  expect_flaw("not finite", [&](MotionCodebook* c) { c->accelerations.responses(1, 1) = nan; });
  expect_flaw("as many regressions",
              [](MotionCodebook* c) { c->accelerations.means.resize(kNumFeatures, 2); });
  expect_flaw("as many of each", [](MotionCodebook* c) { c->rates.resize(kNumFeatures, 2); });
  expect_flaw("as many of each", [](MotionCodebook* c) {
    c->segments.resize(kSegmentRows, 0);
    c->rates.resize(kNumFeatures, 0);
    c->deviations.resize(kNumFeatures, 0);
  });
  expect_flaw("samples 0 s apart", [](MotionCodebook* c) { c->sample_time_s = 0.0; });
  expect_flaw("0 bones", [](MotionCodebook* c) { c->skeleton.bones.clear(); });
  expect_flaw("degrees of freedom", [](MotionCodebook* c) { c->skeleton.bones[2].dofs.clear(); });
  expect_flaw("-1 segments", [](MotionCodebook* c) { c->record.num_segments = -1; });
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace poselift
