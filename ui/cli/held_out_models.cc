// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/held_out_models.h"

#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "lift/train/train_codebook.h"
#include "lift/train/train_dictionary.h"
#include "ui/cli/progress.h"

namespace poselift::cli {

Dictionary LearnDictionary(const std::vector<MotionSource>& sources, const HeldOutModels& options) {
  if (!options.dictionary.empty()) return ReadDictionary(options.dictionary);
  const auto chosen = ChooseTrials(sources, options.train_subjects, options.test_trials);
  TrainingPoses poses;
  {
    Progress progress("read", static_cast<int64_t>(chosen.size()), "files");
    poses = LoadPoses(chosen, {}, progress.Callback());
  }
  Progress progress("train", poses.poses_m.cols(), "frames");
  TrainReport report;
  return TrainDictionary(poses, /*mirrored=*/true, {}, progress.Callback(), &report);
}

MotionCodebook LearnMotion(const std::vector<MotionSource>& sources, const Skeleton& standard,
                           const HeldOutModels& options) {
  if (!options.motion_model.empty()) return WithMirrored(ReadMotionCodebook(options.motion_model));
  const auto chosen = ChooseTrials(sources, options.train_subjects, options.test_trials);
  MotionCodebook segments;
  {
    Progress progress("read", static_cast<int64_t>(chosen.size()), "files");
    segments =
        SegmentsOf(LoadMotionDatabase(chosen, standard, {.mirrored = false}, progress.Callback()));
  }
  Progress progress("train", segments.NumSegments(), "segments");
  CodebookReport report;
  return WithMirrored(TrainCodebook(segments, {}, progress.Callback(), &report));
}

}  // namespace poselift::cli
