// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/readers.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "calib/april_grid_yaml.h"
#include "lift/dictionary_check.h"
#include "lift/dictionary_file.h"
#include "lift/temporal/motion_codebook_file.h"
#include "src/capture/camera_controls.h"
#include "src/capture/fourcc.h"
#include "src/capture/frame_decoder.h"
#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/io/amc.h"
#include "src/io/body_tags_toml.h"
#include "src/io/bvh.h"
#include "src/io/camera_file.h"
#include "src/io/camera_yaml.h"
#include "src/io/image.h"
#include "src/io/jpeg_frame.h"
#include "src/io/labels.h"
#include "src/io/poses_json.h"
#include "src/io/video.h"
#include "src/layout.h"
#include "tests/support/fake_camera.h"
#include "tests/support/made_up_asf.h"
#include "tests/support/made_up_video.h"
#include "tests/support/mutation.h"
#include "tests/support/random_codebook.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"
#include "ui/cli/recognisers.h"
#include "ui/cli/truth.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

void WriteBytes(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

auto Text(std::string text) {
  return [text = std::move(text)](const fs::path&) { return text; };
}

// What write(path) writes.
template <typename Write>
auto Written(const std::string& file, Write write) {
  return [file, write](const fs::path& dir) {
    write(dir / file);
    return FileText(dir / file);
  };
}

auto Golden(const std::string& file) {
  return [file](const fs::path&) { return FileText(SourcePath("tests/golden/" + file)); };
}

// Motions.

std::string FlawOf(const Motion& motion) {
  if (!(motion.frame_time_s > 0.0) || !std::isfinite(motion.frame_time_s)) return "a frame time";
  BoneFrames frames;
  for (const SkeletonPose& pose : motion.frames) {
    if (!pose.dofs.allFinite()) return "an angle that is not finite";
    ForwardKinematics(motion.skeleton, pose, &frames);
    if (!frames.tip_in_world_m.allFinite()) return "a place that is not finite";
  }
  return "";
}

const AsfSkeleton& SkeletonIn(const fs::path& dir) {
  static const AsfSkeleton asf = [&] {
    WriteBytes(dir / "made_up.asf", kMadeUpAsf);
    return ReadAsfSkeleton(dir / "made_up.asf");
  }();
  return asf;
}

Motion SomeMotion(const fs::path& dir) {
  std::mt19937_64 rng(1);
  return RandomMotion(SkeletonIn(dir).skeleton, 3, &rng);
}

std::string ReadsAsf(const fs::path& path) {
  const AsfSkeleton asf = ReadAsfSkeleton(path);
  return FlawOf({asf.skeleton, 1.0, {SkeletonPose::Rest(asf.skeleton)}});
}

std::string ReadsAmc(const fs::path& path) {
  return FlawOf(ReadAmc(path, SkeletonIn(path.parent_path())));
}

std::string ReadsBvh(const fs::path& path) { return FlawOf(ReadBvh(path)); }

// Labels and poses.

std::string Keypoints(int count, const std::string& triple) {
  std::string numbers;
  for (int i = 0; i < count; ++i) numbers += (i > 0 ? "," : "") + triple;
  return "[" + numbers + "]";
}

std::string CocoText() {
  return R"({"images": [{"id": 7, "file_name": "x.jpg", "width": 64, "height": 48}],
 "annotations": [{"id": 1, "image_id": 7, "category_id": 1, "keypoints": )" +
         Keypoints(17, "10,20,2") + R"(}],
 "categories": [{"id": 1, "name": "person"}]})";
}

std::string ReadsLabels(const fs::path& path) {
  const Labels labels = ReadLabels(path);
  const Layout* const layout = FindLayout(labels.layout);
  if (!layout) return "a layout that is not known";
  for (const FrameLabels& frame : labels.frames)
    for (const PersonLabels& person : frame.people)
      for (const LandmarkLabel& landmark : person.landmarks)
        if (!layout->Find(landmark.name) || !(landmark.x_px.cwiseAbs().maxCoeff() <= 1e6))
          return "a landmark of another layout, or far away";
  return "";
}

std::string ReadsPoses(const fs::path& path) {
  PosesJson(ReadPosesJson(path));
  return "";
}

std::string ReadsPoseLines(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  for (int i = 1; std::getline(file, line); ++i)
    FramePosesLine(ReadFramePosesLine(line, path.string(), i));
  return "";
}

std::string ReadsTruth(const fs::path& path) {
  const cli::Truth truth = cli::ReadTruth(path);
  return truth.x_in_cam_m.allFinite() ? "" : "a place that is not finite";
}

// Cameras, tags, boards.

constexpr const char* kKalibrText = R"(cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]
  distortion_model: radtan
  intrinsics: [458.6, 457.3, 367.2, 248.4]
  resolution: [752, 480]
