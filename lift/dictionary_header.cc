// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/dictionary_header.h"

#include <nlohmann/json.hpp>

#include "lift/model_header.h"

namespace poselift {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMirrored = "mirrored";

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
          {"seed", SeedToJson(record.seed)},
          {"rms_error_mm", record.rms_error_mm}};
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

}  // namespace

Json DictionaryHeader(const Dictionary& dictionary) {
  Json names = Json::array();
  for (const JointInfo& joint : Joints()) names.push_back(joint.name);
  return {{"joint_names", std::move(names)},
          {"skeleton", SkeletonToJson(dictionary.skeleton)},
          {"typical_norm_m", dictionary.typical_norm_m},
          {"training", ToJson(dictionary.record)}};
}

void ReadDictionaryHeader(const JsonValue& root, Dictionary* dictionary) {
  CheckJointNames(root.At("joint_names"));
  dictionary->skeleton = ReadSkeleton(root.At("skeleton"));
  dictionary->typical_norm_m = root.At("typical_norm_m").Number();
  dictionary->record = ReadRecord(root.At("training"));
}

}  // namespace poselift
