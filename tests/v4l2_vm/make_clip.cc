// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// poselift_make_clip DIR: what a camera sees of a made-up person who wears tags and walks on a
// treadmill: 00.jpg and on, which can be shown by turns without a jump, camera.yaml, tags.toml.
// And in DIR/board what it sees of a board of tags: 00.jpg and on, target.yaml.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/april_grid_finder.h"
#include "calib/april_grid_yaml.h"
#include "calib/tag_family.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_yaml.h"
#include "src/testing/body_renderer.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "tests/support/board_picture.h"
#include "tests/support/planted_board_views.h"
#include "tests/support/planted_walk.h"

namespace {

using namespace poselift;

constexpr int kNumPictures = 20;
constexpr int kStrideFrames = 60;  // of PlantWalk
constexpr int kNumViews = 10;

const Camera kCamera{
    .width_px = 640, .height_px = 480, .fx_px = 700, .fy_px = 700, .cx_px = 320, .cy_px = 240};

void Write(const cv::Mat& picture, const std::filesystem::path& folder, int number) {
  const auto path = folder / fmt::format("{:02}.jpg", number);
  if (!cv::imwrite(path.string(), picture))
    throw std::runtime_error("cannot write " + path.string());
}

void MakeClip(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Motion walk = testing::OnTheSpot(testing::PlantWalk(3 * kStrideFrames, 0.6, 0.0).motion);
  const testing::PlacedCamera placed = testing::CameraBefore(walk, 2.9, 0.3, kCamera);
  const BodyTags tags = testing::DefaultTagPlacement(walk.skeleton, {.size_m = 0.1});
  const TagFamily family("tag36h11");
  const testing::BodyRenderer renderer(walk.skeleton, tags,
                                       [&](int id) -> testing::TagPrint {
                                         return {family.Image(id), family.cells_of_size()};
                                       },
                                       placed.camera, placed.cam_from_world,
                                       {.noise_grey_levels = 2.0, .color = true});
  // The middle stride, for the smoothed path ends with the motion.
  const auto pose_at = testing::PosesOver(walk);
  for (int i = 0; i < kNumPictures; ++i) {
    const double frame = kStrideFrames * (1.0 + static_cast<double>(i) / kNumPictures);
    Write(renderer.Render(pose_at, frame * walk.frame_time_s).picture, folder, i);
  }
  WriteCameraYaml(placed.camera, folder / "camera.yaml");
  WriteBodyTags(tags, folder / "tags.toml");
}

void ShowBoard(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const AprilGrid grid{.rows = 3, .columns = 4, .tag_size_m = 0.03};
  std::mt19937_64 rng(1);
  const auto planted =
      testing::PlantBoardViews(BoardOf(grid), kCamera, {.num_views = kNumViews}, &rng);
  for (int i = 0; i < kNumViews; ++i) {
    cv::Mat picture;
    cv::cvtColor(testing::RenderBoard(testing::PrintOf(grid), kCamera,
                                      planted.cam_from_board[static_cast<size_t>(i)]),
                 picture, cv::COLOR_GRAY2BGR);
    Write(picture, folder, i);
  }
  WriteAprilGridYaml(grid, folder / "target.yaml");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("wanted one folder");
    MakeClip(argv[1]);
    ShowBoard(std::filesystem::path(argv[1]) / "board");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "poselift_make_clip: %s\n", error.what());
    return 1;
  }
}