cam1:
  T_cn_cnm1:
  - [0.99, 0.0, 0.0, -0.11]
  camera_model: pinhole
  distortion_model: none
  distortion_coeffs: []
  intrinsics: [457.5, 456.1, 379.9, 255.2]
  resolution: [752, 480]
)";

constexpr const char* kAniposeText = R"([cam_1]
name = "B"
size = [ 1280, 720,]
matrix = [ [ 900.5, 0.0, 639.5,], [ 0.0, 901.0, 359.5,], [ 0.0, 0.0, 1.0,],]
distortions = [ -0.1, 0.02, 0.001, -0.002, 0.003,]
rotation = [ 0.1, 0.2, 0.3,]

[metadata]
adjusted = false
)";

constexpr const char* kTagsToml = R"(family = "tag25h9"
size_mm = 80

[[tag]]
id = 3
name = "left \"knee\""
joint = "left_knee"
joint_in_tag_mm = [0, -12.5, 60]
joint_sigma_mm = 15

[[tag]]
id = 0
size_mm = 55.5
bone = "left_shin"
position_mm = [10.0, 20, -30]
rotation = [0.0, 1.0, 0.0, 0.0]
rotation_sigma_deg = 4.5

[bone_lengths_mm]
left_knee = 431.25
)";

constexpr const char* kTagsRos = R"(standalone_tags:
  [
    {id: 4, size: 0.08, name: left_wrist},
  ]
tag_bundles:
  - name: left_shin
    layout:
      - {id: 7, size: 0.05, x: 0.1, y: 0.2, z: 0.3, qw: 1, qx: 0, qy: 0, qz: 0}
      - {id: 8, size: 0.05, x: 0, y: 0, z: 0, qw: 0.70710678, qx: 0, qy: 0, qz: 0.70710678}
)";

Camera SomeCamera() { return {640, 480, 650.0, 651.0, 320.25, 240.0, {.k1 = -0.25, .k2 = 0.1}}; }

std::string ReadsCamera(const fs::path& path) {
  for (const std::string& name : CameraNames(path))
    if (const std::string flaw = ReadCamera(path, name).Validate(); !flaw.empty()) return flaw;
  return "";
}

std::string ReadsTags(const fs::path& path) {
  for (const BodyTag& tag : ReadBodyTags(path).tags) {
    if (!(tag.size_m > 0.0) || !std::isfinite(tag.size_m)) return "a size";
    if (!tag.on_joint && !tag.on_bone) return "a tag that is nowhere";
    if (tag.on_joint && !tag.on_joint->joint_in_tag_m.allFinite()) return "an offset";
    if (tag.on_bone && !tag.on_bone->bone_from_tag.matrix().allFinite()) return "a place";
  }
  return "";
}

std::string ReadsAprilGrid(const fs::path& path) { return ReadAprilGridYaml(path).Validate(); }

// Learned models.

// With the size and the checksum of what is there now.
void Seal(const fs::path& path) {
  constexpr size_t kFileBytesAt = 20, kSize = sizeof(uint64_t), kChecksum = sizeof(uint32_t);
  std::string bytes = FileText(path);
  if (bytes.size() < kFileBytesAt + kSize + kChecksum) return;
  const uint64_t num_bytes = bytes.size();
  std::memcpy(bytes.data() + kFileBytesAt, &num_bytes, kSize);
  bytes.resize(bytes.size() - kChecksum);
  const auto checksum =
      static_cast<uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  bytes.append(reinterpret_cast<const char*>(&checksum), kChecksum);
  WriteBytes(path, bytes);
}

std::string ReadsDictionary(const fs::path& path) {
  Seal(path);
  return DictionaryFlaw(ReadDictionary(path));
}

std::string ReadsCodebook(const fs::path& path) {
  Seal(path);
  const MotionCodebook codebook = ReadMotionCodebook(path);
  const AccelerationModels& models = codebook.accelerations;
  const bool finite = codebook.segments.allFinite() && codebook.rates.allFinite() &&
                      codebook.deviations.allFinite() && models.means.allFinite() &&
                      models.directions.allFinite() && models.responses.allFinite() &&
                      models.deviations.allFinite();
  return finite ? "" : "numbers that are not finite";
}

// Pictures, videos, frames.

cv::Mat SomePicture(int seed = 1) {
  std::mt19937_64 rng(static_cast<unsigned>(seed));
  return Texture({24, 16}, &rng);
}

auto Picture(const std::string& ending) {
  return [ending](const fs::path&) {
    std::vector<uchar> bytes;
    cv::imencode(ending, SomePicture(), bytes);
    return std::string(bytes.begin(), bytes.end());
  };
}

std::string ReadsImage(const fs::path& path) {
  const cv::Mat image = ReadImage(path);
  return image.type() == CV_8UC3 && !image.empty() ? "" : "no picture";
}

