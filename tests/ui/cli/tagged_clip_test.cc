// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// samples/tags: a rendered person in clothes and printed tags, walking and waving. Checked: its
// video and its tags, and `track` with the tags file as it was printed and as `tags fit` made it,
// against the truth. The rig's joints are not quite the skeleton's (samples/photo/README.md):
// errors of joints have that in them, flexion of elbows and knees hardly.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "calib/tag_detector.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_yaml.h"
#include "src/io/json_value.h"
#include "src/io/poses_json.h"
#include "src/io/video.h"
#include "src/joints.h"
#include "src/units.h"
#include "tests/support/run_program.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::ProgramRun;
using testing::RunProgram;
using testing::ScratchDir;
using testing::SourcePath;

constexpr double kRate_hz = 30.0;
constexpr double kFlip_m = 0.15;
constexpr int kFrames = 90;

fs::path Sample(const char* name) { return SourcePath("samples/tags") / name; }

struct TrueFrame {
  double time_s = 0.0;
  Pose3 joints_in_cam_m;  // NaN where the rig has none
  std::map<int, Eigen::Matrix<double, 2, 4>> tags;
};

std::vector<TrueFrame> ReadTrueFrames() {
  const JsonDocument document(Sample("truth.json"));
  std::vector<TrueFrame> frames;
  for (const JsonValue& row : document.root().At("frames").Items()) {
    TrueFrame frame{.time_s = row.At("time_s").Number()};
    frame.joints_in_cam_m.setConstant(3, kNumJoints, std::nan(""));
    const JsonValue& joints = row.At("joints_in_cam");
    for (size_t i = 0; i < joints.Keys().size(); ++i)
      for (int c = 0; c < 3; ++c)
        frame.joints_in_cam_m(c, *FindJoint(joints.Keys()[i])) =
            joints.Members()[i].Items()[static_cast<size_t>(c)].Number();
    const JsonValue& tags = row.At("tags");
    for (size_t i = 0; i < tags.Keys().size(); ++i)
      for (int k = 0; k < 4; ++k)
        for (int c = 0; c < 2; ++c)
          frame.tags[std::stoi(tags.Keys()[i])](c, k) = tags.Members()[i]
                                                            .Items()[static_cast<size_t>(k)]
                                                            .Items()[static_cast<size_t>(c)]
                                                            .Number();
    frames.push_back(std::move(frame));
  }
  return frames;
}

// Of the joints at the ends of bones whose tags are seen, relative to the middle of the hips.
struct Errors {
  double joints_mm = 0.0, from_pelvis_mm = 0.0;
  double elbows_deg = 0.0, knees_deg = 0.0;  // RMS, where both bones are seen
  int num_flips = 0, num_ok = 0, num_elbows = 0, num_knees = 0;
};

double Flexion_deg(const Pose3& joints, int hinge) {
  const int before = Joints()[static_cast<size_t>(hinge)].parent;
  const Vector3d upper = joints.col(before) - joints.col(hinge);
  const Vector3d lower = joints.col(hinge + 1) - joints.col(hinge);
  return 180.0 - kDegFromRad * std::atan2(upper.cross(lower).norm(), upper.dot(lower));
}

Pose3 From(Pose3 joints, const Vector3d& origin) {
  joints.colwise() -= origin;
  return joints;
}

Vector3d MiddleOfHips(const Pose3& joints) {
  return (joints.col(joint::kLeftHip) + joints.col(joint::kRightHip)) / 2.0;
}

class ErrorSums {
 public:
  ErrorSums() {
    for (const BodyTag& tag : ReadBodyTags(Sample("tags.toml")).tags)
      bone_of_tag_[tag.id] = *FindJoint(tag.on_joint->joint);
  }

