// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/poses_json.h"

#include <fmt/core.h>

#include <cmath>
#include <fstream>

#include "src/io/atomic_file.h"
#include "src/io/json_text.h"
#include "src/io/json_value.h"

namespace poselift {
namespace {

constexpr std::string_view kFormat = "poselift-poses";
constexpr std::string_view kAxes = "x right, y down, z forward";
constexpr int kMetreDecimals = 6, kPixelDecimals = 3, kDegreeDecimals = 3, kTimeDecimals = 6,
              kCoefficientDecimals = 6, kQuaternionDecimals = 9;
constexpr double kLargestNumber = 1e12;
constexpr double kShortestBone_m = 1e-3, kLongestBone_m = 10.0;

using NamedValues = std::vector<std::pair<std::string, double>>;

// Builds one object, with commas where they belong.
class ObjectText {
 public:
  explicit ObjectText(std::string* out) : out_(out) { *out_ += '{'; }
  void Close() { *out_ += '}'; }

  void Key(std::string_view key) {
    if (!first_) *out_ += ", ";
    first_ = false;
    AppendJsonString(key, out_);
    *out_ += ": ";
  }
  void Text(std::string_view key, std::string_view text) {
    Key(key);
    AppendJsonString(text, out_);
  }
  void Number(std::string_view key, double value, int decimals) {
    if (!std::isfinite(value)) return;
    Key(key);
    AppendJsonNumber(value, decimals, out_);
  }
  void Boolean(std::string_view key, bool value) {
    Key(key);
    *out_ += value ? "true" : "false";
  }
  template <typename Vector>
  void Numbers(std::string_view key, const Vector& values, int decimals) {
    if (!values.allFinite()) return;
    Key(key);
    *out_ += '[';
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (i > 0) *out_ += ", ";
      AppendJsonNumber(values[i], decimals, out_);
    }
    *out_ += ']';
  }

 private:
  std::string* out_;
  bool first_ = true;
};

void AppendJoints(const Pose3& joints_in_cam_m, std::string* out) {
  ObjectText joints(out);
  for (int j = 0; j < kNumJoints && j < joints_in_cam_m.cols(); ++j)
    joints.Numbers(Joints()[j].name, joints_in_cam_m.col(j), kMetreDecimals);
  joints.Close();
}

// Of joints from `first` on.
void AppendByJoint(const Eigen::VectorXd& values_m, int first, std::string* out) {
  ObjectText joints(out);
  for (int j = first; j < kNumJoints; ++j)
    joints.Number(Joints()[j].name, values_m[j], kMetreDecimals);
  joints.Close();
}

void AppendNamed(const NamedValues& values, int decimals, std::string* out) {
  ObjectText object(out);
  for (const auto& [name, value] : values) object.Number(name, value, decimals);
  object.Close();
}

void AppendAtoms(const std::vector<std::pair<int, double>>& atoms, std::string* out) {
  *out += '[';
  bool first = true;
  for (const auto& [index, coefficient] : atoms) {
    if (!std::isfinite(coefficient)) continue;
    *out += fmt::format("{}[{}, ", first ? "" : ", ", index);
    first = false;
    AppendJsonNumber(coefficient, kCoefficientDecimals, out);
    *out += ']';
  }
  *out += ']';
}

void AppendTags(const std::vector<PoseTag>& tags, std::string* out) {
  *out += '[';
  for (size_t i = 0; i < tags.size(); ++i) {
    if (i > 0) *out += ", ";
    ObjectText object(out);
    object.Number("id", tags[i].id, 0);
    object.Number("error_px", tags[i].error_px, kPixelDecimals);
    object.Boolean("believed", tags[i].believed);
    object.Boolean("ambiguous", tags[i].ambiguous);
    object.Close();
  }
  *out += ']';
}

void AppendAlternatives(const std::vector<PoseAlternative>& alternatives, std::string* out) {
  *out += '[';
  for (size_t i = 0; i < alternatives.size(); ++i) {
    if (i > 0) *out += ", ";
    ObjectText object(out);
    object.Key("joints_in_cam");
    AppendJoints(alternatives[i].joints_in_cam_m, out);
    object.Number("cost", alternatives[i].cost, kCoefficientDecimals);
    object.Number("reprojection_rms_px", alternatives[i].reprojection_rms_px, kPixelDecimals);
    object.Close();
  }
  *out += ']';
}

void AppendPerson(const PersonPose& person, std::string* out) {
  ObjectText object(out);
  object.Number("id", person.id, 0);
  object.Text("status", person.status);
  if (!person.message.empty()) object.Text("message", person.message);
  object.Key("joints_in_cam");
  AppendJoints(person.joints_in_cam_m, out);
  if (person.joints_sigma_m.size() > 0) {
    object.Key("joints_sigma_m");
    AppendByJoint(person.joints_sigma_m, 0, out);
  }
  object.Number("scale_px_per_m", person.scale_px_per_m, kMetreDecimals);
  object.Numbers("translation_px", person.translation_px, kPixelDecimals);
  object.Numbers("pelvis_in_cam", person.pelvis_in_cam_m, kMetreDecimals);
  const Eigen::Quaterniond& q = person.rotation_cam_from_body;
  object.Numbers("rotation_cam_from_body", Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()),
                 kQuaternionDecimals);
  object.Key("angles_deg");
  AppendNamed(person.angles_deg, kDegreeDecimals, out);
  if (!person.angles_sigma_deg.empty()) {
    object.Key("angles_sigma_deg");
    AppendNamed(person.angles_sigma_deg, kDegreeDecimals, out);
  }
  object.Number("reprojection_rms_px", person.reprojection_rms_px, kPixelDecimals);
  object.Key("per_joint_px");
  AppendNamed(person.per_joint_px, kPixelDecimals, out);
  if (!person.tags.empty()) {
    object.Key("tags");
    AppendTags(person.tags, out);
  }
  object.Key("atoms");
  AppendAtoms(person.atoms, out);
  object.Key("alternatives");
  AppendAlternatives(person.alternatives, out);
  object.Close();
}

