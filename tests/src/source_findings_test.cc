// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Facts of a good camera, with one flaw planted at a time: its finding must come, with what to
// do, and no other. The facts themselves are those of a made-up camera with planted gaps.
#include "src/capture/source_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <functional>

#include "src/capture/fourcc.h"
#include "tests/support/fake_camera.h"

namespace poselift {
namespace {

using testing::FakeBuffer;
using testing::FakeCamera;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SourceFacts GoodFacts() {
  FakeCamera webcam;
  MakeWebcam(&webcam);
  SourceFacts facts;
  facts.name = "/dev/video0";
  facts.camera.emplace();
  facts.camera->formats = {webcam.formats[1]};
  facts.camera->controls = webcam.controls;
  facts.camera->wanted = facts.camera->asked =
      facts.camera->given = {kFourccMjpg, {1280, 720}, 30.0};
  facts.num_frames = 151;
  facts.duration_s = 5.0;
  facts.longest_gap_s = 0.035;
  facts.mean_grey = 110.0;
  facts.tags = TagFacts{20, 0, 1.4, 1.5};
  for (CameraControl& control : facts.camera->controls) {
    if (control.id == V4L2_CID_EXPOSURE_AUTO) control.value = V4L2_EXPOSURE_MANUAL;
    if (control.id == V4L2_CID_EXPOSURE_ABSOLUTE) control.value = 50;
    if (control.id == V4L2_CID_FOCUS_AUTO) control.value = 0;
  }
  return facts;
}

void Set(SourceFacts* facts, uint32_t id, int64_t value) {
  for (CameraControl& control : facts->camera->controls)
    if (control.id == id) control.value = value;
}

// The one finding of the good facts with that flaw.
Finding FindingOf(const std::function<void(SourceFacts*)>& plant) {
  SourceFacts facts = GoodFacts();
  plant(&facts);
  const auto findings = JudgeSource(facts);
  EXPECT_EQ(findings.size(), 1u);
  if (findings.empty()) return {};
  EXPECT_FALSE(findings.front().what.empty() || findings.front().why.empty() ||
               findings.front().to_do.empty());
  return findings.front();
}

TEST(SourceFindings, AreNoneOfAGoodCamera) { EXPECT_THAT(JudgeSource(GoodFacts()), IsEmpty()); }

TEST(SourceFindings, TellThatYuyvCapsTheRate) {
  FakeCamera webcam;
  MakeWebcam(&webcam);
  const auto findings = JudgeFormats(webcam.formats, {0, {1280, 720}, 30.0});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].what, "gives 10 pictures a second as YUYV at 1280x720, 30 as MJPG");
  EXPECT_THAT(JudgeFormats(webcam.formats, {0, {640, 480}, 30.0}), IsEmpty());
  EXPECT_THAT(JudgeFormats({webcam.formats[0]}, {0, {1280, 720}, 30.0}), IsEmpty());
  ASSERT_EQ(JudgeFormats({webcam.formats[2]}, {0, {1280, 720}, 30.0}).size(), 1u);
  // It has others than the one that is wanted: no problem of the camera.
  EXPECT_THAT(JudgeFormats({webcam.formats[0]}, {kFourccNv12, {640, 480}, 30.0}), IsEmpty());
}

TEST(SourceFindings, TellWhatWasGivenForWhatWasAsked) {
  EXPECT_THAT(FindingOf([](SourceFacts* f) {
                f->camera->given.size_px = {640, 480};
              }).what,
              HasSubstr("asked for 1280x720 MJPG 30 Hz and gives 640x480"));
  const Finding other_format =
      FindingOf([](SourceFacts* f) { f->camera->given.fourcc = kFourccYuyv; });
  EXPECT_THAT(other_format.what, HasSubstr("gives 1280x720 YUYV"));
  EXPECT_THAT(other_format.to_do, HasSubstr("a format that it offers"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) {
                f->camera->given.rate_hz = 15.0;
                f->num_frames = 76;
              }).what,
              HasSubstr("offers 15 pictures a second at 1280x720, 30 were wanted"));
}

TEST(SourceFindings, TellOfARateThatIsNotReached) {
  const Finding slow = FindingOf([](SourceFacts* f) {
    f->num_frames = 76;
    f->longest_gap_s = 0.07;
  });
  EXPECT_EQ(slow.weight, Finding::Weight::kProblem);
  EXPECT_THAT(slow.what, HasSubstr("gives 15 pictures a second, 30 were stated"));
  EXPECT_THAT(slow.to_do, HasSubstr("--set exposure_dynamic_framerate=0"));
}

