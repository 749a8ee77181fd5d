// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/train/training_poses.h"

#include <algorithm>
#include <map>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/asf.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

// For each dof of the trimmed skeleton, its place among the whole one's.
std::vector<int> DofsOfTrimmed(const Skeleton& whole, const Skeleton& trimmed) {
  const std::vector<int> starts = whole.DofStarts();
  std::vector<int> places;
  for (const Bone& bone : trimmed.bones) {
    const int source = *whole.FindBone(bone.name);
    for (size_t i = 0; i < bone.dofs.size(); ++i)
      places.push_back(starts[source] + static_cast<int>(i));
  }
  return places;
}

std::vector<fs::path> FindAmcFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::path last = folder;  // the iterator does not say which folder it cannot enter
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    last = entry->path();
    if (entry->is_regular_file() && last.extension() == ".amc") files.push_back(last);
  }
  if (error) throw InputError(last, "cannot list it: " + error.message());
  return files;
}

fs::path AsfOf(const fs::path& amc, const fs::path& fallback) {
  if (fallback.empty()) return FindAsfOf(amc);
  try {
    return FindAsfOf(amc);
  } catch (const InputError&) {
    return fallback;
  }
}

// Joins the parts' columns and frees the parts.
Eigen::MatrixXd SideBySide(std::vector<Eigen::MatrixXd>* parts) {
  Eigen::Index total = 0;
  for (const Eigen::MatrixXd& part : *parts) total += part.cols();
  Eigen::MatrixXd joined(parts->front().rows(), total);
  Eigen::Index next = 0;
  for (Eigen::MatrixXd& part : *parts) {
    joined.middleCols(next, part.cols()) = part;
    next += part.cols();
    part.resize(0, 0);
  }
  return joined;
}

bool SameDofs(const Bone& a, const Bone& b) {
  return std::equal(a.dofs.begin(), a.dofs.end(), b.dofs.begin(), b.dofs.end(),
                    [](const Dof& x, const Dof& y) { return x.kind == y.kind; });
}

// Frames stand side by side in one table, and left lends its limits to right.
void RequireSameDofs(const Skeleton& trimmed, const Skeleton& first, const fs::path& file) {
  for (int j = 0; j < kNumJoints; ++j) {
    const Bone& bone = trimmed.bones[j];
    if (!SameDofs(bone, first.bones[j]))
      throw InputError(file, "found other degrees of freedom at the bone " + bone.name +
                                 " than in the first skeleton, wanted the same in all");
    if (const Bone& mirror = trimmed.bones[Joints()[j].mirror]; !SameDofs(bone, mirror))
      throw InputError(file, "found other degrees of freedom at the bone " + bone.name +
                                 " than at " + mirror.name + ", wanted the same left and right");
  }
}

Skeleton Trimmed(const AsfSkeleton& asf, const fs::path& file) {
  try {
    return TrimToJoints(asf.skeleton);
  } catch (const InputError& error) {  // knows no file
    throw InputError(file, error.what());
  }
}

// Mirroring a rotation in the plane x = 0 turns it about y and z the other way.
double MirrorSign(const Dof& dof) { return dof.Axis() == 0 ? 1.0 : -1.0; }

}  // namespace

std::vector<MotionSource> FindMotions(const fs::path& folder, const MotionChoice& choice) {
  if (!fs::is_directory(folder))
    throw InputError(folder, "found no such folder, wanted one with .amc and .asf files");
  std::vector<MotionSource> sources;
  for (const fs::path& amc : FindAmcFiles(folder)) {
    const std::string subject = amc.parent_path().filename();
    const auto& subjects = choice.subjects;
    const bool wanted =
        subjects.empty() || std::find(subjects.begin(), subjects.end(), subject) != subjects.end();
    if (wanted) sources.push_back({amc, {}, subject});
  }
  std::sort(sources.begin(), sources.end(),
            [](const MotionSource& a, const MotionSource& b) { return a.amc < b.amc; });
  for (MotionSource& source : sources) source.asf = AsfOf(source.amc, choice.fallback_asf);
  if (sources.empty()) throw InputError(folder, "found no .amc file of the subjects asked for");
  return sources;
}

Skeleton MeanSkeleton(const std::vector<Skeleton>& trimmed) {
  Skeleton mean = trimmed.front();
  mean.name = "standard";
  const auto flipped = [](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(-v.x(), v.y(), v.z());
  };
  for (int j = 0; j < kNumJoints; ++j) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Skeleton& skeleton : trimmed)
      sum += skeleton.bones[j].tip_m + flipped(skeleton.bones[Joints()[j].mirror].tip_m);
    mean.bones[j].tip_m = sum / (2.0 * static_cast<double>(trimmed.size()));
  }
  for (Bone& bone : mean.bones)
    if (bone.parent >= 0) bone.offset_m = mean.bones[bone.parent].tip_m;
  return mean;
}

