// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/lift_pictures.h"

#include <fmt/format.h>

#include "src/draw/overlay.h"
#include "src/draw/pose_view.h"
#include "src/io/image.h"

namespace poselift::cli {
namespace {

// Where the picture shows a point of the body, and how far behind the pelvis
// (px as well).
Eigen::Vector3d InPicture(const Eigen::Vector3d& x_in_cam_m, const LiftedPose& lifted,
                          const std::optional<Camera>& camera) {
  Eigen::Vector3d x_px;
  x_px << (camera ? camera->Project(lifted.pelvis_in_cam_m + x_in_cam_m)
                  : Eigen::Vector2d(lifted.camera.Project(x_in_cam_m))),
      lifted.camera.scale_px_per_m * x_in_cam_m.z();
  return x_px;
}

OverlayPerson ToOverlay(const PersonLabels& labels, const Layout& layout, const LiftResult& result,
                        const std::optional<Camera>& camera) {
  OverlayPerson person;
  const LiftedPose* lifted = result.IsUsable() ? &result.poses.front() : nullptr;
  if (lifted) {
    person.joints_in_px.resize(3, kNumJoints);
    for (int j = 0; j < kNumJoints; ++j)
      person.joints_in_px.col(j) = InPicture(lifted->joints_in_cam_m.col(j), *lifted, camera);
    person.reprojection_rms_px = lifted->reprojection_rms_px;
  }
  for (const LandmarkLabel& label : labels.landmarks) {
    OverlayLabel& drawn = person.labels.emplace_back();
    drawn.name = label.name;
    drawn.x_px = label.x_px;
    drawn.state = label.state;
    const auto row = layout.Find(label.name);
    if (!lifted || !row || layout.landmarks[*row].parts.empty()) continue;
    const Eigen::Vector3d x_in_cam_m =
        SumOfJoints(layout.landmarks[*row].parts, lifted->joints_in_cam_m);
    drawn.reprojected_px = InPicture(x_in_cam_m, *lifted, camera).head<2>();
  }
  return person;
}

}  // namespace

cv::Mat DrawPeople(const cv::Mat& picture, const FrameLabels& frame, const Layout& layout,
                   const std::vector<LiftResult>& results, const std::optional<Camera>& camera) {
  OverlayInput overlay{frame.width_px, frame.height_px, {}};
  for (size_t p = 0; p < frame.people.size(); ++p)
    overlay.people.push_back(ToOverlay(frame.people[p], layout, results[p], camera));
  return DrawOverlay(picture, overlay);
}

cv::Mat DrawFirstView(const std::vector<LiftResult>& results, const std::string& title) {
  for (const LiftResult& result : results) {
    if (!result.IsUsable()) continue;
    const double rms_px = result.poses.front().reprojection_rms_px;
    PoseViewInput view{
        .joints_in_cam_m = result.poses.front().joints_in_cam_m,
        .title = fmt::format("{}{}{:.1f} px RMS", title, title.empty() ? "" : ": ", rms_px)};
    for (size_t i = 1; i < result.poses.size(); ++i)
      view.alternatives_in_cam_m.push_back(result.poses[i].joints_in_cam_m);
    return DrawPoseView(view);
  }
  return {};
}

void WritePictures(const std::filesystem::path& image, const FrameLabels& frame,
                   const Layout& layout, const std::vector<LiftResult>& results,
                   const std::optional<Camera>& camera, const std::filesystem::path& out_dir) {
  const std::string name = image.stem();
  WritePng(out_dir / (name + ".overlay.png"),
           DrawPeople(ReadImage(image), frame, layout, results, camera));
  const cv::Mat view = DrawFirstView(results, name);
  if (!view.empty()) WritePng(out_dir / (name + ".view.png"), view);
}

}  // namespace poselift::cli
