// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/dictionary_header.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "src/io/json_value.h"

namespace poselift {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kDofKinds = {"rx", "ry", "rz", "tx", "ty", "tz"};
constexpr std::string_view kNumberType = "float64";
constexpr std::string_view kMirrored = "mirrored";
constexpr double kLargestExactWhole = 9007199254740992.0;  // 2^53

Json ToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// JSON has no infinity: null says that there is no limit.
Json LimitToJson(double limit) { return std::isfinite(limit) ? Json(limit) : Json(nullptr); }

Json ToJson(const Bone& bone) {
  Json dofs = Json::array();
  for (const Dof& dof : bone.dofs)
    dofs.push_back({{"kind", kDofKinds[static_cast<size_t>(dof.kind)]},
                    {"lower", LimitToJson(dof.lower)},
                    {"upper", LimitToJson(dof.upper)}});
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(ToJson(bone.rest_from_axis.row(i).transpose()));
  return {{"name", bone.name},
          {"parent", bone.parent},
          {"offset_m", ToJson(bone.offset_m)},
          {"tip_m", ToJson(bone.tip_m)},
          {"rest_from_axis", std::move(rows)},
          {"dofs", std::move(dofs)}};
}

Json ToJson(const TrainingRecord& record) {
  Json augmentation = Json::array();
  if (record.mirrored) augmentation.push_back(kMirrored);
  return {{"sources", record.sources},
          {"command", record.command},
          {"commit", record.commit},
          {"num_poses", record.num_poses},
          {"augmentation", std::move(augmentation)},
          {"sparsity", record.sparsity},
          {"num_subsets", record.num_subsets},
          // A string: readers of JSON round numbers beyond 2^53.
          {"seed", std::to_string(record.seed)},
          {"rms_error_mm", record.rms_error_mm}};
}

int ReadWhole(const JsonValue& value) { return value.Integer(0, std::numeric_limits<int>::max()); }

std::int64_t ReadLargeWhole(const JsonValue& value) {
  const double number = value.Number(0.0, kLargestExactWhole);
  if (number != std::floor(number)) throw value.Unwanted("a whole number");
  return static_cast<std::int64_t>(number);
}

const std::vector<JsonValue>& ReadItems(const JsonValue& value, size_t count, const char* wanted) {
  if (value.Items().size() != count) throw value.Unwanted(wanted);
  return value.Items();
}

Eigen::Vector3d ReadVector3(const JsonValue& value) {
  const auto& items = ReadItems(value, 3, "a list of 3 numbers");
  return {items[0].Number(), items[1].Number(), items[2].Number()};
}

Dof ReadDof(const JsonValue& value) {
  const JsonValue& kind = value.At("kind");
  Dof dof;
  const auto found = std::find(kDofKinds.begin(), kDofKinds.end(), kind.String());
  if (found == kDofKinds.end()) throw kind.Unwanted("rx, ry, rz, tx, ty or tz");
  dof.kind = static_cast<Dof::Kind>(found - kDofKinds.begin());
  if (const JsonValue* lower = value.Find("lower")) dof.lower = lower->Number();
  if (const JsonValue* upper = value.Find("upper")) dof.upper = upper->Number();
  return dof;
}

Bone ReadBone(const JsonValue& value) {
  Bone bone;
  bone.name = value.At("name").String();
  bone.parent = value.At("parent").Integer(-1, kNumJoints - 1);
  bone.offset_m = ReadVector3(value.At("offset_m"));
  bone.tip_m = ReadVector3(value.At("tip_m"));
  const auto& rows = ReadItems(value.At("rest_from_axis"), 3, "a list of 3 rows");
  for (int i = 0; i < 3; ++i) bone.rest_from_axis.row(i) = ReadVector3(rows[i]).transpose();
  for (const JsonValue& dof : value.At("dofs").Items()) bone.dofs.push_back(ReadDof(dof));
  return bone;
}

unsigned long ReadSeed(const JsonValue& value) {
  const std::string& digits = value.String();
  unsigned long seed = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, seed);
  if (error != std::errc() || stop != end) throw value.Unwanted("a whole number in quotes");
  return seed;
}

TrainingRecord ReadRecord(const JsonValue& value) {
  TrainingRecord record;
  for (const JsonValue& source : value.At("sources").Items())
    record.sources.push_back(source.String());
  record.command = value.At("command").String();
  record.commit = value.At("commit").String();
  record.num_poses = ReadLargeWhole(value.At("num_poses"));
  for (const JsonValue& item : value.At("augmentation").Items()) {
    if (item.String() != kMirrored) throw item.Unwanted("\"mirrored\"");
    record.mirrored = true;
  }
  record.sparsity = ReadWhole(value.At("sparsity"));
  record.num_subsets = ReadWhole(value.At("num_subsets"));
  record.seed = ReadSeed(value.At("seed"));
  record.rms_error_mm = value.At("rms_error_mm").Number();
  return record;
}

void CheckJointNames(const JsonValue& names) {
  const auto& items = ReadItems(names, kNumJoints, "a list of 23 joint names");
  for (int j = 0; j < kNumJoints; ++j)
    if (items[j].String() != Joints()[j].name)
      throw items[j].Unwanted(std::string(Joints()[j].name));
}

std::vector<StoredArray> ReadArrayTable(const JsonValue& table) {
  std::vector<StoredArray> arrays;
  for (size_t i = 0; i < table.Members().size(); ++i) {
    const JsonValue& row = table.Members()[i];
    if (row.At("type").String() != kNumberType) throw row.At("type").Unwanted("float64");
    arrays.push_back({table.Keys()[i], ReadWhole(row.At("rows")), ReadWhole(row.At("cols")),
                      static_cast<std::uint64_t>(ReadLargeWhole(row.At("offset")))});
  }
  return arrays;
}

}  // namespace

std::string DictionaryHeaderText(const Dictionary& dictionary,
                                 const std::vector<StoredArray>& arrays) {
  Json names = Json::array();
  for (const JointInfo& joint : Joints()) names.push_back(joint.name);
  Json bones = Json::array();
  for (const Bone& bone : dictionary.skeleton.bones) bones.push_back(ToJson(bone));
  Json table = Json::object();
  for (const StoredArray& array : arrays)
    table[array.name] = {{"type", kNumberType},
                         {"rows", array.rows},
                         {"cols", array.cols},
                         {"offset", array.offset}};
  const Json header = {
      {"joint_names", std::move(names)},
      {"skeleton", {{"name", dictionary.skeleton.name}, {"bones", std::move(bones)}}},
      {"typical_norm_m", dictionary.typical_norm_m},
      {"training", ToJson(dictionary.record)},
      {"arrays", std::move(table)}};
  return header.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<StoredArray> ParseDictionaryHeader(std::string_view text, const std::string& file,
                                               Dictionary* dictionary) {
  const JsonDocument document(text, file);
  const JsonValue& root = document.root();
  CheckJointNames(root.At("joint_names"));
  const JsonValue& skeleton = root.At("skeleton");
  dictionary->skeleton.name = skeleton.At("name").String();
  for (const JsonValue& bone : ReadItems(skeleton.At("bones"), kNumJoints, "a list of 23 bones"))
    dictionary->skeleton.bones.push_back(ReadBone(bone));
  dictionary->typical_norm_m = root.At("typical_norm_m").Number();
  dictionary->record = ReadRecord(root.At("training"));
  return ReadArrayTable(root.At("arrays"));
}

}  // namespace poselift