void AppendFrame(const FramePoses& frame, std::string_view before_person, std::string* out) {
  ObjectText object(out);
  if (!frame.image.empty()) object.Text("image", frame.image);
  if (frame.time_s) object.Number("time_s", *frame.time_s, kTimeDecimals);
  object.Key("people");
  *out += '[';
  for (size_t i = 0; i < frame.people.size(); ++i) {
    if (i > 0) *out += ',';
    *out += before_person;
    AppendPerson(frame.people[i], out);
  }
  *out += ']';
  object.Close();
}

void AppendBodies(const std::vector<PersonBones>& bodies, std::string* out) {
  *out += "],\n \"bodies\": [";
  for (size_t i = 0; i < bodies.size(); ++i) {
    *out += i > 0 ? ",\n  " : "\n  ";
    ObjectText body(out);
    body.Number("id", bodies[i].id, 0);
    body.Key("bone_lengths_m");
    AppendByJoint(bodies[i].lengths_m, 1, out);
    body.Key("bone_sigmas_m");
    AppendByJoint(bodies[i].sigmas_m, 1, out);
    body.Close();
  }
}

double ReadNumber(const JsonValue& value) { return value.Number(-kLargestNumber, kLargestNumber); }

double ReadNumberOrUnknown(const JsonValue& object, std::string_view key) {
  const JsonValue* value = object.Find(key);
  return value ? ReadNumber(*value) : kUnknown;
}

template <int kSize>
Eigen::Matrix<double, kSize, 1> ReadNumbers(const JsonValue& list) {
  const std::vector<JsonValue>& items = list.Items();
  if (items.size() != kSize) throw list.Unwanted(fmt::format("a list of {} numbers", kSize));
  Eigen::Matrix<double, kSize, 1> numbers;
  for (int i = 0; i < kSize; ++i) numbers[i] = ReadNumber(items[static_cast<size_t>(i)]);
  return numbers;
}

Pose3 ReadJoints(const JsonValue& object) {
  Pose3 joints_in_cam_m = Pose3::Constant(3, kNumJoints, kUnknown);
  for (size_t i = 0; i < object.Members().size(); ++i) {
    const JsonValue& position = object.Members()[i];
    const auto joint = FindJoint(object.Keys()[i]);
    if (!joint) throw position.Error("found an unknown joint, wanted one of the 23");
    joints_in_cam_m.col(*joint) = ReadNumbers<3>(position);
  }
  return joints_in_cam_m;
}

