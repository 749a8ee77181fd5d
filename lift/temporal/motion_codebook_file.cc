// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/motion_codebook_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lift/array_file.h"
#include "lift/model_header.h"
#include "lift/skeleton_check.h"
#include "src/input_error.h"

namespace poselift {
namespace {

using Json = nlohmann::ordered_json;

constexpr ArrayFileKind kKind = {.magic = "PLMOTN\r\n",
                                 .version = 2,
                                 .what = "motion codebook",
                                 .ending = ".plmotion",
                                 .command = "poselift train --motion"};
constexpr double kLongestSampleTime_s = 10.0;
constexpr double kLargestNumber = 1e3;      // radians or metres, and either per second
constexpr double kLargestRegression = 1e6;  // per second squared

// The degrees of freedom by bone and axis, then what the root has.
std::vector<std::string> FeatureNames(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Bone& bone : skeleton.bones)
    for (const Dof& dof : bone.dofs) names.push_back(bone.name + ".r" + "xyz"[dof.Axis()]);
  for (const char* name : {"height_m", "tilt_x", "tilt_z", "x_m", "z_m", "yaw"})
    names.emplace_back(name);
  return names;
}

Json ToJson(const CodebookRecord& record) {
  return {{"sources", record.sources},       {"command", record.command},
          {"commit", record.commit},         {"num_segments", record.num_segments},
          {"seed", SeedToJson(record.seed)}, {"rms_error_mm", record.rms_error_mm}};
}

CodebookRecord ReadRecord(const JsonValue& value) {
  CodebookRecord record;
  for (const JsonValue& source : value.At("sources").Items())
    record.sources.push_back(source.String());
  record.command = value.At("command").String();
  record.commit = value.At("commit").String();
  record.num_segments = ReadLargeWhole(value.At("num_segments"));
  record.seed = ReadSeed(value.At("seed"));
  record.rms_error_mm = value.At("rms_error_mm").Number();
  return record;
}

Json Header(const MotionCodebook& codebook) {
  return {{"feature_names", FeatureNames(codebook.skeleton)},
          {"samples", kSegmentSamples},
          {"sample_time_s", codebook.sample_time_s},
          {"skeleton", SkeletonToJson(codebook.skeleton)},
          {"training", ToJson(codebook.record)}};
}

// Names that do not fit the skeleton would make its numbers something else.
void CheckFeatures(const JsonValue& root, const Skeleton& skeleton) {
  const std::vector<std::string> names = FeatureNames(skeleton);
  const auto& items = ReadItems(root.At("feature_names"), names.size(),
                                fmt::format("the names of {} features", names.size()).c_str());
  for (size_t i = 0; i < names.size(); ++i)
    if (items[i].String() != names[i]) throw items[i].Unwanted(names[i]);
  if (ReadWhole(root.At("samples")) != kSegmentSamples)
    throw root.At("samples").Unwanted(std::to_string(kSegmentSamples));
}

std::string ArrayFlaw(const MotionCodebook& codebook) {
  const Eigen::Index count = codebook.segments.cols();
  if (count < 1 || codebook.rates.cols() != count || codebook.deviations.cols() != count)
    return fmt::format("has {} segments, {} rates and {} deviations, wanted as many of each", count,
                       codebook.rates.cols(), codebook.deviations.cols());
  const AccelerationModels& models = codebook.accelerations;
  if (models.means.cols() != count || models.directions.cols() != count ||
      models.responses.cols() != count || models.deviations.cols() != count)
    return fmt::format("has {} segments, and not as many regressions", count);
  if (!AllWithin(codebook.segments, kLargestNumber) || !AllWithin(codebook.rates, kLargestNumber) ||
      !AllWithin(codebook.deviations, kLargestNumber) ||
      !AllWithin(models.means, kLargestRegression) ||
      !AllWithin(models.directions, kLargestRegression) ||
      !AllWithin(models.responses, kLargestRegression) ||
      !AllWithin(models.deviations, kLargestRegression))
    return fmt::format("has a number that is not finite or beyond {:g}, {:g} in a regression",
                       kLargestNumber, kLargestRegression);
  if ((codebook.deviations.array() < 0.0f).any() || (models.deviations.array() < 0.0f).any())
    return "has a deviation below 0";
  return "";
}

std::string RecordFlaw(const CodebookRecord& record) {
  if (record.num_segments < 0)
    return fmt::format("the training record says {} segments, wanted 0 or more",
                       record.num_segments);
  if (!std::isfinite(record.rms_error_mm) || record.rms_error_mm < 0.0)
    return fmt::format("the training record says an error of {:g} mm, wanted 0 or more",
                       record.rms_error_mm);
  return "";
}

}  // namespace

std::string CodebookFlaw(const MotionCodebook& codebook) {
  for (const std::string& flaw :
       {SkeletonFlaw(codebook.skeleton), FeatureSkeletonFlaw(codebook.skeleton),
        ArrayFlaw(codebook), RecordFlaw(codebook.record)})
    if (!flaw.empty()) return flaw;
  const double time_s = codebook.sample_time_s;
  if (!(time_s > 0.0 && time_s <= kLongestSampleTime_s))
    return fmt::format("has samples {:g} s apart, wanted more than 0 and at most {:g}", time_s,
                       kLongestSampleTime_s);
  return "";
}

void WriteMotionCodebook(const MotionCodebook& codebook, const std::filesystem::path& path) {
  if (const std::string flaw = CodebookFlaw(codebook); !flaw.empty())
    throw std::invalid_argument("WriteMotionCodebook: " + flaw);
  WriteArrayFile(kKind, Header(codebook),
                 {{"segments", codebook.segments},
                  {"rates", codebook.rates},
                  {"deviations", codebook.deviations},
                  {"acceleration_means", codebook.accelerations.means},
                  {"acceleration_directions", codebook.accelerations.directions},
                  {"acceleration_responses", codebook.accelerations.responses},
                  {"acceleration_deviations", codebook.accelerations.deviations}},
                 path);
}

MotionCodebook ReadMotionCodebook(const std::filesystem::path& path) {
  const ArrayFile file(kKind, path);
  const JsonValue& root = file.Header();
  MotionCodebook codebook;
  codebook.skeleton = ReadSkeleton(root.At("skeleton"));
  CheckFeatures(root, codebook.skeleton);
  codebook.sample_time_s = root.At("sample_time_s").Number();
  codebook.record = ReadRecord(root.At("training"));
  codebook.segments = file.Read<float>("segments", kSegmentRows, 0);
  const Eigen::Index count = codebook.segments.cols();
  codebook.rates = file.Read<float>("rates", kNumFeatures, count);
  codebook.deviations = file.Read<float>("deviations", kNumFeatures, count);
  AccelerationModels& models = codebook.accelerations;
  models.means = file.Read<float>("acceleration_means", kNumFeatures, count);
  models.directions =
      file.Read<float>("acceleration_directions", kAccelerationInputs * kAccelerationRank, count);
  models.responses =
      file.Read<float>("acceleration_responses", kNumFeatures * kAccelerationRank, count);
  models.deviations = file.Read<float>("acceleration_deviations", kNumFeatures, count);
  if (const std::string flaw = CodebookFlaw(codebook); !flaw.empty()) throw InputError(path, flaw);
  return codebook;
}

}  // namespace poselift
