// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What is written for other programs, and what else goes on in the background: said and stopped.
#include <fmt/format.h>

#include <filesystem>

#include "lift/lift_labels.h"
#include "lift/lifted_files.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/translated.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

constexpr double kFps = 30.0;         // of frames without times
constexpr double kShareOfLift = 0.9;  // of the work; the rest makes one motion of the poses

}  // namespace

void LabelSession::StartExport(BackgroundJob<fs::path>::Work work) {
  if (export_job_.IsBusy())
    throw InputError("an export goes on, wanted one at a time: wait, or stop it (Esc)");
  notice_.clear();
  export_job_.Start(std::move(work));
}

void LabelSession::Export(const fs::path& folder) {
  StartExport([&lifter = lifter_, labels = labels(), folder](const ProgressFn& progress) {
    PrepareFolderOf(folder / "poses.json");  // before the work
    const auto lifting = [&](double part) { progress(kShareOfLift * part); };
    const auto writing = [&](double part) { progress(kShareOfLift + (1.0 - kShareOfLift) * part); };
    const bool is_motion = WhyFramesAlone(labels).empty();
    const LiftedLabels lifted = is_motion ? LiftAsMotion(lifter, labels, lifting)
                                          : LiftLabels(lifter, labels, std::nullopt, lifting);
    WriteLifted(lifted, labels, lifter.dictionary().skeleton, is_motion, kFps, folder, writing);
    return folder;
  });
}

void LabelSession::ExportMotion(const fs::path& path) {
  if (!motion_ || !motion_->HasPoses())
    throw InputError("found no motion to export, wanted one: smooth the motion first");
  if (!IsMotionCurrent())
    throw InputError(
        "found labels that have changed since the motion was made, wanted a motion of these: "
        "smooth the motion again");
  StartExport([&lifter = lifter_, motion = motion_, path](const ProgressFn& progress) {
    WriteLiftedMotion(motion->lifted, lifter.dictionary().skeleton, path, progress);
    return path;
  });
}

std::optional<fs::path> LabelSession::TakeExported() {
  auto where = export_job_.Take();
  // Still there for who comes back after a while.
  if (where) notice_ = Translated("exported to {}", where->string());
  return where;
}

std::string LabelSession::Working() const {
  std::string working;
  if (const auto fraction = FollowProgress())
    working += Translated("following the labels: {:.0f} %, ", 100.0 * *fraction);
  if (export_job_.IsBusy())
    working += Translated("exporting: {:.0f} %, ", 100.0 * export_job_.Fraction());
  return working.empty() ? "" : working + Translated("Esc stops it");
}

void LabelSession::Stop() {
  if (follow_job_.IsBusy()) notice_ = Translated("stopped: no labels were changed");
  if (export_job_.IsBusy()) notice_ = Translated("stopped: nothing was exported");
  follow_job_.Stop();
  motion_job_.Stop();
  export_job_.Stop();
}

}  // namespace poselift
