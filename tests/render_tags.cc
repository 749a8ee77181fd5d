// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Renders a motion with tags on the body: poselift_render_tags MOTION --out DIR. Writes
// pictures or a video, the camera (camera.yaml), what the person wears (tags.toml) and the
// truth: the poses (poses.json) and what each picture shows of the tags (tags.json). For soak tests
// and the pictures of the documentation. With --detect it says which share of the whole tags the
// detector finds.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <string>

#include "calib/tag_detector.h"
#include "calib/tag_family.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_yaml.h"
#include "src/io/image.h"
#include "src/io/motion_file.h"
#include "src/io/poses_json.h"
#include "src/joint_angles.h"
#include "src/level_camera.h"
#include "src/testing/body_renderer.h"
#include "src/testing/studio.h"
#include "src/testing/tag_placement.h"
#include "src/units.h"
#include "tests/support/detection_tally.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using testing::BodyRenderer;
using testing::FrameTruth;

struct Options {
  double fps = 0.0;
  std::string motion, out, skeleton, camera, video, background, family = "tag36h11";
  double distance_m = 3.0, azimuth_deg = 0.0, size_mm = 80.0, rate_hz = 30.0, exposure_ms = 8.0,
         noise = 2.0, from_s = 0.0, seconds = 0.0;
  bool around = false, on_the_spot = false, grey = false, detect = false;
  std::uint64_t seed = 1;
};

void Declare(CLI::App* app, Options* options) {
  app->add_option("motion", options->motion, "BVH or AMC of a CMU skeleton")->required();
  app->add_option("--skeleton", options->skeleton, "ASF of an AMC");
  app->add_option("--fps", options->fps, "of an AMC, which does not say (default: 120)");
  app->add_option("--out", options->out, "folder to write to");
  app->add_flag("--detect", options->detect, "print what the detector finds");
  app->add_option("--video", options->video,
                  "name of a video there (.avi, .mkv: Motion JPEG); else PNG");
  app->add_option("--camera", options->camera, "camera YAML instead of a 1280 x 720 webcam");
  app->add_option("--distance", options->distance_m, "m before the body")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app->add_option("--azimuth", options->azimuth_deg, "degrees about the body, to its left");
  app->add_flag("--on-the-spot", options->on_the_spot, "a treadmill: keeps the distance");
  app->add_option("--from", options->from_s, "s of the motion that are skipped");
  app->add_option("--seconds", options->seconds, "0: to the end");
  app->add_option("--rate", options->rate_hz, "pictures a second")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app->add_option("--exposure", options->exposure_ms, "ms; 0: no blur")->capture_default_str();
  app->add_option("--noise", options->noise, "grey levels")->capture_default_str();
  app->add_option("--seed", options->seed, "of noise and background")->capture_default_str();
  app->add_option("--background", options->background, "a photo behind the body");
  app->add_option("--size", options->size_mm, "of the tags, mm")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app->add_option("--family", options->family, "of the tags")->capture_default_str();
  app->add_flag("--around", options->around, "tags on all sides");
  app->add_flag("--grey", options->grey, "grey pictures");
}

Motion ReadWalk(const Options& options) {
  Motion motion = ReadMotion(options.motion, {.skeleton = options.skeleton});
  if (options.fps > 0.0) motion.frame_time_s = 1.0 / options.fps;
  const auto first = static_cast<size_t>(options.from_s / motion.frame_time_s);
  if (options.from_s < 0.0 || first >= motion.frames.size())
    throw InputError(options.motion,
                     fmt::format("found {:.3f} s, wanted more than --from {} s",
                                 motion.frame_time_s * motion.frames.size(), options.from_s));
  motion.frames.erase(motion.frames.begin(), motion.frames.begin() + first);
  if (const auto frames = static_cast<size_t>(options.seconds / motion.frame_time_s);
      options.seconds > 0.0 && frames + 1 < motion.frames.size())
    motion.frames.resize(frames + 1);
  return options.on_the_spot ? testing::OnTheSpot(std::move(motion)) : motion;
}

