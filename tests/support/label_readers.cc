// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/reader_tables.h"

#include <fstream>

#include "src/io/labels.h"
#include "src/io/poses_json.h"
#include "src/layout.h"
#include "ui/cli/truth.h"

namespace poselift::testing {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

std::vector<Reader> LabelReaders() {
  return {
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
  };
}

}  // namespace poselift::testing
