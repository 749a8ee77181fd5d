// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/truth.h"

#include <fmt/format.h>

#include "lift/eval/pose_error.h"
#include "src/io/json_value.h"
#include "src/layout.h"

namespace poselift::cli {

void PrintErrorAgainstTruth(const Poses& poses, const std::filesystem::path& truth) {
  const JsonDocument document(truth);
  const JsonValue& joints = document.root().At("joints_in_cam");
  if (poses.frames.empty() || poses.frames[0].people.empty() ||
      poses.frames[0].people[0].status != "ok")
    return;
  const Pose3& lifted = poses.frames[0].people[0].joints_in_cam_m;

  // The truth names landmarks of a body: the wrist is the body15 wrist.
  const Layout& layout = *FindLayout("body15");
  Pose3 estimate(3, joints.Keys().size()), known(3, joints.Keys().size());
  Eigen::Index count = 0;
  for (size_t i = 0; i < joints.Keys().size(); ++i) {
    const auto row = layout.Find(joints.Keys()[i]);
    if (!row) continue;
    const auto& x = joints.Members()[i].Items();
    if (x.size() != 3) throw joints.Members()[i].Unwanted("three coordinates");
    known.col(count) << x[0].Number(), x[1].Number(), x[2].Number();
    estimate.col(count).setZero();
    for (const auto& [joint, weight] : layout.landmarks[*row].parts)
      estimate.col(count) += weight * lifted.col(joint);
    ++count;
  }
  if (count < 4) throw joints.Unwanted("at least four joints of body15");
  const Pose3 a = estimate.leftCols(count);
  const Pose3 b = known.leftCols(count);
  fmt::print(
      "against the truth, mean of {} joints: {:.0f} mm after similarity alignment (PA), "
      "{:.0f} mm after translation and scale (CAM)\n",
      count, PaError_mm(a, b), CamError_mm(a, b));
}

}  // namespace poselift::cli