// With the lengths of the body's bones.
BodyTags Wear(const Options& options, const Skeleton& skeleton) {
  const TagFamily family(options.family);
  const double cells = family.cells(), cells_of_size = family.cells_of_size();
  BodyTags tags = testing::DefaultTagPlacement(skeleton, {.size_m = 1e-3 * options.size_mm,
                                                          .paper_per_size = cells / cells_of_size,
                                                          .around = options.around});
  tags.family = options.family;
  for (int j = 1; j < kNumJoints; ++j) {
    const JointInfo& joint = Joints()[static_cast<size_t>(j)];
    const auto bone = skeleton.FindBone(joint.cmu_bone);
    if (!bone) continue;
    const double length_m = skeleton.bones[static_cast<size_t>(*bone)].tip_m.norm();
    tags.bone_lengths_m.emplace_back(joint.name, length_m);
  }
  return tags;
}

BodyRenderer MakeRenderer(const Options& options, const Skeleton& skeleton, const BodyTags& tags,
                          const testing::PlacedCamera& placed) {
  const TagFamily family(options.family);
  testing::RenderOptions render{.exposure_s = 1e-3 * options.exposure_ms,
                                .noise_grey_levels = options.noise,
                                .seed = options.seed,
                                .color = !options.grey};
  if (!options.background.empty()) render.background = ReadImage(options.background);
  const auto print_of = [&](int id) -> testing::TagPrint {
    return {family.Image(id), family.cells_of_size()};
  };
  return {skeleton, tags, print_of, placed.camera, placed.cam_from_world, render};
}

// Truth as poses.json has it: of a level camera.
class PosesOfTruth {
 public:
  PosesOfTruth(const Skeleton& skeleton, const Eigen::Isometry3d& cam_from_world)
      : reader_(skeleton), cam_from_world_(cam_from_world) {}

  void Add(const FrameTruth& truth, const std::string& image) {
    SkeletonPose in_cam = truth.pose;
    in_cam.root_in_world_m = cam_from_world_ * truth.pose.root_in_world_m;
    in_cam.world_from_root = Eigen::Quaterniond(cam_from_world_.linear()) * in_cam.world_from_root;
    const SkeletonPose level = LevelFromCam(in_cam);
    angles_deg_ = angles_deg_.size() ? reader_.ReadDeg(level, angles_deg_) : reader_.ReadDeg(level);
    PersonPose person{.status = "ok"};
    person.pelvis_in_cam_m = truth.joints_in_cam_m.col(joint::kPelvis);
    person.joints_in_cam_m = truth.joints_in_cam_m.colwise() - person.pelvis_in_cam_m;
    person.rotation_cam_from_body = in_cam.world_from_root;
    for (Eigen::Index i = 0; i < angles_deg_.size(); ++i)
      person.angles_deg.emplace_back(JointAngles()[i].name, angles_deg_[i]);
    poses_.frames.push_back({image, truth.time_s, {std::move(person)}});
  }
  const Poses& poses() const { return poses_; }

 private:
  JointAngleReader reader_;
  Eigen::Isometry3d cam_from_world_;
  Eigen::VectorXd angles_deg_;
  Poses poses_;
};

Json Rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * 1e6) * 1e-6;
}

Json TagsJson(const FrameTruth& truth, const std::string& image) {
  Json frame = {{"image", image}, {"time_s", Rounded(truth.time_s)}, {"tags", Json::array()}};
  for (const testing::TagTruth& tag : truth.tags) {
    Json row = {{"id", tag.id}, {"corners_px", Json::array()}};
    for (int i = 0; i < 4; ++i)
      row["corners_px"].push_back({Rounded(tag.corners_px(0, i)), Rounded(tag.corners_px(1, i))});
    row["visible_share"] = Rounded(tag.visible_share);
    row["facing_deg"] = Rounded(kDegFromRad * tag.facing_rad);
    row["size_px"] = Rounded(tag.size_px);
    row["speed_px_per_s"] = Rounded(tag.speed_px_per_s);
    for (const double x : tag.cam_from_tag.translation()) row["tag_in_cam_m"].push_back(Rounded(x));
    const Eigen::Quaterniond q(tag.cam_from_tag.linear());
    row["rotation_cam_from_tag"] = {Rounded(q.w()), Rounded(q.x()), Rounded(q.y()), Rounded(q.z())};
    frame["tags"].push_back(std::move(row));
  }
  return frame;
}

