// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Motion files with random damage (bytes changed, pieces cut, doubled or
// swapped for nasty words), seeded: a reader either throws InputError or gives a
// motion of finite numbers that can be written and read again.
#include <gtest/gtest.h>

#include <functional>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/bvh.h"
#include "src/io/text_scanner.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::kMadeUpAsf;
using testing::RandomMotion;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

std::string Damaged(std::string text, std::mt19937_64* rng) {
  static const std::vector<std::string> kNasty = {
      "nan",      "1e999", "-1e-999", "1e9", "999999999",  "-1",    "{",    "}",
      "end",      ":root", "\n",      "\r",  "(",          "#",     "root", "inf",
      "\xFF\xFE", "0x1",   "",        " ",   "CHANNELS 6", "JOINT", "begin"};
  const auto random = [&](size_t below) { return (*rng)() % below; };
  for (size_t i = 0, times = 1 + random(3); i < times; ++i) {
    const size_t at = random(text.size());
    const size_t length = std::min(text.size() - at, random(12));
    switch (random(4)) {
      case 0:
        text[at] = static_cast<char>(1 + random(255));
        break;
      case 1:
        text.erase(at, length * random(8));
        break;
      case 2:
        text.insert(at, text.substr(random(text.size()), 4 * length));
        break;
      default:
        text.replace(at, length, kNasty[random(kNasty.size())]);
    }
    if (text.empty()) text.assign(1, ' ');
  }
  return text;
}

void ExpectFinite(const Motion& motion) {
  BoneFrames frames;
  for (const SkeletonPose& pose : motion.frames) {
    ASSERT_TRUE(pose.dofs.allFinite());
    ForwardKinematics(motion.skeleton, pose, &frames);
    ASSERT_TRUE(frames.tip_in_world_m.allFinite());
  }
}

// How many of the damaged files were still read.
int CountRead(const std::string& text, const std::string& name,
              const std::function<void(const std::string&)>& read) {
  auto rng = TestRng();
  int num_read = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string path = WriteScratch(name, Damaged(text, &rng));
    try {
      read(path);
      ++num_read;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(num_read, kTrials / 50);
  EXPECT_LT(num_read, kTrials);
  return num_read;
}

struct Files {
  AsfSkeleton asf;
  std::string amc;
  std::string bvh;
};

Files WriteFiles() {
  auto rng = TestRng();
  Files files{ReadAsfSkeleton(WriteScratch("m.asf", std::string(kMadeUpAsf))), "", ""};
  const Motion motion = RandomMotion(files.asf.skeleton, 3, &rng);
  WriteAmc(motion, files.asf, ScratchDir() / "good.amc");
  WriteBvh(motion, ScratchDir() / "good.bvh");
  files.amc = ReadTextFile(ScratchDir() / "good.amc");
  files.bvh = ReadTextFile(ScratchDir() / "good.bvh");
  return files;
}

TEST(MutatedFiles, AsfIsRefusedOrReadWhole) {
  CountRead(std::string(kMadeUpAsf), "d.asf", [](const std::string& path) {
    const AsfSkeleton asf = ReadAsfSkeleton(path);
    ExpectFinite({asf.skeleton, 1.0, {SkeletonPose::Rest(asf.skeleton)}});
  });
}

TEST(MutatedFiles, AmcIsRefusedOrReadWhole) {
  const Files files = WriteFiles();
  CountRead(files.amc, "d.amc",
            [&](const std::string& path) { ExpectFinite(ReadAmc(path, files.asf)); });
}

TEST(MutatedFiles, BvhIsRefusedOrReadWhole) {
  const Files files = WriteFiles();
  CountRead(files.bvh, "d.bvh", [](const std::string& path) { ExpectFinite(ReadBvh(path)); });
}

}  // namespace
}  // namespace poselift
