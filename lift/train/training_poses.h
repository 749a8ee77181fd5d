// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "src/motion.h"
#include "src/progress.h"
#include "src/skeleton.h"

namespace poselift {

// Training poses as section 4.1 of the sparse coding paper wants them: root at
// the origin, root orientation zero (the body frame), on one skeleton.
//
// Subjects differ in proportions; the dictionary has one standard skeleton. Its
// bones are the means of the subjects' bones at rest, made left-right
// symmetric. A subject's frame meets it by its joint rotations: every bone of
// the standard skeleton turns as the subject's bone of that name does.

struct MotionSource {
  std::filesystem::path amc;
  std::filesystem::path asf;
  std::string subject;  // the folder's name
};

struct MotionChoice {
  std::vector<std::string> subjects;   // empty: all
  std::filesystem::path fallback_asf;  // for an AMC that has no ASF of its own; may be empty
};

// All .amc files below a folder, in order of their names, each with its ASF
// (FindAsfOf). Throws InputError when there is none.
std::vector<MotionSource> FindMotions(const std::filesystem::path& folder,
                                      const MotionChoice& choice = {});

// The mean of the subjects' trimmed skeletons. Axes and dofs are the first
// one's.
Skeleton MeanSkeleton(const std::vector<Skeleton>& trimmed);

// Sets the limits of a symmetric skeleton's dofs to what was captured: the
// range of all but the outermost thousandth at either end, of both sides.
// dofs: NumDofs x frames.
void LearnLimits(const Eigen::MatrixXd& dofs, Skeleton* skeleton);

// A motion's dofs as those of its trimmed skeleton: NumDofs x frames.
Eigen::MatrixXd TrimmedDofs(const Motion& motion);

// The 23 joints of every frame in the body frame: `own`, the motion's trimmed
// skeleton, at the lengths of another trimmed one. 69 x frames, metres.
Eigen::MatrixXd BodyPoses(const Eigen::MatrixXd& trimmed_dofs, const Skeleton& own,
                          const Skeleton& proportions);

struct TrainingPoses {
  Skeleton standard;               // of these subjects, with the limits of these frames
  Eigen::MatrixXd poses_m;         // 69 x m
  std::vector<std::string> files;  // names of the AMC files that were read
};

struct LoadOptions {
  bool own_proportions = false;  // each subject keeps its bones' lengths
  int stride = 1;                // takes every stride-th frame
};

// Reads all motions and puts their poses side by side. Throws InputError for a
// file that cannot be read, and for skeletons that are not CMU's or whose degrees
// of freedom differ.
TrainingPoses LoadPoses(const std::vector<MotionSource>& sources, const LoadOptions& options,
                        const ProgressFn& progress);

// The poses and, behind them, their left-right mirror images: 69 x 2m.
Eigen::MatrixXd WithMirrored(const Eigen::MatrixXd& poses_m);

}  // namespace poselift