NamedValues ReadNamed(const JsonValue& object) {
  NamedValues values;
  for (size_t i = 0; i < object.Members().size(); ++i)
    values.emplace_back(object.Keys()[i], ReadNumber(object.Members()[i]));
  return values;
}

Eigen::Quaterniond ReadRotation(const JsonValue& list) {
  const Eigen::Vector4d wxyz = ReadNumbers<4>(list);
  if (std::abs(wxyz.norm() - 1.0) > 1e-3)
    throw list.Error(fmt::format("found a quaternion of length {:g}, wanted 1", wxyz.norm()));
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
}

// Of joints from `first` on; 0 before.
Eigen::VectorXd ReadByJoint(const JsonValue& object, int first, double least_m, double most_m) {
  Eigen::VectorXd values_m = Eigen::VectorXd::Zero(kNumJoints);
  for (int j = first; j < kNumJoints; ++j)
    values_m[j] = object.At(Joints()[j].name).Number(least_m, most_m);
  return values_m;
}

PersonBones ReadBody(const JsonValue& json) {
  constexpr int kLargestInt = std::numeric_limits<int>::max();
  return {json.At("id").Integer(std::numeric_limits<int>::min(), kLargestInt),
          ReadByJoint(json.At("bone_lengths_m"), 1, kShortestBone_m, kLongestBone_m),
          ReadByJoint(json.At("bone_sigmas_m"), 1, 0.0, kLongestBone_m)};
}

PoseAlternative ReadAlternative(const JsonValue& json) {
  return {ReadJoints(json.At("joints_in_cam")), ReadNumberOrUnknown(json, "cost"),
          ReadNumberOrUnknown(json, "reprojection_rms_px")};
}

PoseTag ReadTag(const JsonValue& json) {
  return {json.At("id").Integer(0, std::numeric_limits<int>::max()),
          ReadNumberOrUnknown(json, "error_px"), json.At("believed").Boolean(),
          json.At("ambiguous").Boolean()};
}

PersonPose ReadPerson(const JsonValue& json) {
  constexpr int kLargestInt = std::numeric_limits<int>::max();
  PersonPose person;
  person.id = json.At("id").Integer(std::numeric_limits<int>::min(), kLargestInt);
  person.status = json.At("status").String();
  if (const JsonValue* message = json.Find("message")) person.message = message->String();
  person.joints_in_cam_m = ReadJoints(json.At("joints_in_cam"));
  if (const JsonValue* sigmas = json.Find("joints_sigma_m"))
    person.joints_sigma_m = ReadByJoint(*sigmas, 0, 0.0, kLargestNumber);
  person.scale_px_per_m = ReadNumberOrUnknown(json, "scale_px_per_m");
  if (const JsonValue* translation = json.Find("translation_px"))
    person.translation_px = ReadNumbers<2>(*translation);
  if (const JsonValue* pelvis = json.Find("pelvis_in_cam"))
    person.pelvis_in_cam_m = ReadNumbers<3>(*pelvis);
  if (const JsonValue* rotation = json.Find("rotation_cam_from_body"))
    person.rotation_cam_from_body = ReadRotation(*rotation);
  if (const JsonValue* angles = json.Find("angles_deg")) person.angles_deg = ReadNamed(*angles);
  if (const JsonValue* sigmas = json.Find("angles_sigma_deg"))
    person.angles_sigma_deg = ReadNamed(*sigmas);
  person.reprojection_rms_px = ReadNumberOrUnknown(json, "reprojection_rms_px");
  if (const JsonValue* errors = json.Find("per_joint_px")) person.per_joint_px = ReadNamed(*errors);
  if (const JsonValue* tags = json.Find("tags"))
    for (const JsonValue& tag : tags->Items()) person.tags.push_back(ReadTag(tag));
  if (const JsonValue* atoms = json.Find("atoms"))
    for (const JsonValue& atom : atoms->Items()) {
      if (atom.Items().size() != 2) throw atom.Unwanted("[index, coefficient]");
      person.atoms.emplace_back(atom.Items()[0].Integer(0, kLargestInt),
                                ReadNumber(atom.Items()[1]));
    }
  if (const JsonValue* alternatives = json.Find("alternatives"))
    for (const JsonValue& alternative : alternatives->Items())
      person.alternatives.push_back(ReadAlternative(alternative));
  return person;
}

