// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Results with made-up numbers, written to poses.json and angles.csv, compared
// with golden files and read back.
#include "src/poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "src/input_error.h"
#include "src/io/angles_csv.h"
#include "src/io/poses_json.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::FileText;
using ::testing::HasSubstr;
using testing::MatrixNear;
using ::testing::Not;
using testing::SourcePath;
using testing::WriteScratch;

PersonPose MadeUpPerson() {
  PersonPose person;
  person.id = 4;
  person.status = "ok";
  for (int j = 0; j < kNumJoints; ++j)
    person.joints_in_cam_m.col(j) << 0.01 * j, -0.5 + 0.0625 * j, 1.0 / 3.0 * j;
  person.joints_in_cam_m.col(joint::kLeftHand).setConstant(kUnknown);
  person.scale_px_per_m = 183.25;
  person.translation_px << 320.1234, 240;
  person.rotation_cam_from_body = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY());
  person.angles_deg = {{"left_elbow.flexion", 31.25}, {"left_knee.flexion", kUnknown}};
  person.reprojection_rms_px = 1.7;
  person.per_joint_px = {{"left_knee", 2.0004}};
  person.atoms = {{17, 0.75}, {3, -1.5e-3}};
  person.alternatives.push_back({person.joints_in_cam_m, 3.1, 1.9});
  return person;
}

Poses MadeUpPoses() {
  Poses poses;
  poses.frames.push_back({"a \"b\".jpg", 0.0, {MadeUpPerson()}});
  PersonPose failed;
  failed.id = 4;
  failed.status = "failed";
  failed.message = "found 2 joints, wanted 4";
  PersonPose other = MadeUpPerson();
  other.id = 1;
  poses.frames.push_back({"", 1.0 / 30, {other, failed}});
  poses.frames.push_back({});
  return poses;
}

TEST(PosesJson, IsTheGoldenFile) {
  const auto path = testing::ScratchDir() / "poses.json";
  WritePosesJson(MadeUpPoses(), path);
  EXPECT_EQ(FileText(path), FileText(SourcePath("tests/golden/poses.json")));
}

TEST(PosesJson, NeverHoldsNaNOrInfinity) {
  Poses poses = MadeUpPoses();
  PersonPose& person = poses.frames[0].people[0];
  person.reprojection_rms_px = std::numeric_limits<double>::infinity();
  person.atoms.emplace_back(5, kUnknown);
  person.rotation_cam_from_body.x() = kUnknown;
  const std::string text = PosesJson(poses);
  for (const char* word : {"nan", "NaN", "inf", "null"}) EXPECT_THAT(text, Not(HasSubstr(word)));
  EXPECT_EQ(ReadPosesJson(WriteScratch("p.json", text)).frames.size(), 3u);
}

TEST(PosesJson, ReadBackIsTheSameUpToRounding) {
  const Poses poses = ReadPosesJson(WriteScratch("poses.json", PosesJson(MadeUpPoses())));
  ASSERT_EQ(poses.frames.size(), 3u);
  EXPECT_EQ(poses.frames[0].image, "a \"b\".jpg");
  EXPECT_NEAR(poses.frames[1].time_s.value(), 1.0 / 30, 1e-6);
  EXPECT_EQ(poses.frames[2].time_s, std::nullopt);
  ASSERT_EQ(poses.frames[0].people.size(), 1u);
  const PersonPose expected = MadeUpPerson();
  const PersonPose& person = poses.frames[0].people[0];
  EXPECT_EQ(person.id, expected.id);
  EXPECT_EQ(person.status, "ok");
  EXPECT_TRUE(person.joints_in_cam_m.col(joint::kLeftHand).hasNaN());
  EXPECT_TRUE(MatrixNear(person.joints_in_cam_m.leftCols(18), expected.joints_in_cam_m.leftCols(18),
                         0.51e-6));
  EXPECT_EQ(person.scale_px_per_m, expected.scale_px_per_m);
  EXPECT_TRUE(MatrixNear(person.translation_px, expected.translation_px, 0.51e-3));
  EXPECT_LT(person.rotation_cam_from_body.angularDistance(expected.rotation_cam_from_body), 1e-7);
  EXPECT_TRUE(person.angles_sigma_deg.empty());
  ASSERT_EQ(person.angles_deg.size(), 1u);  // the unknown one is not in the file
  EXPECT_EQ(person.angles_deg[0], expected.angles_deg[0]);
  EXPECT_EQ(person.reprojection_rms_px, 1.7);
  EXPECT_EQ(person.per_joint_px[0].second, 2.0);
  EXPECT_EQ(person.atoms, expected.atoms);
  ASSERT_EQ(person.alternatives.size(), 1u);
  EXPECT_EQ(person.alternatives[0].cost, 3.1);
  const PersonPose& failed = poses.frames[1].people[1];
  EXPECT_EQ(failed.message, "found 2 joints, wanted 4");
  EXPECT_TRUE(failed.joints_in_cam_m.array().isNaN().all());
  EXPECT_TRUE(std::isnan(failed.scale_px_per_m));
}

