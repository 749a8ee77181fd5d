// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Label files written out by hand in the formats' own words, good and bad. One
// real COCO annotation when the data is there. Damaged files: every prefix of a
// good file and random changes must be read or refused with InputError.
#include "src/io/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "src/input_error.h"
#include "src/layout.h"
#include "tests/support/mutation.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::WriteScratch;

constexpr const char* kNative = R"({"format": "poselift-labels", "version": 1, "layout": "body15",
 "frames": [
  {"image": "a b.jpg", "width": 640, "height": 425, "time_s": 0.5, "people": [
    {"id": 3, "joints": {
      "left_knee": {"x": 429.25, "y": 294.0, "state": "visible", "radius_px": 2.0},
      "head": {"x": -3, "y": 20, "state": "occluded"},
      "neck": {"x": 1, "y": 2},
      "pelvis": {"state": "absent"}}}]},
  {"people": []}]}
)";

std::string Numbers(int count, const std::string& triple) {
  std::string numbers;
  for (int i = 0; i < count; ++i) numbers += (i > 0 ? "," : "") + triple;
  return "[" + numbers + "]";
}

std::string CocoAnnotations(const std::string& keypoints) {
  return R"({"images": [{"id": 7, "file_name": "x.jpg", "width": 64, "height": 48}],
 "annotations": [{"id": 1, "image_id": 7, "category_id": 1, "keypoints": )" +
         keypoints + "}]}";
}

Labels Read(const std::string& text, const std::string& layout = "auto") {
  return ReadLabels(WriteScratch("labels.json", text), layout);
}

// The message of the InputError that reading throws.
std::string Complaint(const std::string& text, const std::string& layout = "auto") {
  try {
    Read(text, layout);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(read without complaint)";
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

TEST(NativeLabels, AreReadWithAllTheyMaySay) {
  const Labels labels = Read(kNative);
  EXPECT_EQ(labels.layout, "body15");
  ASSERT_EQ(labels.frames.size(), 2u);
  const FrameLabels& frame = labels.frames[0];
  EXPECT_EQ(frame.image, "a b.jpg");
  EXPECT_EQ(frame.width_px, 640);
  EXPECT_EQ(frame.height_px, 425);
  EXPECT_EQ(frame.time_s, 0.5);
  ASSERT_EQ(frame.people.size(), 1u);
  EXPECT_EQ(frame.people[0].id, 3);
  const auto& landmarks = frame.people[0].landmarks;
  ASSERT_EQ(landmarks.size(), 4u);
  EXPECT_EQ(landmarks[0].name, "left_knee");
  EXPECT_EQ(landmarks[0].x_px, Eigen::Vector2d(429.25, 294));
  EXPECT_EQ(landmarks[0].radius_px, 2.0);
  EXPECT_EQ(landmarks[1].name, "head_top");
  EXPECT_EQ(landmarks[1].state, LabelState::kOccluded);
  EXPECT_EQ(landmarks[2].name, "neck");
  EXPECT_EQ(landmarks[2].state, LabelState::kVisible);
  EXPECT_EQ(landmarks[2].radius_px, std::nullopt);
  EXPECT_EQ(landmarks[3].state, LabelState::kAbsent);
  EXPECT_TRUE(labels.frames[1].people.empty());
}

TEST(NativeLabels, WrittenAndReadAgainAreTheSameFile) {
  const auto path = testing::ScratchDir() / "again.json";
  WriteLabels(Read(kNative), path);
  const auto golden = testing::SourcePath("tests/golden/labels.json");
  EXPECT_EQ(testing::FileText(path), testing::FileText(golden));
  const auto twice = testing::ScratchDir() / "twice.json";
  WriteLabels(ReadLabels(path), twice);
  EXPECT_EQ(testing::FileText(twice), testing::FileText(path));
}

TEST(NativeLabels, SayWhichFrameOfAVideoTheyAreOf) {
  const std::string timed = Replaced(kNative, R"("time_s": 0.5)", R"("time_s": 0.5, "frame": 17)");
  const auto path = testing::ScratchDir() / "frame.json";
  WriteLabels(Read(timed), path);
  EXPECT_EQ(ReadLabels(path).frames[0].frame, 17);
  EXPECT_EQ(ReadLabels(path).frames[1].frame, std::nullopt);
  const std::string negative = Replaced(kNative, R"("time_s": 0.5)", R"("frame": -1)");
  EXPECT_NE(Complaint(negative).find("frames[0].frame"), std::string::npos);
}

TEST(NativeLabels, KeepEveryDigitOfAPosition) {
  Labels labels{"body15", {FrameLabels{}}};
  labels.frames[0].people.push_back({0, {{"neck", {0.1 + 0.2, 1e-7}, LabelState::kVisible, {}}}});
  const auto path = testing::ScratchDir() / "digits.json";
  WriteLabels(labels, path);
  EXPECT_EQ(ReadLabels(path).frames[0].people[0].landmarks[0].x_px,
            Eigen::Vector2d(0.1 + 0.2, 1e-7));
}

TEST(NativeLabels, KeepWhereAnAbsentLandmarkWas) {
  Labels labels{"body15", {FrameLabels{}}};
  labels.frames[0].people.push_back({0,
                                     {{"neck", {3.25, -0.5}, LabelState::kAbsent, {}},
                                      {"pelvis", {0.0, 0.0}, LabelState::kAbsent, {}}}});
  const auto path = testing::ScratchDir() / "absent.json";
  WriteLabels(labels, path);
  EXPECT_THAT(testing::FileText(path), HasSubstr(R"("pelvis": {"state": "absent"})"));
  const auto again = ReadLabels(path).frames[0].people[0].landmarks;
  EXPECT_EQ(again[0].state, LabelState::kAbsent);
  EXPECT_EQ(again[0].x_px, Eigen::Vector2d(3.25, -0.5));
  EXPECT_EQ(again[1].x_px, Eigen::Vector2d::Zero());
}

TEST(NativeLabels, RefuseToWriteWhatIsNotFinite) {
  Labels labels{"body15", {FrameLabels{}}};
  labels.frames[0].people.push_back({0, {{"neck", {NAN, 1}, LabelState::kVisible, {}}}});
  EXPECT_THROW(WriteLabels(labels, testing::ScratchDir() / "x.json"), std::invalid_argument);
}

TEST(NativeLabels, RefuseToWriteAHintThatIsNotFinite) {
  Labels labels{"body15", {FrameLabels{}}};
  labels.frames[0].people.push_back({0, {}, {{LabelHint::Kind::kHeight, "", "", NAN}}});
  EXPECT_THROW(WriteLabels(labels, testing::ScratchDir() / "x.json"), std::invalid_argument);
}

TEST(NativeLabels, JointsBeyondTheLayoutWidenIt) {
  const Labels labels = Read(Replaced(kNative, "left_knee", "left_foot"));
  EXPECT_EQ(labels.layout, "joints23");
  EXPECT_EQ(labels.frames[0].people[0].landmarks[0].name, "left_foot");
  EXPECT_EQ(labels.frames[0].people[0].landmarks[2].name, "thorax");
}

TEST(NativeLabels, WithoutALayoutAreBody15) {
  EXPECT_EQ(Read(Replaced(kNative, R"("layout": "body15",)", "")).layout, "body15");
}

TEST(NativeLabels, MayUseTheLandmarksOfAnyLayout) {
  std::string text = Replaced(kNative, "body15", "coco17");
  text = Replaced(Replaced(text, "\"head\"", "\"left_ear\""), "\"neck\"", "\"nose\"");
  EXPECT_EQ(Read(Replaced(text, "pelvis", "left_hip")).layout, "coco17");
}

TEST(NativeLabels, ReadWindowsLineEndsAndAByteOrderMark) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : std::string(kNative)) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(Read(text).frames.size(), 2u);
  EXPECT_THAT(Complaint(text.substr(0, text.size() - 6) + "!"), HasSubstr("labels.json:9: "));
}

struct Flaw {
  const char* name;
  const char* from;
  const char* to;
  const char* line;
  const char* message;
};

class FlawedNativeLabels : public ::testing::TestWithParam<Flaw> {};

TEST_P(FlawedNativeLabels, AreRefusedWithPlaceAndReason) {
  const Flaw& flaw = GetParam();
  EXPECT_THAT(
      Complaint(Replaced(kNative, flaw.from, flaw.to)),
      AllOf(HasSubstr("labels.json:" + std::string(flaw.line) + ": "), HasSubstr(flaw.message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, FlawedNativeLabels,
    ::testing::Values(
        Flaw{"UnknownJoint", "left_knee", "left_kne", "5",
             "frames[0].people[0].joints.left_kne: found the unknown joint \"left_kne\" (layout "
             "body15), wanted perhaps \"left_knee\""},
        Flaw{"DuplicateJoint", "\"pelvis\"", "\"neck\"", "8",
             "found the key \"neck\" twice (first in line 7)"},
        Flaw{"TwoNamesOfAJoint", "\"pelvis\"", "\"thorax\"", "8",
             "found the joint neck under two names"},
        Flaw{"State", "occluded", "hidden", "6",
             "head.state: found \"hidden\", wanted visible, occluded or absent"},
        Flaw{"NegativeRadius", "\"radius_px\": 2.0", "\"radius_px\": -2.0", "5",
             "radius_px: found -2, wanted a number from 0 to 1e+06"},
        Flaw{"ZeroRadius", "\"radius_px\": 2.0", "\"radius_px\": 0", "5", "wanted a standard"},
        Flaw{"NotFinite", "429.25", "NaN", "5", "no valid JSON: "},
        Flaw{"TooLarge", "429.25", "1e999", "5", "no valid JSON: number overflow"},
        Flaw{"Far", "429.25", "4e7", "5", "left_knee.x: found 4e+07, wanted a number from"},
        Flaw{"Text", "429.25", "\"429\"", "5", "left_knee.x: found \"429\", wanted a number"},
        Flaw{"NoX", "\"x\": 429.25, ", "", "5", "left_knee: found no \"x\", wanted one"},
        Flaw{"Version", "\"version\": 1", "\"version\": 2", "1", "version: found 2, wanted 1"},
        Flaw{"Format", "poselift-labels", "poselift-poses", "1",
             "format: found \"poselift-poses\", wanted \"poselift-labels\""},
        Flaw{"Layout", "body15", "body16", "1", "layout: found \"body16\", wanted one of body15"},
        Flaw{"Width", "640", "-640", "3", "frames[0].width: found -640, wanted a whole number"},
        Flaw{"FractionOfAPixel", "640", "640.5", "3", "wanted a whole number"},
        Flaw{"Time", "0.5", "true", "3", "frames[0].time_s: found true, wanted a number"},
        Flaw{"Id", "\"id\": 3", "\"id\": 3000000000", "4", "people[0].id: found 3e+09"},
        Flaw{"Comma", "\"occluded\"},", "\"occluded\"}", "7", "no valid JSON: "},
        Flaw{"JointsAsList", "{\"state\": \"absent\"}", "[1]", "8",
             "pelvis: found a list of 1, wanted an object"}),
    [](const auto& param_info) { return param_info.param.name; });

// kNative with hints of the first person, which stand in line 8.
std::string WithHints(const std::string& hints) {
  return Replaced(kNative, "\"pelvis\": {\"state\": \"absent\"}}",
                  "\"pelvis\": {\"state\": \"absent\"}}, \"hints\": [" + hints + "]");
}

TEST(NativeLabels, SayWhatNoLandmarkShows) {
  const Labels labels = Read(
      WithHints(R"({"kind": "nearer", "joint": "left_wrist", "than": "right_hand", "metres": 0.1},
  {"kind": "towards_camera", "joint": "left_knee"}, {"kind": "away_from_camera", "joint": "head"},
  {"kind": "on_floor", "joint": "left_foot"}, {"kind": "height", "metres": 1.82},
  {"kind": "pin", "joint": "right_wrist", "x_in_cam": [0.31, -0.2, -4.5e-1]},
  {"kind": "pin", "joint": "left_foot", "metres": 0.05, "x_in_cam": [0, 1, 0]})"));
  const auto& hints = labels.frames[0].people[0].hints;
  ASSERT_EQ(hints.size(), 7u);
  EXPECT_EQ(hints[0].kind, LabelHint::Kind::kNearer);
  EXPECT_EQ(hints[0].joint, "left_wrist");
  EXPECT_EQ(hints[0].other, "right_hand");
  EXPECT_EQ(hints[0].metres_m, 0.1);
  EXPECT_EQ(hints[1].kind, LabelHint::Kind::kTowardsCamera);
  EXPECT_EQ(hints[1].metres_m, std::nullopt);
  EXPECT_EQ(hints[2].kind, LabelHint::Kind::kAwayFromCamera);
  EXPECT_EQ(hints[3].kind, LabelHint::Kind::kOnFloor);
  EXPECT_EQ(hints[3].joint, "left_foot");
  EXPECT_EQ(hints[4].kind, LabelHint::Kind::kHeight);
  EXPECT_EQ(hints[4].metres_m, 1.82);
  EXPECT_EQ(hints[5].kind, LabelHint::Kind::kPin);
  EXPECT_EQ(hints[5].x_in_cam_m, Eigen::Vector3d(0.31, -0.2, -0.45));
  EXPECT_EQ(hints[5].metres_m, std::nullopt);
  EXPECT_EQ(hints[6].metres_m, 0.05);
  EXPECT_EQ(labels.layout, "body15");

  const auto path = testing::ScratchDir() / "hints.json";
  const auto twice = testing::ScratchDir() / "hints_twice.json";
  WriteLabels(labels, path);
  const Labels again = ReadLabels(path);
  EXPECT_EQ(again.frames[0].people[0].hints.size(), 7u);
  WriteLabels(again, twice);
  EXPECT_EQ(testing::FileText(twice), testing::FileText(path));
}

struct FlawedHint {
  const char* name;
  const char* hint;
  const char* message;
};

class FlawedHints : public ::testing::TestWithParam<FlawedHint> {};

TEST_P(FlawedHints, AreRefusedWithPlaceAndReason) {
  EXPECT_THAT(Complaint(WithHints(GetParam().hint)),
              AllOf(HasSubstr("labels.json:8: "), HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, FlawedHints,
    ::testing::Values(
        FlawedHint{"Kind", R"({"kind": "closer", "joint": "neck", "than": "left_knee"})",
                   "people[0].hints[0].kind: found \"closer\", wanted one of nearer, "},
        FlawedHint{"NoKind", R"({"joint": "neck"})", "found no \"kind\""},
        FlawedHint{"Joint", R"({"kind": "on_floor", "joint": "left_ankel"})",
                   "hints[0]: found a hint of the unknown joint \"left_ankel\", wanted perhaps "
                   "\"left_ankle\""},
        FlawedHint{"Other", R"({"kind": "nearer", "joint": "neck", "than": "tail"})", "\"tail\""},
        FlawedHint{"NoOther", R"({"kind": "nearer", "joint": "neck"})", "found no \"than\""},
        FlawedHint{"Itself", R"({"kind": "nearer", "joint": "neck", "than": "neck"})",
                   "neck nearer than itself"},
        FlawedHint{"BoneOfThePelvis", R"({"kind": "towards_camera", "joint": "pelvis"})",
                   "found a bone that ends at \"pelvis\""},
        FlawedHint{"Height", R"({"kind": "height", "metres": 182})", "found a height of 182 m"},
        FlawedHint{"NoHeight", R"({"kind": "height"})", "found no \"metres\""},
        FlawedHint{"TwoHeights",
                   R"({"kind": "height", "metres": 1.8}, {"kind": "height", "metres": 1.7})",
                   "hints[1]: found a second height"},
        FlawedHint{"HowFarAboveTheFloor",
                   R"({"kind": "on_floor", "joint": "left_foot", "metres": 0.3})",
                   "found metres of left_foot on the floor, wanted none"},
        FlawedHint{"HowFarFromAPin",
                   R"({"kind": "pin", "joint": "neck", "metres": 0, "x_in_cam": [0, 0, 0]})",
                   "found a pin known to 0 m, wanted 0.001 to 10"},
        FlawedHint{"NotFinite", R"({"kind": "height", "metres": NaN})", "no valid JSON"},
        FlawedHint{"Negative",
                   R"({"kind": "towards_camera", "joint": "left_knee", "metres": -0.1})",
                   "found -0.1 m"},
        FlawedHint{"PinOfTwo", R"({"kind": "pin", "joint": "neck", "x_in_cam": [1, 2]})",
                   "wanted three metres from the pelvis"},
        FlawedHint{"FarPin", R"({"kind": "pin", "joint": "neck", "x_in_cam": [1, 2, 300]})",
                   "found a pin at (1, 2, 300)"},
        FlawedHint{"NoList", R"(5)", "hints[0]: found 5, wanted an object"}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(NativeLabels, RefuseTwoPeopleWithOneId) {
  EXPECT_THAT(Complaint(R"({"format": "poselift-labels", "version": 1, "frames": [
    {"people": [{"id": 1, "joints": {}}, {"id": 1, "joints": {}}]}]})"),
              HasSubstr("people[1]: found a second person with the id 1"));
}

TEST(Labels, RefuseWhatIsNoLabelFile) {
  EXPECT_THAT(Complaint(""), HasSubstr("labels.json:1: no valid JSON"));
  EXPECT_THAT(Complaint("{}"), HasSubstr("labels.json:1: found JSON without labels"));
  EXPECT_THAT(Complaint("3"), HasSubstr("found JSON without labels (a single value)"));
  EXPECT_THAT(Complaint(R"({"a": 1, "b": 2})"), HasSubstr(R"((an object with "a", "b"))"));
  EXPECT_THAT(Complaint("[]"), HasSubstr("found nothing with \"keypoints\""));
  EXPECT_THAT(Complaint("[1]"), HasSubstr("[0]: found 1, wanted an object"));
  EXPECT_THAT(Complaint("{\"people\": \"\xff\"}"), HasSubstr("no valid JSON"));
  EXPECT_THAT(Complaint(kNative, "body51"), HasSubstr("found the layout \"body51\", wanted auto"));
  EXPECT_THROW(ReadLabels("/nonexistent/labels.json"), InputError);
  EXPECT_THROW(ReadLabels(testing::ScratchDir()), InputError);
}

TEST(Labels, RefuseDeepNestingWithoutDeepRecursion) {
  const std::string deep(1000000, '[');
  EXPECT_THAT(Complaint(deep), HasSubstr("more than 64 levels"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"people\":";
  EXPECT_THAT(Complaint(objects), HasSubstr("more than 64 levels"));
}

TEST(CocoLabels, ReadVisibilityAndWholePixels) {
  const Labels labels =
      Read(CocoAnnotations("[10,20,2, 0,0,0, 11,21,1, " + Numbers(14, "1.5,2,2").substr(1)));
  EXPECT_EQ(labels.layout, "coco17");
  ASSERT_EQ(labels.frames.size(), 1u);
  EXPECT_EQ(labels.frames[0].image, "x.jpg");
  EXPECT_EQ(labels.frames[0].width_px, 64);
  const auto& landmarks = labels.frames[0].people.at(0).landmarks;
  EXPECT_EQ(landmarks[0].name, "nose");
  EXPECT_EQ(landmarks[0].x_px, Eigen::Vector2d(10, 20));
  EXPECT_EQ(landmarks[0].state, LabelState::kVisible);
  EXPECT_EQ(landmarks[1].state, LabelState::kAbsent);
  EXPECT_EQ(landmarks[2].state, LabelState::kOccluded);
  EXPECT_EQ(landmarks[16].name, "right_ankle");
}

TEST(CocoLabels, TakeTheOrderOfTheCategorysNames) {
  const std::string text = R"({"images": [{"id": "a", "filename": "v.jpg"}],
    "categories": [{"id": 1, "keypoints": ["Left Knee", "pelvis", "neck"]}],
    "annotations": [{"image_id": "a", "track_id": 5, "keypoints": [1,2,2, 3,4,2, 5,6,2]}]})";
  const Labels labels = Read(text);
  EXPECT_EQ(labels.layout, "body15");
  EXPECT_EQ(labels.frames[0].image, "v.jpg");
  EXPECT_EQ(labels.frames[0].people[0].id, 5);
  EXPECT_EQ(labels.frames[0].people[0].landmarks[0].name, "left_knee");
  EXPECT_THAT(Complaint(Replaced(text, "pelvis", "tail")), HasSubstr("categories[0].keypoints"));
  EXPECT_THAT(Complaint(Replaced(text, "pelvis", "neck")), HasSubstr("\"neck\" twice"));
}

TEST(CocoLabels, ResultsAreAListWithScores) {
  const std::string text = R"([
   {"image_id": "b.jpg", "score": 2.9, "keypoints": [-1,-1,0, 5,6,0.9, 7,8,0.1, )" +
                           Numbers(14, "1,1,1.0").substr(1) + R"(},
   {"image_id": "a.jpg", "keypoints": )" +
                           Numbers(17, "3,4,0.5") + R"(},
   {"image_id": "b.jpg", "keypoints": )" +
                           Numbers(17, "9,9,1") + "}]";
  const Labels labels = Read(text);
  ASSERT_EQ(labels.frames.size(), 2u);
  EXPECT_EQ(labels.frames[0].image, "b.jpg");
  EXPECT_EQ(labels.frames[1].image, "a.jpg");
  ASSERT_EQ(labels.frames[0].people.size(), 2u);
  EXPECT_EQ(labels.frames[0].people[1].id, 1);
  const auto& landmarks = labels.frames[0].people[0].landmarks;
  EXPECT_EQ(landmarks[0].state, LabelState::kAbsent);
  EXPECT_EQ(landmarks[1].state, LabelState::kVisible);
  EXPECT_EQ(landmarks[2].state, LabelState::kOccluded);
  EXPECT_EQ(landmarks[3].state, LabelState::kVisible);
}

TEST(CocoLabels, LeaveOutPeopleWithoutALabelledJoint) {
  EXPECT_TRUE(Read(CocoAnnotations(Numbers(17, "0,0,0"))).frames[0].people.empty());
}

TEST(CocoLabels, RefuseWhatDoesNotFit) {
  EXPECT_THAT(Complaint(CocoAnnotations(Numbers(16, "1,1,2"))),
              HasSubstr("annotations[0].keypoints: found a list of 48, wanted"));
  EXPECT_THAT(Complaint(CocoAnnotations(Numbers(17, "1,1,2")), "body15"),
              HasSubstr("wanted 45 values"));
  EXPECT_THAT(Complaint(CocoAnnotations(Numbers(17, "1,1,3"))),
              HasSubstr("keypoints[2]: found 3, wanted a number from 0 to 2"));
  EXPECT_THAT(Complaint(Replaced(CocoAnnotations(Numbers(17, "1,1,2")), "\"image_id\": 7",
                                 "\"image_id\": 8")),
              HasSubstr("labels.json:2: annotations[0].image_id: found 8, wanted the id of one"));
  EXPECT_THAT(Complaint(R"({"annotations": [{"bbox": []}]})"), HasSubstr("no"));
}

TEST(CocoLabels, ReadARealAnnotation) {
  POSELIFT_DATA_OR_SKIP(data);
  const Labels labels = ReadLabels(data / "photos/skier.coco.json");
  EXPECT_EQ(labels.layout, "coco17");
  ASSERT_EQ(labels.frames.size(), 1u);
  EXPECT_EQ(labels.frames[0].image, "skier.jpg");
  ASSERT_EQ(labels.frames[0].people.size(), 1u);
  const auto& landmarks = labels.frames[0].people[0].landmarks;
  ASSERT_EQ(landmarks.size(), 17u);
  EXPECT_EQ(landmarks[13].name, "left_knee");
  EXPECT_EQ(landmarks[13].x_px, Eigen::Vector2d(429, 294));
}

std::string OpenPose(const std::string& key, const std::string& numbers) {
  return R"({"version": 1.3, "people": [{"person_id": [-1], ")" + key + "\": " + numbers + "}]}";
}

TEST(OpenPoseLabels, ReadBody25AndCoco18) {
  const std::string body25 = OpenPose(
      "pose_keypoints_2d", "[0,0,0, 320.5,100,0.8, 3,4,0.2, " + Numbers(22, "50,60,0.7").substr(1));
  const Labels labels = Read(body25);
  EXPECT_EQ(labels.layout, "openpose25");
  const auto& landmarks = labels.frames.at(0).people.at(0).landmarks;
  EXPECT_EQ(landmarks[0].state, LabelState::kAbsent);
  EXPECT_EQ(landmarks[1].name, "neck");
  EXPECT_EQ(landmarks[1].x_px, Eigen::Vector2d(320.5, 100));
  EXPECT_EQ(landmarks[2].state, LabelState::kOccluded);
  EXPECT_EQ(landmarks[8].name, "mid_hip");
  EXPECT_EQ(Read(OpenPose("pose_keypoints", Numbers(18, "5,5,1"))).layout, "openpose18");
}

TEST(OpenPoseLabels, MayHaveNobodyOrAnEmptyBody) {
  EXPECT_TRUE(Read(R"({"version": 1.3, "people": []})").frames.at(0).people.empty());
  EXPECT_TRUE(Read(OpenPose("pose_keypoints_2d", "[]")).frames.at(0).people.empty());
}

TEST(OpenPoseLabels, OfAFolderAreFramesInTheOrderOfTheirNames) {
  const auto folder = testing::ScratchDir();
  for (const int frame : {2, 0, 1})
    WriteScratch("v_00000000000" + std::to_string(frame) + "_keypoints.json",
                 frame == 1 ? R"({"version": 1.3, "people": []})"
                            : OpenPose("pose_keypoints_2d",
                                       Numbers(25, std::to_string(10 + frame) + ",9,1")));
  WriteScratch("notes.json", "no JSON");
  const Labels labels = ReadLabels(folder);
  ASSERT_EQ(labels.frames.size(), 3u);
  EXPECT_EQ(labels.frames[0].people.at(0).landmarks[0].x_px.x(), 10);
  EXPECT_TRUE(labels.frames[1].people.empty());
  EXPECT_EQ(labels.frames[2].people.at(0).landmarks[0].x_px.x(), 12);
}

TEST(OpenPoseLabels, RefuseRelativeCoordinatesAndOtherModels) {
  EXPECT_THAT(Complaint(OpenPose("pose_keypoints_2d", Numbers(25, "0.5,0.7,1"))),
              HasSubstr("between 0 and 1 (--keypoint_scale 3), wanted pixels"));
  EXPECT_THAT(Complaint(OpenPose("pose_keypoints_2d", Numbers(25, "-0.5,0.7,1"))),
              HasSubstr("between -1 and 1 (--keypoint_scale 4), wanted pixels"));
  EXPECT_THAT(Complaint(OpenPose("pose_keypoints_2d", Numbers(15, "5,7,1"))),
              HasSubstr("found a list of 45, wanted 75 values (BODY_25) or 54 (COCO-18)"));
  EXPECT_THAT(Complaint(R"({"people": [{}]})"), HasSubstr("people[0]: found no"));
}

}  // namespace
}  // namespace poselift
