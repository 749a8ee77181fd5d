// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/lift_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "src/draw/style.h"
#include "src/input_error.h"
#include "src/io/image.h"
#include "src/io/quiet_stderr.h"
#include "src/io/video.h"
#include "src/layout.h"
#include "ui/cli/lift_pictures.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kTiles = 12;
constexpr int kColumns = 6;
const cv::Size kCutOut_px(400, 480), kView_px(400, 430);
constexpr int kCaption_px = 26;

bool AnyLifted(const std::vector<LiftResult>& people) {
  return std::any_of(people.begin(), people.end(), [](const auto& r) { return r.IsUsable(); });
}

// Places in `results`, evenly spread over the frames where anybody was lifted.
std::vector<size_t> ChooseFrames(const std::vector<std::vector<LiftResult>>& results) {
  std::vector<size_t> lifted, chosen;
  for (size_t f = 0; f < results.size(); ++f)
    if (AnyLifted(results[f])) lifted.push_back(f);
  const size_t count = std::min<size_t>(kTiles, lifted.size());
  for (size_t i = 0; i < count; ++i)
    chosen.push_back(lifted[count == 1 ? 0 : i * (lifted.size() - 1) / (count - 1)]);
  return chosen;
}

cv::Rect2d BoxOf(const FrameLabels& frame) {
  std::vector<cv::Point2f> points;
  for (const PersonLabels& person : frame.people)
    for (const LandmarkLabel& label : person.landmarks)
      if (label.state != LabelState::kAbsent)
        points.emplace_back(static_cast<float>(label.x_px.x()), static_cast<float>(label.x_px.y()));
  return cv::boundingRect(points);
}

// As wide for every frame, so that all tiles have one scale.
double CutOutHeight_px(const Labels& labels, const std::vector<size_t>& chosen) {
  constexpr double kMargin = 1.25;
  const double aspect = static_cast<double>(kCutOut_px.width) / kCutOut_px.height;
  double height_px = 16.0;
  for (const size_t f : chosen) {
    const cv::Rect2d box = BoxOf(labels.frames[f]);
    height_px = std::max({height_px, kMargin * box.height, kMargin * box.width / aspect});
  }
  return height_px;
}

// The part of a picture around a frame's labels; paper where it ends.
cv::Mat CutOut(const cv::Mat& picture, const FrameLabels& frame, double height_px) {
  const cv::Rect2d box = BoxOf(frame);
  const double scale = kCutOut_px.height / height_px;
  const cv::Point2d centre = (box.tl() + box.br()) / 2.0;
  const cv::Matx23d tile_from_picture(scale, 0.0, kCutOut_px.width / 2.0 - scale * centre.x, 0.0,
                                      scale, kCutOut_px.height / 2.0 - scale * centre.y);
  cv::Mat tile;
  cv::warpAffine(picture, tile, tile_from_picture, kCutOut_px, cv::INTER_AREA, cv::BORDER_CONSTANT,
                 palette::kPaper);
  return tile;
}

cv::Mat Tile(const cv::Mat& overlay, const cv::Mat& view, const FrameLabels& frame,
             double cut_out_px) {
  cv::Mat tile(kCaption_px + kCutOut_px.height + kView_px.height, kCutOut_px.width, CV_8UC3,
               palette::kPaper);
  DrawText(&tile, {8.0, kCaption_px / 2.0},
           fmt::format("frame {}, {:.2f} s", *frame.frame, *frame.time_s), {});
  CutOut(overlay, frame, cut_out_px).copyTo(tile(cv::Rect({0, kCaption_px}, kCutOut_px)));
  if (view.empty()) return tile;
  const double scale = std::min(static_cast<double>(kView_px.width) / view.cols,
                                static_cast<double>(kView_px.height) / view.rows);
  cv::Mat small;
  cv::resize(view, small, {}, scale, scale, cv::INTER_AREA);
  small.copyTo(tile(cv::Rect(0, kCaption_px + kCutOut_px.height, small.cols, small.rows)));
  return tile;
}

cv::Mat Sheet(const std::vector<cv::Mat>& tiles) {
  const int columns = std::min(kColumns, static_cast<int>(tiles.size()));
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  const cv::Size tile_px = tiles.front().size();
  cv::Mat sheet(rows * tile_px.height, columns * tile_px.width, CV_8UC3, palette::kPaper);
  for (int i = 0; i < static_cast<int>(tiles.size()); ++i)
    tiles[static_cast<size_t>(i)].copyTo(
        sheet(cv::Rect({i % columns * tile_px.width, i / columns * tile_px.height}, tile_px)));
  return sheet;
}

// Beside its place until Finish, as all files are written.
class OverlayVideo {
 public:
  OverlayVideo(const fs::path& path, const std::vector<FrameLabels>& frames)
      : path_(path), unfinished_(fs::path(path).replace_extension(".unfinished.avi")) {
    constexpr double kLoneFrame_s = 1.0;
    const double duration_s = *frames.back().time_s - *frames.front().time_s;
    rate_hz_ =
        duration_s > 0.0 ? static_cast<double>(frames.size() - 1) / duration_s : 1.0 / kLoneFrame_s;
  }

  void Add(const cv::Mat& picture) {
    const QuietStderr quiet;
    if (!writer_.isOpened() &&
        !writer_.open(unfinished_.string(), cv::CAP_FFMPEG,
                      cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz_, picture.size()))
      throw InputError(path_, "cannot be written");
    writer_.write(picture);
  }

  void Finish() {
    if (!writer_.isOpened()) return;
    writer_.release();
    fs::rename(unfinished_, path_);
  }

 private:
  fs::path path_, unfinished_;
  double rate_hz_ = 0.0;
  cv::VideoWriter writer_;
};

}  // namespace

void WriteVideoPictures(const LiftInputs& inputs,
                        const std::vector<std::vector<LiftResult>>& results,
                        const std::optional<Camera>& camera, bool whole_video,
                        const fs::path& out_dir, const ProgressFn& progress) {
  const std::vector<size_t> chosen = ChooseFrames(results);
  if (chosen.empty()) return;
  const Layout& layout = *FindLayout(inputs.labels.layout);
  const double cut_out_px = CutOutHeight_px(inputs.labels, chosen);
  const std::string name = inputs.video.stem();
  OverlayVideo overlay_video(out_dir / (name + ".overlay.avi"), inputs.labels.frames);
  std::vector<cv::Mat> tiles;
  VideoFile video(inputs.video);
  int index = 0;
  for (size_t f = 0; f < results.size(); ++f) {
    const bool is_tile = std::binary_search(chosen.begin(), chosen.end(), f);
    if (!is_tile && !whole_video) continue;
    const FrameLabels& frame = inputs.labels.frames[f];
    for (; index < *frame.frame; ++index) video.Skip_s();
    const auto picture = video.Next();
    ++index;
    if (!picture) break;
    const cv::Mat overlay = DrawPeople(picture->bgr, frame, layout, results[f], camera);
    if (is_tile) tiles.push_back(Tile(overlay, DrawFirstView(results[f], ""), frame, cut_out_px));
    if (whole_video) overlay_video.Add(overlay);
    if (progress) progress(static_cast<double>(f + 1) / static_cast<double>(results.size()));
  }
  if (!tiles.empty()) WritePng(out_dir / (name + ".strip.png"), Sheet(tiles));
  overlay_video.Finish();
}

}  // namespace poselift::cli