TEST(PosesJson, SaysHowSurePosesAreWhereThatIsKnown) {
  Poses poses = MadeUpPoses();
  EXPECT_THAT(PosesJson(poses), Not(HasSubstr("sigma")));
  poses.frames[0].people[0].angles_sigma_deg = {{"left_elbow.flexion", 2.5}};
  poses.frames[0].people[0].joints_sigma_m = Eigen::VectorXd::LinSpaced(kNumJoints, 0.0, 0.22);
  const Poses back = ReadPosesJson(WriteScratch("poses.json", PosesJson(poses)));
  EXPECT_EQ(back.frames[0].people[0].angles_sigma_deg, poses.frames[0].people[0].angles_sigma_deg);
  EXPECT_TRUE(back.frames[1].people[0].angles_sigma_deg.empty());
  EXPECT_TRUE(MatrixNear(back.frames[0].people[0].joints_sigma_m,
                         poses.frames[0].people[0].joints_sigma_m, 1e-6));
  EXPECT_EQ(back.frames[1].people[0].joints_sigma_m.size(), 0);
}

TEST(PosesJson, NamesTheTagsWhereThereAreAny) {
  Poses poses = MadeUpPoses();
  EXPECT_THAT(PosesJson(poses), Not(HasSubstr("tags")));
  poses.frames[0].people[0].tags = {{3, 0.41, true, false}, {12, kUnknown, false, true}};
  EXPECT_THAT(PosesJson(poses), HasSubstr("\"tags\": [{\"id\": 3, \"error_px\": 0.41, "
                                          "\"believed\": true, \"ambiguous\": false}, "
                                          "{\"id\": 12, \"believed\": false, "
                                          "\"ambiguous\": true}]"));
  const Poses back = ReadPosesJson(WriteScratch("poses.json", PosesJson(poses)));
  const std::vector<PoseTag>& tags = back.frames[0].people[0].tags;
  ASSERT_EQ(tags.size(), 2u);
  EXPECT_EQ(tags[0].id, 3);
  EXPECT_EQ(tags[0].error_px, 0.41);
  EXPECT_TRUE(tags[0].believed);
  EXPECT_FALSE(tags[0].ambiguous);
  EXPECT_EQ(tags[1].id, 12);
  EXPECT_TRUE(std::isnan(tags[1].error_px));
  EXPECT_FALSE(tags[1].believed);
  EXPECT_TRUE(tags[1].ambiguous);
  EXPECT_TRUE(back.frames[1].people[0].tags.empty());
  const FramePoses line = ReadFramePosesLine(FramePosesLine(poses.frames[0]), "line", 1);
  EXPECT_EQ(line.people[0].tags.size(), 2u);
  std::string text = PosesJson(poses);
  text.replace(text.find("\"believed\": true"), 16, "\"believed\": 1");
  EXPECT_THROW(ReadPosesJson(WriteScratch("poses.json", text)), InputError);
}

TEST(PosesJson, GrowsToTheSameFile) {
  Poses poses = MadeUpPoses();
  for (const bool has_bodies : {false, true}) {
    if (has_bodies)
      poses.bodies.push_back({4, Eigen::VectorXd::Constant(kNumJoints, 0.3),
                              Eigen::VectorXd::Constant(kNumJoints, 0.01)});
    const auto path = testing::ScratchDir() / "poses.json";
    GrowingPosesJson growing(path, poses.bodies);
    Poses so_far{{}, poses.bodies};
    EXPECT_EQ(FileText(path), PosesJson(so_far));
    for (const FramePoses& frame : poses.frames) {
      growing.Add(frame);
      so_far.frames.push_back(frame);
      EXPECT_EQ(FileText(path), PosesJson(so_far));
    }
  }
}

TEST(PosesJson, OfThousandsOfFramesGrowsWithTheirNumber) {
  Poses poses;
  for (int f = 0; f < 5000; ++f) poses.frames.push_back({"", f / 30.0, {MadeUpPerson()}});
  const std::string text = PosesJson(poses);
  EXPECT_LT(text.size(), 5000u * 4000u);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 5000 * 2 + 1);
}