// Pictures into a folder or a video.
class PictureWriter {
 public:
  PictureWriter(const Options& options, const Camera& camera) : options_(options) {
    fs::create_directories(options.out);
    if (options.video.empty()) return;
    const fs::path path = fs::path(options.out) / options.video;
    video_.emplace(path.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), options.rate_hz,
                   cv::Size(camera.width_px, camera.height_px), !options.grey);
    if (!video_->isOpened()) throw InputError(path.string(), "cannot write this video");
  }

  std::string Write(int index, const cv::Mat& picture) {
    if (video_) {
      video_->write(picture);
      return options_.video;
    }
    const std::string name = fmt::format("{:06}.png", index);
    WritePng(fs::path(options_.out) / name, picture);
    return name;
  }

 private:
  const Options& options_;
  std::optional<cv::VideoWriter> video_;
};

// All that is written to the folder.
class RunWriter {
 public:
  RunWriter(const Options& options, const Skeleton& skeleton, const BodyTags& worn,
            const testing::PlacedCamera& placed)
      : out_(options.out),
        camera_(placed.camera),
        worn_(worn),
        pictures_(options, placed.camera),
        poses_(skeleton, placed.cam_from_world),
        tags_({{"family", options.family}, {"frames", Json::array()}}) {}

  void Add(const testing::RenderedFrame& frame) {
    const std::string image =
        pictures_.Write(static_cast<int>(tags_["frames"].size()), frame.picture);
    poses_.Add(frame.truth, image);
    tags_["frames"].push_back(TagsJson(frame.truth, image));
  }

  void Finish() const {
    WriteCameraYaml(camera_, out_ / "camera.yaml");
    WriteBodyTags(worn_, out_ / "tags.toml");
    WritePosesJson(poses_.poses(), out_ / "poses.json");
    WriteFileAtomically(out_ / "tags.json", tags_.dump() + "\n");
  }

 private:
  fs::path out_;
  Camera camera_;
  BodyTags worn_;
  PictureWriter pictures_;
  PosesOfTruth poses_;
  Json tags_;
};

cv::Mat GreyOf(const cv::Mat& picture) {
  cv::Mat grey = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

void Run(const Options& options) {
  const Motion motion = ReadWalk(options);
  const testing::PlacedCamera placed = testing::CameraBefore(
      motion, options.distance_m, kRadFromDeg * options.azimuth_deg,
      options.camera.empty() ? testing::Webcam() : ReadCameraYaml(options.camera));
  const BodyTags worn = Wear(options, motion.skeleton);
  const BodyRenderer renderer = MakeRenderer(options, motion.skeleton, worn, placed);
  std::optional<RunWriter> writer;
  if (!options.out.empty()) writer.emplace(options, motion.skeleton, worn, placed);
  TagDetector detector{TagFamily(options.family)};
  testing::DetectionTally tally;
  const BodyRenderer::PoseAt pose_at = testing::PosesOver(motion);
  const double length_s = motion.frame_time_s * static_cast<double>(motion.frames.size() - 1);
  for (int i = 0; i / options.rate_hz <= length_s; ++i) {
    const testing::RenderedFrame frame = renderer.Render(pose_at, i / options.rate_hz);
    if (writer) writer->Add(frame);
    if (options.detect) tally.Add(frame.truth, detector.Detect(GreyOf(frame.picture)));
  }
  if (writer) writer->Finish();
  if (options.detect)
    fmt::print("whole {} found {} share {:.3f} wrong {} corner rms {:.3f} px\n", tally.visible,
               tally.found, tally.Share(), tally.wrong, tally.CornerRms_px());
}

}  // namespace
}  // namespace poselift

int main(int argc, char** argv) {
  CLI::App app("Renders a motion with tags on the body, with its truth.");
  poselift::Options options;
  poselift::Declare(&app, &options);
  CLI11_PARSE(app, argc, argv);
  try {
    poselift::Run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
