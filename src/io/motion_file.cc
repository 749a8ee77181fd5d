// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/motion_file.h"

#include <string>

#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/io/bvh.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

enum class Format { kBvh, kAmc, kAsf };

Format FormatOf(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (EqualsIgnoringCase(ending, ".bvh")) return Format::kBvh;
  if (EqualsIgnoringCase(ending, ".amc")) return Format::kAmc;
  if (EqualsIgnoringCase(ending, ".asf")) return Format::kAsf;
  throw InputError(path.string(), "found the ending " + Quoted(ending) +
                                      ", wanted a motion file: .bvh, .amc or .asf");
}

Motion ReadAmcWithAsf(const std::filesystem::path& path, const ReadMotionOptions& options) {
  const auto asf_path = options.skeleton.empty() ? FindAsfOf(path) : options.skeleton;
  return ReadAmc(path, ReadAsfSkeleton(asf_path), options.frame_time_s.value_or(kCmuFrameTime_s));
}

Motion ReadAsfAtRest(const std::filesystem::path& path, const ReadMotionOptions& options) {
  Motion motion{ReadAsf(path), options.frame_time_s.value_or(kCmuFrameTime_s), {}};
  motion.frames.push_back(SkeletonPose::Rest(motion.skeleton));
  return motion;
}

Motion ReadBvhWithRate(const std::filesystem::path& path, const ReadMotionOptions& options) {
  Motion motion = ReadBvh(path, {.metres_per_unit = options.metres_per_unit});
  motion.frame_time_s = options.frame_time_s.value_or(motion.frame_time_s);
  return motion;
}

RebaseReport WriteAmcOn(const std::filesystem::path& skeleton, const Motion& motion,
                        const std::filesystem::path& path) {
  const AsfSkeleton asf = ReadAsfSkeleton(skeleton);
  RebaseReport report;
  const Motion rebased = RebaseMotion(motion, asf.skeleton, &report);
  if (report.num_matched == 0)
    throw InputError(
        skeleton.string(),
        "found no bone that the motion has too, wanted the same names (the motion has " +
            Quoted(motion.skeleton.bones.back().name) + ", the skeleton " +
            Quoted(asf.skeleton.bones.back().name) + ")");
  WriteAmc(rebased, asf, path);
  return report;
}

}  // namespace

Motion ReadMotion(const std::filesystem::path& path, const ReadMotionOptions& options) {
  switch (FormatOf(path)) {
    case Format::kBvh:
      return ReadBvhWithRate(path, options);
    case Format::kAmc:
      return ReadAmcWithAsf(path, options);
    case Format::kAsf:
      break;
  }
  return ReadAsfAtRest(path, options);
}

RebaseReport WriteMotion(const Motion& motion, const std::filesystem::path& path,
                         const WriteMotionOptions& options) {
  switch (FormatOf(path)) {
    case Format::kBvh:
      WriteBvh(motion, path, {.metres_per_unit = options.metres_per_unit});
      break;
    case Format::kAmc:
      if (!options.skeleton.empty()) return WriteAmcOn(options.skeleton, motion, path);
      WriteAsf(motion.skeleton, std::filesystem::path(path).replace_extension(".asf"));
      WriteAmc(motion, path);
      break;
    case Format::kAsf:
      WriteAsf(motion.skeleton, path);
      break;
  }
  return {};
}

std::optional<double> MetresPerUnit(std::string_view unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "in") return kMetresPerInch;
  return std::nullopt;
}

}  // namespace poselift