auto Video(const std::string& file) {
  return Written(file, [](const fs::path& path) {
    WriteVideo(path, {SomePicture(1), SomePicture(2), SomePicture(3)}, 30.0);
  });
}

std::string ReadsVideo(const fs::path& path) {
  VideoFile video(path);
  double last_s = -1.0;
  while (const auto frame = video.Next()) {
    if (frame->bgr.size() != video.size_px() || frame->bgr.type() != CV_8UC3) return "no picture";
    if (!(frame->time_s > last_s)) return "times that do not grow";
    last_s = frame->time_s;
  }
  return "";
}

// The format of a frame, in front of its bytes.
struct FrameHead {
  uint16_t format, width_px, height_px, bytes_per_line;
};
constexpr std::array kFormats = {kFourccMjpg, kFourccYuyv, kFourccNv12, kFourccGrey};

auto Frame(uint16_t format, std::string (*encode)(const cv::Mat& grey)) {
  return [=](const fs::path&) {
    const FrameHead head{format, 24, 16, 0};
    const cv::Mat grey = GreyRamp({head.width_px, head.height_px});
    return std::string(reinterpret_cast<const char*>(&head), sizeof head) + encode(grey);
  };
}

std::string BytesOf(const cv::Mat& grey) { return {grey.ptr<char>(), grey.total()}; }

// A frame as JPEG is refused or a picture between its two marks.
bool IsRefusedAsJpeg(const RawFormat& format, std::vector<uint8_t> frame, std::string* flaw) {
  std::vector<uint8_t> jpeg;
  try {
    if (!JpegEncoder(format).Encode(frame, &jpeg)) return true;
  } catch (const std::invalid_argument&) {
    return true;
  }
  const size_t end = jpeg.size();
  if (end < 4 || jpeg[0] != 0xff || jpeg[1] != 0xd8 || jpeg[end - 2] != 0xff ||
      jpeg[end - 1] != 0xd9)
    *flaw = "a JPEG without its marks";
  return false;
}

std::string ReadsFrame(const fs::path& path) {
  const std::string bytes = FileText(path);
  FrameHead head;
  if (bytes.size() < sizeof head) throw InputError(path, "no frame");
  std::memcpy(&head, bytes.data(), sizeof head);
  const RawFormat format{kFormats[head.format % kFormats.size()],
                         {head.width_px % 512, head.height_px % 512},
                         head.bytes_per_line};
  // Exactly as many on the heap, so that a sanitizer sees what is read behind them.
  const std::vector<uint8_t> frame(bytes.begin() + sizeof head, bytes.end());
  const cv::Mat row(1, static_cast<int>(frame.size()), CV_8UC1, const_cast<uint8_t*>(frame.data()));
  FrameDecoder decoder;
  cv::Mat grey, bgr;
  const std::string no_grey = decoder.ToGrey(format, row, &grey);
  const std::string no_bgr = decoder.ToBgr(format, row, &bgr);
  std::string flaw;
  if (no_grey.empty() && (grey.size() != format.size_px || grey.type() != CV_8UC1))
    flaw = "no grey";
  if (no_bgr.empty() && (bgr.size() != format.size_px || bgr.type() != CV_8UC3))
    flaw = "no colours";
  const bool no_jpeg = IsRefusedAsJpeg(format, frame, &flaw);
  if (flaw.empty() && !no_grey.empty() && !no_bgr.empty() && no_jpeg)
    throw InputError(path, no_grey);
  return flaw;
}

std::string ReadsControl(const fs::path& path) {
  try {
    const ControlValue control = ParseControl(FileText(path));
    return control.name.empty() || control.value.empty() ? "a control without name or value" : "";
  } catch (const InputError& error) {
    throw InputError(path, error.what());
  }
}

void Describe(const fs::path& path, std::string_view head) {
  for (const cli::Recogniser& recogniser : cli::Recognisers())
    if (recogniser.is_it(path, head)) {
      using Json = nlohmann::ordered_json;
      recogniser.describe(path).dump(-1, ' ', false, Json::error_handler_t::replace);
      return;
    }
}