  void Add(const PersonPose& person, const TrueFrame& truth) {
    if (person.status != "ok") return;
    ++errors_.num_ok;
    const Pose3& found = person.joints_in_cam_m;
    const Pose3& true_m = truth.joints_in_cam_m;
    const Eigen::RowVectorXd off_m =
        (From(found, MiddleOfHips(found)) - From(true_m, MiddleOfHips(true_m))).colwise().norm();
    const Eigen::RowVectorXd from_pelvis_m =
        (From(found, found.col(joint::kPelvis)) - From(true_m, true_m.col(joint::kPelvis)))
            .colwise()
            .norm();
    std::set<int> seen, ends;
    for (const PoseTag& tag : person.tags) {
      const int bone = bone_of_tag_.at(tag.id);
      seen.insert(bone);
      ends.insert({bone, std::max(0, Joints()[static_cast<size_t>(bone)].parent)});
    }
    for (const int j : ends) {
      if (j == joint::kPelvis || !std::isfinite(off_m[j])) continue;
      joints_m_ += off_m[j];
      from_pelvis_m_ += from_pelvis_m[j];
      ++num_joints_;
    }
    bool is_flipped = false;
    const auto add_hinge = [&](int j, double* deg2, int* count) {
      is_flipped |= ends.contains(j) && off_m[j] > kFlip_m;
      if (!seen.contains(j) || !seen.contains(j + 1)) return;
      const double off_deg = Flexion_deg(found, j) - Flexion_deg(true_m, j);
      *deg2 += off_deg * off_deg;
      ++*count;
    };
    for (const int j : {joint::kLeftElbow, joint::kRightElbow})
      add_hinge(j, &elbows_deg2_, &errors_.num_elbows);
    for (const int j : {joint::kLeftKnee, joint::kRightKnee})
      add_hinge(j, &knees_deg2_, &errors_.num_knees);
    errors_.num_flips += is_flipped;
  }

  Errors Result() const {
    Errors errors = errors_;
    errors.joints_mm = 1e3 * joints_m_ / num_joints_;
    errors.from_pelvis_mm = 1e3 * from_pelvis_m_ / num_joints_;
    errors.elbows_deg = std::sqrt(elbows_deg2_ / errors.num_elbows);
    errors.knees_deg = std::sqrt(knees_deg2_ / errors.num_knees);
    return errors;
  }

 private:
  std::map<int, int> bone_of_tag_;  // by the joint at its end
  Errors errors_;
  double joints_m_ = 0.0, from_pelvis_m_ = 0.0, elbows_deg2_ = 0.0, knees_deg2_ = 0.0;
  int num_joints_ = 0;
};

// options: the tags, the camera, what is written.
ProgramRun RunOnClip(const char* command, const std::string& options) {
  return RunProgram(fmt::format(
      "{} {} {} --dictionary {} --motion-model {}", command, Sample("clip.mp4").string(), options,
      SourcePath("data/default.pldict").string(), SourcePath("data/default.plmotion").string()));
}

std::string With(const fs::path& tags, const fs::path& camera) {
  return fmt::format("--tags {} --camera {}", tags.string(), camera.string());
}

Errors Track(const fs::path& tags, const fs::path& camera = Sample("camera.yaml")) {
  const ProgramRun run = RunOnClip("track", With(tags, camera) + " --out run");
  EXPECT_EQ(run.code, 0) << run.err;
  const Poses poses = ReadPosesJson(ScratchDir() / "run/poses.json");
  const std::vector<TrueFrame> truth = ReadTrueFrames();
  EXPECT_EQ(poses.frames.size(), truth.size());
  ErrorSums sums;
  for (size_t t = 0; t < std::min(truth.size(), poses.frames.size()); ++t)
    sums.Add(poses.frames[t].people.front(), truth[t]);
  const Errors errors = sums.Result();
  const auto record = [](const char* name, double value) {
    ::testing::Test::RecordProperty(name, fmt::format("{:.1f}", value));
  };
  record("seen_joints_mm", errors.joints_mm);
  record("seen_joints_from_pelvis_mm", errors.from_pelvis_mm);
  record("elbows_deg", errors.elbows_deg);
  record("elbows_counted", errors.num_elbows);
  record("knees_deg", errors.knees_deg);
  record("knees_counted", errors.num_knees);
  record("frames_with_a_flip", errors.num_flips);
  record("frames_ok", errors.num_ok);
  return errors;
}

