// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/truth.h"

#include <fmt/format.h>

#include "lift/eval/pose_error.h"
#include "src/io/json_value.h"
#include "src/layout.h"

namespace poselift::cli {
namespace {

// The truth names landmarks of a body: the wrist is the body15 wrist.
const Layout& TruthLayout() { return *FindLayout("body15"); }

}  // namespace

Truth ReadTruth(const std::filesystem::path& path) {
  const JsonDocument document(path);
  const JsonValue& joints = document.root().At("joints_in_cam");
  Truth truth;
  truth.x_in_cam_m.resize(3, std::ssize(joints.Keys()));
  for (size_t i = 0; i < joints.Keys().size(); ++i) {
    const auto row = TruthLayout().Find(joints.Keys()[i]);
    if (!row) continue;
    const auto& x = joints.Members()[i].Items();
    if (x.size() != 3) throw joints.Members()[i].Unwanted("three coordinates");
    truth.x_in_cam_m.col(std::ssize(truth.landmarks)) =
        Eigen::Vector3d(x[0].Number(), x[1].Number(), x[2].Number());
    truth.landmarks.push_back(*row);
  }
  if (truth.landmarks.size() < 4) throw joints.Unwanted("at least four joints of body15");
  truth.x_in_cam_m.conservativeResize(3, std::ssize(truth.landmarks));
  return truth;
}

void PrintErrorAgainstTruth(const Poses& poses, const Truth& truth) {
  if (poses.frames.empty() || poses.frames[0].people.empty() ||
      poses.frames[0].people[0].status != "ok")
    return;
  const Pose3& lifted = poses.frames[0].people[0].joints_in_cam_m;
  Pose3 estimate(3, truth.x_in_cam_m.cols());
  for (Eigen::Index i = 0; i < estimate.cols(); ++i)
    estimate.col(i) =
        SumOfJoints(TruthLayout().landmarks[truth.landmarks[static_cast<size_t>(i)]].parts, lifted);
  fmt::print(
      "against the truth, mean of {} joints: {:.0f} mm after similarity alignment (PA), "
      "{:.0f} mm after translation and scale (CAM)\n",
      estimate.cols(), PaError_mm(estimate, truth.x_in_cam_m),
      CamError_mm(estimate, truth.x_in_cam_m));
}

}  // namespace poselift::cli
