// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/edge_width.h"
#include "calib/tag_pose.h"
#include "calib/tag_search.h"
#include "src/capture/open_frame_source.h"
#include "src/draw/style.h"
#include "src/draw/tag_marks.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/body_tags_toml.h"
#include "src/io/growing_file.h"
#include "ui/cli/camera_options.h"
#include "ui/cli/frame_rate.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/refuse_options.h"
#include "ui/cli/tags.h"
#include "ui/cli/tracking_options.h"
#include "ui/live/tracking_inputs.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRosAxes = "apriltag_ros";

struct Options {
  TrackingInputs inputs;
  std::string tags, family = "tag36h11", axes = "poselift", jsonl, pictures;
  double size_mm = 60.0;
};

// A tag as it was found, in the axes that were asked for.
struct Found {
  TagSighting tag;
  std::string name;
  double edge_px;  // how smeared it is
};

std::string NameOf(const fs::path& folder, int frame) {
  return (folder / fmt::format("{:06}.jpg", frame)).string();
}

Json Numbers(const auto& values) { return std::vector<double>(values.begin(), values.end()); }

Json JsonOf(const TagPose& pose) {
  const Eigen::Quaterniond q(pose.cam_from_tag.linear());
  return {{"position_m", Numbers(pose.cam_from_tag.translation())},
          {"rotation", {q.w(), q.x(), q.y(), q.z()}},
          {"rms_px", pose.rms_px}};
}

