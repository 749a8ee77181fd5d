// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/motion_database.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "lift/temporal/resample.h"
#include "src/dof_angles.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"
#include "src/retarget.h"

namespace poselift {
namespace {

double LegLength_m(const Skeleton& skeleton) {
  double length_m = 0.0;
  for (const char* name : {"lfemur", "ltibia", "rfemur", "rtibia"}) {
    const auto bone = skeleton.FindBone(name);
    if (!bone)
      throw InputError(skeleton.name, std::string("found no bone '") + name +
                                          "', wanted the bones of a CMU skeleton");
    length_m += skeleton.bones[*bone].tip_m.norm();
  }
  return length_m;
}

// At 60 Hz ten turns a second: no joint turns so fast.
constexpr double kJump_rad = 1.0;

struct RowGroup {
  int first_row;
  int num_rows;
};
constexpr RowGroup kRowGroups[] = {{0, kNumAngles},
                                   {feature::kHeight, 1},
                                   {feature::kTilt, 2},
                                   {feature::kVelocity, 2},
                                   {feature::kYawRate, 1}};

// The motion cut where an angle jumps.
std::vector<Motion> WithoutJumps(const Motion& motion) {
  std::vector<Motion> pieces;
  for (size_t f = 0; f < motion.frames.size(); ++f) {
    const bool starts =
        f == 0 ||
        ((motion.frames[f].dofs - motion.frames[f - 1].dofs).array().abs() > kJump_rad).any();
    if (starts) pieces.push_back({motion.skeleton, motion.frame_time_s, {}});
    pieces.back().frames.push_back(motion.frames[f]);
  }
  return pieces;
}

const std::string kMirrored = "/mirrored";

// The name without the mark of the mirror image.
std::string FileOf(const Trial& trial) { return trial.name.substr(0, trial.name.find('/')); }

bool IsNamed(const MotionSource& source, const std::string& name) {
  return name == source.subject || name == source.amc.stem();
}

bool IsAmong(const MotionSource& source, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return IsNamed(source, name); });
}

}  // namespace

void TakeAnglesNearestToRest(const Skeleton& skeleton, SkeletonPose* pose) {
  Eigen::VectorXd nearest = Eigen::VectorXd::Zero(pose->dofs.size());
  Eigen::Index first_dof = 0;
  for (const Bone& bone : skeleton.bones) {
    const double* values = pose->dofs.data() + first_dof;
    FitDofAngles(RotationOfDofs(bone.dofs, values), bone.dofs, nearest.data() + first_dof);
    first_dof += static_cast<Eigen::Index>(bone.dofs.size());
  }
  pose->dofs = nearest;
}

void MotionDatabase::Append(const std::string& name, const FeatureMatrix& trial_features) {
  trials.push_back({name, NumFrames(), static_cast<int>(trial_features.cols())});
  features.conservativeResize(Eigen::NoChange, features.cols() + trial_features.cols());
  features.rightCols(trial_features.cols()) = trial_features.cast<float>();
}

MotionDatabase SubsetOfTrials(const MotionDatabase& database,
                              const std::vector<std::string>& names) {
  MotionDatabase subset{database.skeleton, database.frame_time_s, {}, {}};
  for (const Trial& trial : database.trials)
    if (std::find(names.begin(), names.end(), FileOf(trial)) != names.end())
      subset.Append(
          trial.name,
          database.features.middleCols(trial.first_frame, trial.num_frames).cast<double>());
  return subset;
}

MotionDatabase DrawTrials(const MotionDatabase& database, int num_frames, uint64_t seed) {
  std::map<std::string, int> frames_of;
  for (const Trial& trial : database.trials) frames_of[FileOf(trial)] += trial.num_frames;
  std::vector<std::string> names;
  for (const auto& [name, frames] : frames_of) names.push_back(name);
  std::shuffle(names.begin(), names.end(), std::mt19937_64(seed));
  int sum = 0;
  size_t count = 0;
  while (count < names.size() && sum < num_frames) sum += frames_of[names[count++]];
  names.resize(count);
  return SubsetOfTrials(database, names);
}

std::vector<int> SegmentEnds(const MotionDatabase& database, int num_frames) {
  std::vector<int> ends;
  for (const Trial& trial : database.trials)
    for (int t = num_frames - 1; t + 1 < trial.num_frames; ++t)
      ends.push_back(trial.first_frame + t);
  return ends;
}

FeatureVector RowWeights(const MotionDatabase& database) {
  FeatureVector weights = FeatureVector::Ones();
  if (database.NumFrames() == 0) return weights;
  FeatureVector variance;
  for (int row = 0; row < kNumFeatures; ++row) {
    const Eigen::RowVectorXd values = database.features.row(row).cast<double>();
    variance[row] = (values.array() - values.mean()).square().mean();
  }
  for (const auto& [first_row, num_rows] : kRowGroups) {
    const double sigma = std::sqrt(variance.segment(first_row, num_rows).mean());
    if (sigma > 0.0) weights.segment(first_row, num_rows).setConstant(1.0 / sigma);
  }
  return weights;
}

Motion OnStandardSkeleton(const Motion& motion, const Skeleton& standard, double frame_time_s) {
  Motion rebased = RebaseMotion(Resample(motion, frame_time_s), standard);
  const double scale = LegLength_m(standard) / LegLength_m(motion.skeleton);
  for (SkeletonPose& pose : rebased.frames) {
    pose.root_in_world_m *= scale;
    TakeAnglesNearestToRest(standard, &pose);
  }
  return rebased;
}

std::vector<MotionSource> ChooseTrials(const std::vector<MotionSource>& sources,
                                       const std::vector<std::string>& include,
                                       const std::vector<std::string>& exclude) {
  for (const auto& names : {include, exclude})
    for (const std::string& name : names)
      if (std::none_of(sources.begin(), sources.end(),
                       [&](const MotionSource& source) { return IsNamed(source, name); }))
        throw InputError("found no subject and no trial '" + name + "' among the motions");
  std::vector<MotionSource> chosen;
  for (const MotionSource& source : sources)
    if ((include.empty() || IsAmong(source, include)) && !IsAmong(source, exclude))
      chosen.push_back(source);
  return chosen;
}

MotionDatabase LoadMotionDatabase(const std::vector<MotionSource>& sources,
                                  const Skeleton& standard, const DatabaseOptions& options,
                                  const ProgressFn& progress) {
  MotionDatabase database{standard, options.frame_time_s, {}, {}};
  std::map<std::filesystem::path, AsfSkeleton> asfs;
  for (size_t i = 0; i < sources.size(); ++i) {
    const auto& [amc, asf, subject] = sources[i];
    if (!asfs.contains(asf)) asfs[asf] = ReadAsfSkeleton(asf);
    const Motion motion =
        OnStandardSkeleton(ReadAmc(amc, asfs[asf]), standard, options.frame_time_s);
    for (const Motion& piece : WithoutJumps(motion)) {
      const FeatureMatrix features = MotionFeatures(piece);
      database.Append(amc.stem(), features);
      if (options.mirrored)
        database.Append(amc.stem().string() + kMirrored, MirroredFeatures(features, standard));
    }
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(sources.size()));
  }
  return database;
}

}  // namespace poselift