TEST(PosesJson, BodiesAreReadBack) {
  Poses poses = MadeUpPoses();
  const Eigen::VectorXd lengths_m = Eigen::VectorXd::LinSpaced(kNumJoints, 0.0, 0.44);
  poses.bodies.push_back({4, lengths_m, 0.01 * lengths_m});
  const auto path = WriteScratch("bodies.json", PosesJson(poses));
  const Poses back = ReadPosesJson(path);
  ASSERT_EQ(back.bodies.size(), 1U);
  EXPECT_EQ(back.bodies[0].id, 4);
  EXPECT_TRUE(MatrixNear(back.bodies[0].lengths_m, lengths_m, 1e-6));
  EXPECT_TRUE(MatrixNear(back.bodies[0].sigmas_m, 0.01 * lengths_m, 1e-6));
  poses.bodies[0].lengths_m[3] = 0.0;
  EXPECT_THROW(ReadPosesJson(WriteScratch("bodies.json", PosesJson(poses))), InputError);
}

TEST(PosesJson, RefusesWhatDoesNotFit) {
  const std::string good = PosesJson(MadeUpPoses());
  const auto complaint = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    try {
      ReadPosesJson(WriteScratch("bad.json", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "(read without complaint)";
  };
  EXPECT_THAT(complaint("poselift-poses", "poselift-labels"), HasSubstr("format: found"));
  EXPECT_THAT(complaint("\"left_hip\": [", "\"left_hop\": ["), HasSubstr("unknown joint"));
  EXPECT_THAT(complaint("\"left_hip\": [", "\"left_hip\": [1, "),
              HasSubstr("bad.json:5: frames[0].people[0].joints_in_cam.left_hip: found a list of "
                        "4, wanted a list of 3 numbers"));
  EXPECT_THAT(complaint("[0.9", "[3.9"), HasSubstr("found a quaternion of length"));
  EXPECT_THAT(complaint("[17, ", "[-17, "), HasSubstr("found -17, wanted a whole number"));
}

TEST(AnglesCsv, FollowsTheFirstPersonAndLeavesTheUnknownEmpty) {
  Poses poses = MadeUpPoses();
  poses.frames[2].people.push_back(MadeUpPerson());
  poses.frames[2].people[0].angles_deg = {{"new, \"quoted\"", -0.0001},
                                          {"left_knee.flexion", 1e-9}};
  EXPECT_EQ(AnglesCsv(poses),
            "frame,time_s,left_elbow.flexion,left_knee.flexion,\"new, \"\"quoted\"\"\"\r\n"
            "0,0,31.25,,\r\n"
            "1,0.033333,,,\r\n"
            "2,,,0,0\r\n");
  const auto path = testing::ScratchDir() / "angles.csv";
  WriteAnglesCsv(poses, path);
  EXPECT_EQ(FileText(path), AnglesCsv(poses));
}

TEST(AnglesCsv, TheSigmasHaveATableOfTheirOwn) {
  Poses poses = MadeUpPoses();
  const std::string angles = AnglesCsv(poses);
  poses.frames[0].people[0].angles_sigma_deg = {{"left_elbow.flexion", 2.5}};
  EXPECT_EQ(AnglesCsv(poses), angles);
  EXPECT_EQ(AnglesSigmaCsv(poses),
            "frame,time_s,left_elbow.flexion\r\n0,0,2.5\r\n1,0.033333,\r\n2,,\r\n");
}

TEST(AnglesCsv, GrowsToTheSameFileWithTheColumnsNamed) {
  const Poses poses = MadeUpPoses();
  const auto path = testing::ScratchDir() / "angles.csv";
  GrowingAnglesCsv growing(path, &PersonPose::angles_deg, {"left_elbow.flexion", "of, none"});
  EXPECT_EQ(FileText(path), "frame,time_s,left_elbow.flexion,\"of, none\"\r\n");
  for (const FramePoses& frame : poses.frames) growing.Add(frame);
  growing.Close();
  EXPECT_EQ(
      FileText(path),
      "frame,time_s,left_elbow.flexion,\"of, none\"\r\n0,0,31.25,\r\n1,0.033333,,\r\n2,,,\r\n");
}

TEST(AnglesCsv, OfNobodyHasOnlyFrames) {
  Poses poses;
  poses.frames.resize(2);
  EXPECT_EQ(AnglesCsv(poses), "frame,time_s\r\n0,\r\n1,\r\n");
}

}  // namespace
}  // namespace poselift