// JSON has no NaN.
Json JsonOf(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json JsonOf(const Found& found) {
  const TagDetection& detection = found.tag.detection;
  Json corners = Json::array();
  for (int k = 0; k < 4; ++k) corners.push_back(Numbers(detection.corners_px.col(k)));
  Json tag = {{"id", detection.id},
              {"name", found.name},
              {"hamming", detection.hamming},
              {"margin", detection.decision_margin},
              {"edge_px", JsonOf(found.edge_px)},
              {"corners_px", corners},
              {"ambiguous", found.tag.is_ambiguous},
              {"poses", Json::array()}};
  for (const TagPose& pose : found.tag.poses) tag["poses"].push_back(JsonOf(pose));
  return tag;
}

void Print(int frame, const Found& found) {
  const TagDetection& detection = found.tag.detection;
  const std::string edge = std::isfinite(found.edge_px) ? Fixed(found.edge_px, 1) : "-";
  fmt::print("{:>6} {:>5} {:20} {:>7} {:>6.0f} {:>7}", frame, detection.id, found.name,
             detection.hamming, detection.decision_margin, edge);
  if (!found.tag.poses.empty()) {
    const Eigen::Vector3d x_m = found.tag.poses.front().cam_from_tag.translation();
    fmt::print(" {:>8.3f} {:>8.3f} {:>8.3f} {:>7.2f}{}", x_m.x(), x_m.y(), x_m.z(),
               found.tag.poses.front().rms_px, found.tag.is_ambiguous ? "  leans either way" : "");
  }
  fmt::print("\n");
}

// What is known before the first picture, and what one picture shows.
class TagFinder {
 public:
  TagFinder(const Options& options, cv::Size size_px)
      : options_(options),
        worn_(options.tags.empty() ? BodyTags{.family = options.family, .tags = {}}
                                   : ReadBodyTags(options.tags, TagPlaces::kAny)),
        family_(worn_.family),
        search_(family_, Searching()),
        follows_(KindOfSource(options.inputs.input) != SourceKind::kFolder) {
    if (!options.inputs.camera.empty()) camera_ = CameraOf(options.inputs, size_px);
  }

  std::vector<Found> Find(const cv::Mat& grey) {
    std::vector<Found> all;
    for (const TagDetection& detection : search_.Detect(grey)) {
      const BodyTag* const worn = worn_.Find(detection.id);
      const auto edges_px = EdgeWidths_px(grey, detection, family_.cells_of_size());
      Found found{{detection, {}, false},
                  worn ? worn->name : "",
                  std::fmax(edges_px[0], edges_px[1])};  // NaN is no width
      if (camera_) {
        TagPoses poses = FindTagPoses(*camera_, detection.corners_px, SizeOf_m(worn));
        if (follows_) PutNearestFirst(detection.id, &poses);
        found.tag.poses = std::move(poses.poses);
        found.tag.is_ambiguous = poses.is_ambiguous;
      }
      all.push_back(std::move(found));
    }
    return all;
  }

  // Where the corners of a tag do not tell how it leans, its pose in the frame before does.
  void PutNearestFirst(int id, TagPoses* found) {
    if (found->poses.empty()) return;
    const auto last = last_.find(id);
    if (found->is_ambiguous && last != last_.end()) {
      const TagPoseHints hints{.last = TagPoseHints::Pose{last->second}};
      std::swap(found->poses.front(), found->poses[ChooseTagPose(*found, hints).index]);
    }
    last_.insert_or_assign(id, found->poses.front().cam_from_tag);
  }

  double SizeOf_m(const BodyTag* worn) const {
    return worn ? worn->size_m : 1e-3 * options_.size_mm;
  }
  double SizeOf_m(int id) const { return SizeOf_m(worn_.Find(id)); }
  const std::optional<Camera>& camera() const { return camera_; }

 private:
  TagSearchOptions Searching() const {
    TagSearchOptions searching{.threads = 2, .glance_every = 1, .full_every = 1};
    for (const BodyTag& tag : worn_.tags) searching.detector.known_ids.push_back(tag.id);
    return searching;
  }

  const Options& options_;
  BodyTags worn_;
  TagFamily family_;
  TagSearch search_;
  std::optional<Camera> camera_;
  bool follows_;                           // its frames follow each other
  std::map<int, Eigen::Isometry3d> last_;  // of the frame before
};

void DrawFound(const std::vector<Found>& all, const TagFinder& finder, cv::Mat* picture) {
  for (const Found& found : all)
    DrawTag(found.tag, finder.SizeOf_m(found.tag.detection.id), finder.camera(), picture);
}

void InRosAxes(std::vector<Found>* all) {
  for (Found& found : *all)
    for (TagPose& pose : found.tag.poses) pose.cam_from_tag = CamFromRosTag(pose.cam_from_tag);
}

Json LineOf(const VideoFrame& frame, const std::vector<Found>& all, const Options& options) {
  Json line = {{"frame", frame.index},
               {"time_s", frame.time_s},
               {"axes", options.axes},
               {"tags", Json::array()}};
  for (const Found& found : all) line["tags"].push_back(JsonOf(found));
  return line;
}

std::unique_ptr<FrameSource> Open(const Options& options) {
  FrameSourceOptions opening{
      .pictures = options.pictures.empty() ? Pictures::kGrey : Pictures::kBoth,
      .folder_rate_hz = options.inputs.folder_rate_hz};
  opening.live.camera = options.inputs.device.Options();
  return OpenFrameSource(options.inputs.input, opening);
}

int Find(const Options& options) {
  const auto source = Open(options);
  TellCamera(*source);
  TagFinder finder(options, source->size_px());
  std::optional<GrowingFile> lines;
  if (!options.jsonl.empty()) {
    PrepareFolderOf(options.jsonl);
    lines.emplace(options.jsonl, "", "");
  }
  if (!options.pictures.empty()) PrepareFolderOf(NameOf(options.pictures, 0));
  fmt::print(
      "{:>6} {:>5} {:20} {:>7} {:>6} {:>7}{}\n", "frame", "tag", "name", "hamming", "margin",
      "edge px",
      finder.camera() ? "      x m      y m      z m  px RMS" : "   (no --camera: no poses)");
  size_t num_tags = 0, num_frames = 0;
  const Interrupt interrupt;
  while (!interrupt.asked()) {
    auto frame = source->Next();
    if (!frame) break;
    ++num_frames;
    std::vector<Found> all = finder.Find(frame->grey);
    num_tags += all.size();
    if (!options.pictures.empty()) {
      DrawFound(all, finder, &frame->bgr);
      std::vector<uchar> jpeg;
      cv::imencode(".jpg", frame->bgr, jpeg);
      WriteFileAtomically(NameOf(options.pictures, frame->index),
                          {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
    }
    if (options.axes == kRosAxes) InRosAxes(&all);
    for (const Found& found : all) Print(frame->index, found);
    if (lines) lines->Append(LineOf(*frame, all, options).dump() + "\n");
  }
  if (lines) lines->Close();
  fmt::print("tags: {}, pictures: {}\n", num_tags, num_frames);
  if (num_tags > 0) return kDone;
  fmt::print(stderr,
             "poselift: {}: found no tag, wanted some of {}: look with poselift doctor {}\n",
             options.inputs.input, options.tags.empty() ? options.family : options.tags,
             options.inputs.input);
  return kFailed;
}

}  // namespace

CLI::App* AddTagsFind(CLI::App* tags, Run* run) {
  auto options = std::make_shared<Options>();
  TrackingInputs* const inputs = &options->inputs;
  CLI::App* command = tags->add_subcommand("find", "Which tags pictures show, and where they are");
  command->footer(
      "With a camera: the position and rotation of each tag, cam_from_tag, and where its corners\n"
      "leave two ways to lean, both, the likelier first. Axes of a tag: x right and y down as it\n"
      "is printed, z into the paper; of apriltag_ros: y up, z out of it.\n"
      "Example: poselift tags find photo.jpg --camera cam.yaml --size-mm 60 --pictures out/tags");
  command
      ->add_option("INPUT,--device", inputs->input,
                   "A picture, a folder of pictures, a video, or a camera (/dev/video0, or 0)")
      ->required();
  command->add_option("--camera", inputs->camera,
                      "Calibrated camera, for poses (see poselift calibrate)");
  CLI::Option* const worn =
      command->add_option("--tags", options->tags, "The tags of a tags.toml, no others");
  command->add_option("--family", options->family, "Family of the tags")
      ->capture_default_str()
      ->excludes(worn);
  command->add_option("--size-mm", options->size_mm, "Their size: the edge of the black square")
      ->check(CLI::Range(2.0, 10000.0))
      ->capture_default_str()
      ->excludes(worn);
  command->add_option("--axes", options->axes, "Of the tags' poses")
      ->check(CLI::IsMember({"poselift", kRosAxes}))
      ->capture_default_str();
  command->add_option("--jsonl", options->jsonl, "File for all that is known, a line a picture");
  command->add_option("--pictures", options->pictures, "Folder for pictures with the tags' axes");
  command->add_option("--fps", inputs->folder_rate_hz, "Folder: pictures a second")
      ->check(IsFrameRate())
      ->capture_default_str();
  AddCameraOptions(command, &inputs->device);
  command->parse_complete_callback([command, options] {
    if (options->inputs.camera.empty())
      RefuseOptions(*command, {"--axes"}, "tags have poses with --camera alone");
  });
  *run = [options] { return Find(*options); };
  return command;
}

}  // namespace poselift::cli