TEST(TaggedClip, VideoWithBFramesHasTheTimeOfEveryFrame) {
  const std::vector<double> times_s = ReadFrameTimes(Sample("clip.mp4"));
  ASSERT_EQ(times_s.size(), static_cast<size_t>(kFrames));
  for (size_t t = 0; t < times_s.size(); ++t)
    EXPECT_NEAR(times_s[t], static_cast<double>(t) / kRate_hz, 1e-4);
}

TEST(TaggedClip, TagsAreFoundWhereTheyAre) {
  const std::vector<TrueFrame> truth = ReadTrueFrames();
  TagDetector detector{TagFamily("tag36h11")};
  VideoFile video(Sample("clip.mp4"), Pictures::kGrey);
  int num_true = 0, num_found = 0, num_wrong = 0;
  double off_px2 = 0.0;
  for (const TrueFrame& frame : truth) {
    const auto found = detector.Detect(video.Next()->grey);
    num_true += static_cast<int>(frame.tags.size());
    for (const TagDetection& tag : found) {
      num_wrong += tag.id > 15;
      const auto at = frame.tags.find(tag.id);
      if (at == frame.tags.end()) continue;
      const double rms_px = std::sqrt((tag.corners_px - at->second).colwise().squaredNorm().mean());
      EXPECT_LT(rms_px, 3.0) << "tag " << tag.id << " at " << frame.time_s << " s";
      off_px2 += rms_px * rms_px;
      ++num_found;
    }
  }
  RecordProperty("tags_shown", num_true);
  RecordProperty("tags_found", num_found);
  RecordProperty("corner_rms_px", fmt::format("{:.2f}", std::sqrt(off_px2 / num_found)));
  EXPECT_EQ(num_wrong, 0);
  EXPECT_GT(num_found, 0.65 * num_true);
  EXPECT_LT(std::sqrt(off_px2 / num_found), 0.6);
}

TEST(TaggedClip, IsTrackedWithTheTagsFileAsPrinted) {
  const Errors errors = Track(Sample("tags.toml"));
  EXPECT_EQ(errors.num_ok, kFrames);
  EXPECT_LT(errors.joints_mm, 110.0);
  EXPECT_LT(errors.knees_deg, 16.0);
}

TEST(TaggedClip, IsTrackedBetterWithFittedTags) {
  const ProgramRun fit = RunOnClip(
      "tags fit", With(Sample("tags.toml"), Sample("camera.yaml")) + " --out fitted.toml");
  ASSERT_EQ(fit.code, 0) << fit.err;
  const Errors errors = Track(ScratchDir() / "fitted.toml");
  EXPECT_EQ(errors.num_ok, kFrames);
  EXPECT_EQ(errors.num_flips, 0);
  EXPECT_LT(errors.joints_mm, 50.0);
  EXPECT_GT(errors.num_elbows, 20);
  EXPECT_LT(errors.elbows_deg, 6.0);
  EXPECT_GT(errors.num_knees, 40);
  EXPECT_LT(errors.knees_deg, 4.0);
}

TEST(TaggedClip, IsTrackedWithACameraThatNobodyCalibrated) {
  const ProgramRun fit = RunOnClip(
      "tags fit", fmt::format("--tags {} --out fitted.toml", Sample("tags.toml").string()));
  ASSERT_EQ(fit.code, 0) << fit.err;
  const fs::path found = ScratchDir() / "fitted.camera.yaml";
  const double focal_px = ReadCameraYaml(found).fx_px;
  const double true_px = ReadCameraYaml(Sample("camera.yaml")).fx_px;
  RecordProperty("focal_px", fmt::format("{:.0f}", focal_px));
  EXPECT_NEAR(focal_px, true_px, 0.06 * true_px);
  const Errors errors = Track(ScratchDir() / "fitted.toml", found);
  EXPECT_EQ(errors.num_ok, kFrames);
  EXPECT_EQ(errors.num_flips, 0);
  EXPECT_LT(errors.joints_mm, 60.0);
  EXPECT_LT(errors.knees_deg, 4.0);
}

}  // namespace
}  // namespace poselift