std::vector<Reader> MakeReaders() {
  return {
      {"asf", "a.asf", Text(std::string(kMadeUpAsf)), ReadsAsf},
      {"amc", "a.amc",
       [](const fs::path& dir) {
         WriteAmc(SomeMotion(dir), SkeletonIn(dir), dir / "whole.amc");
         return FileText(dir / "whole.amc");
       },
       ReadsAmc},
      {"bvh", "a.bvh",
       [](const fs::path& dir) {
         WriteBvh(SomeMotion(dir), dir / "whole.bvh");
         return FileText(dir / "whole.bvh");
       },
       ReadsBvh},
      {"labels", "labels.json", Golden("labels.json"), ReadsLabels},
      {"labels_coco", "coco.json", Text(CocoText()), ReadsLabels},
      {"labels_coco_results", "results.json",
       Text(R"([{"image_id": "b.jpg", "score": 2.9, "keypoints": )" + Keypoints(17, "3,4,0.5") +
            "}]"),
       ReadsLabels},
      {"labels_openpose", "a_keypoints.json",
       Text(R"({"version": 1.3, "people": [{"person_id": [-1], "pose_keypoints_2d": )" +
            Keypoints(25, "50,60,0.7") + "}]}"),
       ReadsLabels},
      {"poses", "poses.json", Golden("poses.json"), ReadsPoses},
      {"pose_lines", "poses.jsonl",
       [](const fs::path&) {
         std::string lines;
         for (const auto& frame : ReadPosesJson(SourcePath("tests/golden/poses.json")).frames)
           lines += FramePosesLine(frame);
         return lines;
       },
       ReadsPoseLines},
      {"truth", "truth.json",
       Text(R"({"units": "m", "joints_in_cam": {"pelvis": [0, 0, 3], "neck": [0, -0.3, 3],
 "left_knee": [0.1, 0.4, 3.1], "right_knee": [-0.1, 0.4, 2.9]}})"),
       ReadsTruth},
      {"camera_opencv", "opencv.yaml",
       Written("whole.yaml", [](const fs::path& path) { WriteCameraYaml(SomeCamera(), path); }),
       ReadsCamera},
      {"camera_ros", "ros.yaml",
       Written("whole.yaml",
               [](const fs::path& path) { WriteCameraInfoYaml(SomeCamera(), "cam", path); }),
       ReadsCamera},
      {"camera_kalibr", "kalibr.yaml", Text(kKalibrText), ReadsCamera},
      {"camera_anipose", "anipose.toml", Text(kAniposeText), ReadsCamera},
      {"tags", "tags.toml", Text(kTagsToml), ReadsTags},
      {"tags_ros", "tags.yaml", Text(kTagsRos), ReadsTags},
      {"april_grid", "grid.yaml",
       Written("whole.yaml",
               [](const fs::path& path) {
                 WriteAprilGridYaml({4, 5, 0.04, 0.3, 7, "tag36h11"}, path);
               }),
       ReadsAprilGrid},
      {"dictionary", "a.pldict",
       Written("whole.pldict",
               [](const fs::path& path) {
                 std::mt19937_64 rng(1);
                 WriteDictionary(RandomDictionary(2, &rng), path);
               }),
       ReadsDictionary},
      {"codebook", "a.plmotion",
       Written("whole.plmotion",
               [](const fs::path& path) {
                 WriteMotionCodebook(RandomCodebook(1, std::mt19937_64(1)), path);
               }),
       ReadsCodebook},
      {"image_jpeg", "a.jpg", Picture(".jpg"), ReadsImage},
      {"image_png", "a.png", Picture(".png"), ReadsImage},
      {"image_bmp", "a.bmp", Picture(".bmp"), ReadsImage},
      {"image_tiff", "a.tiff", Picture(".tiff"), ReadsImage},
      {"image_webp", "a.webp", Picture(".webp"), ReadsImage},
      {"image_pnm", "a.ppm", Picture(".ppm"), ReadsImage},
      {"video_avi", "a.avi", Video("whole.avi"), ReadsVideo},
      {"video_mp4", "a.mp4", Video("whole.mp4"), ReadsVideo},
      {"video_mkv", "a.mkv", Video("whole.mkv"), ReadsVideo},
      {"frame_mjpg", "mjpg", Frame(0, [](const cv::Mat& grey) { return AsJpeg(grey, 2); }),
       ReadsFrame},
      {"frame_yuyv", "yuyv", Frame(1, [](const cv::Mat& grey) { return AsYuyv(grey); }),
       ReadsFrame},
      {"frame_nv12", "nv12", Frame(2, [](const cv::Mat& grey) { return AsNv12(grey); }),
       ReadsFrame},
      {"frame_grey", "grey", Frame(3, BytesOf), ReadsFrame},
      {"control", "control", Text("exposure=50"), ReadsControl},
  };
}

}  // namespace

const std::vector<Reader>& Readers() {
  static const std::vector<Reader> readers = MakeReaders();
  return readers;
}

std::string FlawOf(const Reader& reader, std::string_view bytes, const fs::path& dir) {
  const fs::path path = dir / reader.file;
  WriteBytes(path, bytes);
  const std::string flaw = reader.read(path);
  try {
    Describe(path, bytes.substr(0, 4096));
  } catch (const InputError&) {  // what this reader reads may be none of info's
  }
  return flaw;
}

}  // namespace poselift::testing