void LearnLimits(const Eigen::MatrixXd& dofs, Skeleton* skeleton) {
  const std::vector<int> starts = skeleton->DofStarts();
  const Eigen::Index outer = dofs.cols() / 1000;
  Eigen::VectorXd lower(dofs.rows()), upper(dofs.rows());
  std::vector<double> values(static_cast<size_t>(dofs.cols()));
  for (Eigen::Index d = 0; d < dofs.rows(); ++d) {
    Eigen::Map<Eigen::RowVectorXd>(values.data(), dofs.cols()) = dofs.row(d);
    std::nth_element(values.begin(), values.begin() + outer, values.end());
    lower[d] = values[outer];
    std::nth_element(values.begin(), values.end() - 1 - outer, values.end());
    upper[d] = values[values.size() - 1 - outer];
  }
  for (int j = 0; j < kNumJoints; ++j) {
    std::vector<Dof>& own = skeleton->bones[j].dofs;
    for (size_t i = 0; i < own.size(); ++i) {
      const auto d = starts[j] + static_cast<int>(i);
      const auto m = starts[Joints()[j].mirror] + static_cast<int>(i);
      const bool same = MirrorSign(own[i]) > 0.0;
      own[i].lower = std::min(lower[d], same ? lower[m] : -upper[m]);
      own[i].upper = std::max(upper[d], same ? upper[m] : -lower[m]);
    }
  }
}

Eigen::MatrixXd TrimmedDofs(const Motion& motion) {
  const std::vector<int> places = DofsOfTrimmed(motion.skeleton, TrimToJoints(motion.skeleton));
  Eigen::MatrixXd dofs(static_cast<Eigen::Index>(places.size()),
                       static_cast<Eigen::Index>(motion.frames.size()));
  for (Eigen::Index f = 0; f < dofs.cols(); ++f)
    for (Eigen::Index d = 0; d < dofs.rows(); ++d) dofs(d, f) = motion.frames[f].dofs[places[d]];
  return dofs;
}

Eigen::MatrixXd BodyPoses(const Eigen::MatrixXd& trimmed_dofs, const Skeleton& own,
                          const Skeleton& proportions) {
  Skeleton body = own;
  for (size_t b = 0; b < body.bones.size(); ++b) {
    body.bones[b].offset_m = proportions.bones[b].offset_m;
    body.bones[b].tip_m = proportions.bones[b].tip_m;
  }
  const JointSites sites = FindJointSites(body);
  Eigen::MatrixXd poses(3 * kNumJoints, trimmed_dofs.cols());
  SkeletonPose pose = SkeletonPose::Rest(body);
  BoneFrames frames;
  for (Eigen::Index f = 0; f < poses.cols(); ++f) {
    pose.dofs = trimmed_dofs.col(f);
    ForwardKinematics(body, pose, &frames);
    const Pose3 joints = JointPositions(sites, frames);
    poses.col(f) = Stacked(joints);
  }
  return poses;
}

TrainingPoses LoadPoses(const std::vector<MotionSource>& sources, const LoadOptions& options,
                        const ProgressFn& progress) {
  std::map<fs::path, AsfSkeleton> asfs;
  for (const MotionSource& source : sources)
    if (!asfs.contains(source.asf)) asfs[source.asf] = ReadAsfSkeleton(source.asf);
  std::vector<Skeleton> trimmed;
  for (const auto& [path, asf] : asfs) {
    trimmed.push_back(Trimmed(asf, path));
    RequireSameDofs(trimmed.back(), trimmed.front(), path);
  }

  TrainingPoses result;
  result.standard = MeanSkeleton(trimmed);
  std::vector<Eigen::MatrixXd> poses, dofs;
  for (const MotionSource& source : sources) {
    Motion motion = ReadAmc(source.amc, asfs[source.asf]);
    for (size_t f = 0; f * options.stride < motion.frames.size(); ++f)
      motion.frames[f] = motion.frames[f * options.stride];
    motion.frames.resize((motion.frames.size() + options.stride - 1) / options.stride);
    const Skeleton own = TrimToJoints(motion.skeleton);
    dofs.push_back(TrimmedDofs(motion));
    poses.push_back(BodyPoses(dofs.back(), own, options.own_proportions ? own : result.standard));
    result.files.push_back(source.amc.filename());
    if (progress) progress(static_cast<double>(poses.size()) / static_cast<double>(sources.size()));
  }
  result.poses_m = SideBySide(&poses);
  LearnLimits(SideBySide(&dofs), &result.standard);
  return result;
}

Eigen::MatrixXd WithMirrored(const Eigen::MatrixXd& poses_m) {
  Eigen::MatrixXd both(poses_m.rows(), 2 * poses_m.cols());
  both.leftCols(poses_m.cols()) = poses_m;
  for (Eigen::Index i = 0; i < poses_m.cols(); ++i) {
    const Pose3 mirrored = MirroredInBody(Unstacked(poses_m.col(i)));
    both.col(poses_m.cols() + i) = Stacked(mirrored);
  }
  return both;
}

}  // namespace poselift