TEST(SourceFindings, TellWhereFramesAreLost) {
  const auto flaw = [](int64_t CaptureCounts::*count) {
    return FindingOf([&](SourceFacts* f) {
      f->camera->counts.*count = 15;
      f->num_frames -= 15;
    });
  };
  EXPECT_THAT(flaw(&CaptureCounts::lost).what, HasSubstr("15 of 151 pictures were lost"));
  EXPECT_THAT(flaw(&CaptureCounts::bad).to_do, HasSubstr("cable"));
  EXPECT_THAT(flaw(&CaptureCounts::dropped).what, HasSubstr("not fast enough"));
}

TEST(SourceFindings, TellOfExposureAndFocus) {
  const Finding exposure =
      FindingOf([](SourceFacts* f) { Set(f, V4L2_CID_EXPOSURE_ABSOLUTE, 333); });
  EXPECT_EQ(exposure.weight, Finding::Weight::kProblem);
  EXPECT_THAT(exposure.what, HasSubstr("exposes for 33.3 ms"));
  EXPECT_THAT(exposure.to_do, HasSubstr("poselift doctor /dev/video0 --set exposure=50"));
  const Finding automatic = FindingOf([](SourceFacts* f) { Set(f, V4L2_CID_EXPOSURE_AUTO, 3); });
  EXPECT_EQ(automatic.weight, Finding::Weight::kAdvice);
  EXPECT_THAT(automatic.what, HasSubstr("set by itself"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) { Set(f, V4L2_CID_FOCUS_AUTO, 1); }).to_do,
              HasSubstr("--set focus_automatic_continuous=0"));
}

TEST(SourceFindings, TellOfThePictures) {
  EXPECT_THAT(FindingOf([](SourceFacts* f) { f->mean_grey = 20.0; }).what, HasSubstr("is dark"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) { f->saturated_part = 0.2; }).what,
              HasSubstr("saturated in 20 %"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) { f->longest_gap_s = 0.2; }).what,
              HasSubstr("a gap of 200 ms"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) {
                f->tags = TagFacts{0, 9};
              }).what,
              HasSubstr("is mirrored"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) { f->tags = TagFacts{}; }).what,
              HasSubstr("shows no tag"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) {
                f->tags = TagFacts{9, 0, 1.5, 6.0};
              }).to_do,
              HasSubstr("it moved"));
  EXPECT_THAT(FindingOf([](SourceFacts* f) {
                f->tags = TagFacts{9, 0, 5.0, 6.0};
              }).to_do,
              HasSubstr("out of focus"));
}

TEST(SourceFacts, AreThoseOfTheFrames) {
  FakeCamera camera;
  MakeWebcam(&camera);
  camera.formats = {{kFourccGrey, "grey", {{{40, 20}, {25.0}}}}};
  camera.frame_time_s = 0.04;
  camera.Allow(0);
  // A tenth of each picture is white, three tenths are black; two frames are lost after 50.
  camera.frame = [](int i) {
    std::string bytes;
    for (int row = 0; row < 20; ++row)
      bytes += std::string(4, '\xff') + std::string(12, '\0') + std::string(24, '\x64');
    return FakeBuffer{bytes, static_cast<uint32_t>(i < 50 ? 1 + i : 3 + i), 0};
  };
  LiveOptions options;
  options.pictures = Pictures::kGrey;
  options.camera.wanted = {0, {40, 20}, 25.0};
  options.max_waiting = 1000;
  LiveFrameSource source(camera.path, options, &camera);
  camera.AllowAndWait(101);
  const SourceFacts facts = WatchSource(&source, 3.99);
  EXPECT_EQ(facts.num_frames, 101);
  EXPECT_NEAR(facts.rate_hz(), 25.0, 0.01);
  EXPECT_NEAR(facts.longest_gap_s, 0.04, 1e-4);
  EXPECT_NEAR(facts.mean_grey, 0.1 * 255 + 0.6 * 100, 1.0);
  EXPECT_NEAR(facts.saturated_part, 0.1, 0.02);
  EXPECT_NEAR(facts.dark_part, 0.3, 0.02);
  EXPECT_EQ(facts.samples.size(), 12u);
  const CameraFacts camera_facts = FactsOf(source, options.camera.wanted);
  EXPECT_EQ(camera_facts.counts.lost, 2);
  EXPECT_EQ(camera_facts.counts.given, 101);
  EXPECT_EQ(camera_facts.controls.size(), camera.controls.size());
}

}  // namespace
}  // namespace poselift
