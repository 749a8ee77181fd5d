// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/motion_input.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/input_error.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "src/io/text_scanner.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

PosesMotion ReadPosesFile(const std::string& path, const MotionInputOptions& options) {
  const Poses poses = ReadPosesJson(path);
  const Skeleton skeleton =
      ReadDictionary(options.dictionary.empty() ? DefaultDictionaryPath()
                                                : fs::path(options.dictionary))
          .skeleton;
  PosesToMotionOptions to_motion{.person_id = options.person_id,
                                 .frame_time_s = std::nullopt,
                                 .with_filled = options.with_filled};
  if (options.fps > 0.0) to_motion.frame_time_s = 1.0 / options.fps;
  Progress progress("read", static_cast<int64_t>(poses.frames.size()), "frames");
  try {
    return PosesToMotion(poses, skeleton, to_motion, progress.Callback());
  } catch (const InputError& error) {
    throw InputError(path, error.what());
  }
}

PosesMotion ReadMotionFile(const std::string& path, const MotionInputOptions& options) {
  ReadMotionOptions read{.metres_per_unit = *MetresPerUnit(options.units)};
  if (fs::path(path).extension() != ".bvh") read.skeleton = options.skeleton;
  if (options.fps > 0.0) read.frame_time_s = 1.0 / options.fps;
  PosesMotion motion;
  motion.motion = ReadMotion(path, read);
  motion.camera.has_depth = true;
  for (size_t t = 0; t < motion.motion.frames.size(); ++t)
    motion.times_s.push_back(static_cast<double>(t) * motion.motion.frame_time_s);
  return motion;
}

}  // namespace

void AddMotionInputOptions(CLI::App* command, MotionInputOptions* options) {
  command->add_option("--skeleton", options->skeleton, "ASF of an AMC (else the one beside it)");
  command->add_option("--units", options->units, "Unit of lengths in BVH files")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}))
      ->capture_default_str();
  command->add_option("--fps", options->fps, "Frame rate instead of what the file says [AMC: 120]")
      ->check(IsFrameRate());
  command->add_option("--person", options->person_id, "Id of the person in poses.json [the first]");
  command->add_option("--dictionary", options->dictionary,
                      "Whose skeleton poses.json is on [the one that ships]");
}

bool IsPosesFile(const std::string& path) {
  return EqualsIgnoringCase(fs::path(path).extension().string(), ".json");
}

PosesMotion ReadMotionInput(const std::string& path, const MotionInputOptions& options) {
  return IsPosesFile(path) ? ReadPosesFile(path, options) : ReadMotionFile(path, options);
}

}  // namespace poselift::cli
