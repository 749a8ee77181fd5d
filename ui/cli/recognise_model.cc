// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <nlohmann/json.hpp>

#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/forward_kinematics.h"
#include "ui/cli/recognisers.h"

namespace poselift::cli {
namespace {

// From the soles to the crown of who stands at rest; y is up.
double Height(const Skeleton& skeleton) {
  const Pose3 joints_m = JointPositions(skeleton, SkeletonPose::Rest(skeleton));
  return joints_m.row(1).maxCoeff() - joints_m.row(1).minCoeff();
}

}  // namespace

bool IsDictionary(const std::filesystem::path& path, std::string_view head) {
  return HasEnding(path, ".pldict") || head.starts_with("PLDICT");
}

nlohmann::ordered_json DescribeDictionary(const std::filesystem::path& path) {
  const Dictionary dictionary = ReadDictionary(path);
  const TrainingRecord& record = dictionary.record;
  return {{"atoms", dictionary.NumAtoms()},
          {"pose_prior", !dictionary.prior.Empty()},
          {"bones", dictionary.skeleton.bones.size()},
          {"height_m", Height(dictionary.skeleton)},
          {"training_files", record.sources.size()},
          {"training_poses", record.num_poses},
          {"mirrored", record.mirrored},
          {"sparsity", record.sparsity},
          {"rms_error_mm", record.rms_error_mm},
          {"subsets", record.num_subsets},
          {"seed", record.seed},
          {"commit", record.commit},
          {"command", record.command}};
}

bool IsMotionCodebook(const std::filesystem::path& path, std::string_view head) {
  return HasEnding(path, ".plmotion") || head.starts_with("PLMOTN");
}

nlohmann::ordered_json DescribeMotionCodebook(const std::filesystem::path& path) {
  const MotionCodebook codebook = ReadMotionCodebook(path);
  const CodebookRecord& record = codebook.record;
  return {{"segments", codebook.NumSegments()},
          {"duration_s", (kSegmentSamples - 1) * codebook.sample_time_s},
          {"samples", kSegmentSamples},
          {"bones", codebook.skeleton.bones.size()},
          {"height_m", Height(codebook.skeleton)},
          {"training_files", record.sources.size()},
          {"training_segments", record.num_segments},
          {"rms_error_mm", record.rms_error_mm},
          {"seed", record.seed},
          {"commit", record.commit},
          {"command", record.command}};
}

}  // namespace poselift::cli
