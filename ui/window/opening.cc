// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/opening.h"

#include <QCoreApplication>
#include <QProgressDialog>
#include <chrono>
#include <cmath>

#include "ui/label/background_job.h"
#include "ui/label/label_inputs.h"

namespace poselift {

std::optional<OpenedLabels> OpenLabels(const std::vector<std::string>& inputs,
                                       const std::string& labels_file, const std::string& layout,
                                       bool read_only) {
  BackgroundJob<OpenedLabels> job(nullptr);
  job.Start([&](const ProgressFn& progress) {
    OpenedLabels opened;
    const auto file = read_only
                          ? LabelsFileOf(inputs, labels_file)
                          : FindLabelsFile(inputs, labels_file, layout, progress, &opened.times);
    opened.project =
        std::make_unique<LabelProject>(file, LabelProject::Options{.read_only = read_only});
    if (!opened.project->read_only())
      AddNewPictures(inputs, opened.project.get(), progress, &opened.times);
    return opened;
  });
  QProgressDialog window(QProgressDialog::tr("Reading the pictures"), QProgressDialog::tr("Cancel"),
                         0, 100);
  window.setObjectName("opening");
  window.setWindowTitle("poselift");
  constexpr std::chrono::milliseconds kShownAfter(500), kOften(30);
  window.setMinimumDuration(static_cast<int>(kShownAfter.count()));
  while (job.IsBusy() && !window.wasCanceled()) {
    job.WaitAtMost(kOften);
    window.setValue(static_cast<int>(std::lround(99.0 * job.Fraction())));
    QCoreApplication::processEvents();
  }
  job.Stop();
  return job.Take();
}

}  // namespace poselift