FramePoses ReadFrame(const JsonValue& json) {
  FramePoses frame;
  if (const JsonValue* image = json.Find("image")) frame.image = image->String();
  if (const JsonValue* time = json.Find("time_s")) frame.time_s = ReadNumber(*time);
  for (const JsonValue& person : json.At("people").Items())
    frame.people.push_back(ReadPerson(person));
  return frame;
}

// The file is the head, frames with separators, the tail.
constexpr std::string_view kTail = "]}\n";
constexpr std::string_view kSource = " \"source\": \"";  // near the beginning

std::string Head(const std::vector<PersonBones>& bodies, std::string_view source = {}) {
  std::string text =
      fmt::format("{{\"format\": \"{}\", \"version\": 1, \"units\": \"m\", \"axes\": \"{}\",\n",
                  kFormat, kAxes);
  if (!source.empty()) text += fmt::format("{}{}\",\n", kSource, source);
  text += " \"joint_names\": [";
  for (int j = 0; j < kNumJoints; ++j)
    text += fmt::format("{}\"{}\"", j > 0 ? ", " : "", Joints()[j].name);
  if (!bodies.empty()) AppendBodies(bodies, &text);
  return text + "],\n \"frames\": [";
}

void AppendFrameOfList(const FramePoses& frame, bool is_first, std::string* text) {
  *text += is_first ? "\n  " : ",\n  ";
  AppendFrame(frame, "\n    ", text);
}

}  // namespace

std::string FramePosesLine(const FramePoses& frame) {
  std::string line;
  AppendFrame(frame, "", &line);
  return line + '\n';
}

FramePoses ReadFramePosesLine(std::string_view text, const std::string& file, int line) {
  return ReadFrame(JsonDocument(text, file, line).root());
}

std::string PosesJson(const Poses& poses) {
  std::string text = Head(poses.bodies);
  for (size_t i = 0; i < poses.frames.size(); ++i)
    AppendFrameOfList(poses.frames[i], i == 0, &text);
  return text.append(kTail);
}

GrowingPosesJson::GrowingPosesJson(const std::filesystem::path& path,
                                   const std::vector<PersonBones>& bodies, std::string_view source)
    : file_(path, Head(bodies, source), kTail) {}

void GrowingPosesJson::Add(const FramePoses& frame) {
  std::string text;
  AppendFrameOfList(frame, is_empty_, &text);
  file_.Append(text);
  is_empty_ = false;
}

void WritePosesJson(const Poses& poses, const std::filesystem::path& path) {
  WriteFileAtomically(path, PosesJson(poses));
}

std::string SourceOfPosesJson(const std::filesystem::path& path) {
  std::string head(512, '\0');
  std::ifstream file(path);
  file.read(head.data(), std::ssize(head));
  head.resize(static_cast<size_t>(file.gcount()));
  const size_t at = head.find(kSource);
  if (at == std::string::npos) return "";
  const size_t begin = at + kSource.size();
  return head.substr(begin, head.find('"', begin) - begin);
}

Poses ReadPosesJson(const std::filesystem::path& path) {
  const JsonDocument document(path);
  const JsonValue& root = document.root();
  if (const JsonValue& format = root.At("format"); format.String() != kFormat)
    throw format.Unwanted(fmt::format("\"{}\"", kFormat));
  if (const JsonValue& version = root.At("version"); version.Number() != 1.0)
    throw version.Unwanted("1, the version that this poselift reads");
  Poses poses;
  if (const JsonValue* bodies = root.Find("bodies"))
    for (const JsonValue& json : bodies->Items()) poses.bodies.push_back(ReadBody(json));
  for (const JsonValue& json : root.At("frames").Items()) poses.frames.push_back(ReadFrame(json));
  return poses;
}

}  // namespace poselift
