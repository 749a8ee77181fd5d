// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Draws the pictures of docs/ANGLES.md: angle_pictures OUTDIR. A panel shows one
// angle at a positive value in the pose of which JointAngleReader says just that:
// so the pictures cannot disagree with the code. What is not zero besides is
// written below.
#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "lift/default_dictionary.h"
#include "lift/dictionary_file.h"
#include "src/draw/xml_text.h"
#include "src/forward_kinematics.h"
#include "src/joint_angles.h"
#include "src/units.h"

namespace poselift {
namespace {

constexpr double kWidth_px = 270, kHeight_px = 338, kText_px = 17;  // of a panel, of a line

using Angles = std::map<std::string, double>;  // degrees; those not named are zero

struct View {
  const char* name;
  Eigen::Vector3d right, up;  // on paper; x is the subject's left, y up, z forward

  Eigen::Vector2d operator()(const Eigen::Vector3d& x_in_world_m) const {
    return 1000 * Eigen::Vector2d(right.dot(x_in_world_m), -up.dot(x_in_world_m));
  }
};

// The eye is so far from the front towards the subject's left, and so high.
View ViewFrom(const char* name, double azimuth_deg, double height_deg) {
  const double a = kRadFromDeg * azimuth_deg, h = kRadFromDeg * height_deg;
  return {name,
          {std::cos(a), 0, -std::sin(a)},
          {-std::sin(h) * std::sin(a), std::cos(h), -std::sin(h) * std::cos(a)}};
}
const View kFromLeft = ViewFrom("from the left", 90, 0),
           kFromFront = ViewFrom("from the front", 0, 0),
           kFromAbove = ViewFrom("from above", 0, 90),
           kOblique = ViewFrom("from the front, above and a little left", 20, 35);

// How an angle is drawn.
struct Panel {
  std::string of;  // the angles whose names contain this
  double value_deg;
  const View& view;
  double window_m;
  std::string tracer;  // the shape whose way the arrow shows
  std::string center;  // the shape whose tip is in the middle; empty: the whole figure
};

const Panel& PanelOf(const std::string& angle) {
  static const std::vector<Panel> kPanels = {
      {"pelvis.tilt", 25, kFromLeft, 1.85, "head", ""},
      {"pelvis.obliquity", 20, kFromFront, 1.85, "head", ""},
      {"pelvis.rotation", 40, kFromAbove, 0.75, "lclavicle", ""},
      {"neck.flexion", 30, kFromLeft, 0.65, "head", "lowerneck"},
      {"neck.lateral_bend", 25, kFromFront, 0.65, "head", "lowerneck"},
      {"neck.rotation", 40, kFromAbove, 0.65, "nose", ""},
      {"head.flexion", 30, kFromLeft, 0.65, "nose", "lowerneck"},
      {"head.lateral_bend", 25, kFromFront, 0.65, "head", "lowerneck"},
      {"head.rotation", 40, kFromAbove, 0.65, "nose", ""},
      {"left_hip.flexion", 60, kFromLeft, 1.85, "lfemur", ""},
      {"left_hip.abduction", 35, kFromFront, 1.85, "lfemur", ""},
      {"left_hip.rotation", 30, kOblique, 1.85, "ltibia", ""},
      {"left_knee.flexion", 60, kFromLeft, 1.85, "ltibia", ""},
      {"left_ankle.dorsiflexion", 20, kFromLeft, 0.5, "ltoes", "lfoot"},
      {"left_ankle.inversion", 25, kFromFront, 0.5, "lheel", "lfoot"},
      {"left_ankle.rotation", 30, kOblique, 0.5, "ltoes", "lfoot"},
      {"left_shoulder.flexion", 60, kFromLeft, 1.85, "lhumerus", ""},
      {"left_shoulder.abduction", 60, kFromFront, 1.85, "lhumerus", ""},
      {"left_shoulder.rotation", 40, kOblique, 1.0, "lradius", "lhumerus"},
      {"left_elbow.flexion", 70, kFromLeft, 1.85, "lradius", ""},
      {"left_wrist.pronation", 50, kOblique, 0.35, "lthumb", "lradius"},
      {".flexion", 25, kFromLeft, 1.85, "head", ""},  // of the spine
      {".lateral_bend", 20, kFromFront, 1.85, "head", ""},
      {".rotation", 35, kFromAbove, 0.75, "lclavicle", ""}};
  for (const Panel& panel : kPanels)
    if (angle.find(panel.of) != std::string::npos) return panel;
  throw std::logic_error("no panel for " + angle);
}

// The figures before and after the movement are bent so, for it to be seen.
Angles BaseOf(const std::string& angle) {
  if (angle == "left_hip.rotation") return {{"left_hip.flexion", 90}, {"left_knee.flexion", 90}};
  if (angle == "left_shoulder.rotation") return {{"left_elbow.flexion", 90}};
  // Only with the toes down can the foot's second dof turn the sole.
  if (angle == "left_ankle.inversion") return {{"left_ankle.dorsiflexion", -60}};
  return {};
}

Eigen::Index IndexOf(const std::string& angle) {
  for (size_t i = 0; i < JointAngles().size(); ++i)
    if (JointAngles()[i].name == angle) return static_cast<Eigen::Index>(i);
  throw std::logic_error("no angle " + angle);
}

// Finds poses by their angles.
class Stander {
 public:
  explicit Stander(const Skeleton& skeleton) : skeleton_(skeleton), reader_(skeleton) {}

  // Gauss-Newton from `pose`. A foot has fewer dofs than angles: the named ones
  // must be met, the others are then as near to zero as can be.
  SkeletonPose Pose(const Angles& named, SkeletonPose pose) const {
    Eigen::VectorXd wanted_deg = Eigen::VectorXd::Zero(reader_.ReadDeg(pose).size());
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(wanted_deg.size());
    for (const auto& [name, value_deg] : named) {
      wanted_deg[IndexOf(name)] = value_deg;
      weights[IndexOf(name)] = 1000;
    }
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Eigen::VectorXd error_deg = wanted_deg - reader_.ReadDeg(pose, wanted_deg);
      const Eigen::MatrixXd J_deg = weights.asDiagonal() * reader_.DerivativeDeg(pose);
      const Eigen::VectorXd step =
          J_deg.completeOrthogonalDecomposition().solve(weights.cwiseProduct(error_deg));
      const Eigen::Vector3d w = step.head<3>();
      pose.world_from_root =
          Eigen::AngleAxisd(w.norm(), w.stableNormalized()) * pose.world_from_root;
      pose.dofs += step.tail(pose.dofs.size());
      if (step.norm() < 1e-8) break;
    }
    const Eigen::VectorXd read_deg = reader_.ReadDeg(pose);
    for (const auto& [name, value_deg] : named)
      if (!(std::abs(read_deg[IndexOf(name)] - value_deg) < 0.5))
        throw std::runtime_error(fmt::format("no pose has {} {}", name, value_deg));
    return pose;
  }

  // The angles of a pose that are not zero.
  Angles Read(const SkeletonPose& pose) const {
    const Eigen::VectorXd read_deg = reader_.ReadDeg(pose);
    Angles angles;
    for (const JointAngle& angle : JointAngles())
      if (const double value_deg = read_deg[IndexOf(angle.name)]; std::abs(value_deg) > 0.5)
        angles[angle.name] = value_deg;
    return angles;
  }

  BoneFrames Frames(const SkeletonPose& pose) const {
    BoneFrames frames;
    ForwardKinematics(skeleton_, pose, &frames);
    return frames;
  }

 private:
  const Skeleton& skeleton_;
  JointAngleReader reader_;
};

// What is drawn of a bone and moves with it: a line, a face, or a ball.
struct Shape {
  std::string name;
  int bone;
  std::vector<Eigen::Vector3d> points_in_bone_m;  // from the bone's start
  double radius_m = 0;                            // of a ball about the first point
};

Eigen::Vector2d OnPaper(const View& view, const BoneFrames& frames, int bone,
                        const Eigen::Vector3d& x_in_bone_m) {
  return view(frames.start_in_world_m.col(bone) + frames.world_from_bone[bone] * x_in_bone_m);
}

// The bones, and what shows how they are turned: skull and nose, palm and thumb,
// heel and sole, measured on the figure that stands straight.
std::vector<Shape> BodyShapes(const Skeleton& skeleton, const BoneFrames& standing) {
  std::vector<Shape> shapes;
  for (int b = 0; b < static_cast<int>(skeleton.bones.size()); ++b) {
    const Eigen::Matrix3d world_from_bone = standing.world_from_bone[b];
    const auto add = [&](const std::string& name, std::vector<Eigen::Vector3d> points_m,
                         double radius_m = 0) {
      for (Eigen::Vector3d& point_m : points_m) point_m = world_from_bone.transpose() * point_m;
      shapes.push_back({name, b, points_m, radius_m});
    };
    const std::string& name = skeleton.bones[b].name;
    const Eigen::Vector3d start(0, 0, 0), tip = world_from_bone * skeleton.bones[b].tip_m;
    add(name, {start, tip});
    if (name == "head") {
      add("skull", {{0, 0.03, 0.02}}, 0.095);
      add("nose", {{0, 0.03, 0.11}, {0, 0.015, 0.15}});
    } else if (name.ends_with("wrist")) {
      const Eigen::Vector3d wide(0, 0, 0.03);
      add("palm", {start - wide / 2, start + wide / 2, tip + wide, tip - wide, start - wide / 2});
      add(name.substr(0, 1) + "thumb", {start, {0, -0.05, 0.07}});
    } else if (name.ends_with("foot")) {
      const Eigen::Vector3d wide(0.04, 0, 0), heel(0, tip.y() - 0.02, -0.05),
          toes(tip.x(), heel.y(), tip.z() + 0.06);
      add("sole", {heel - wide, heel + wide, toes + wide, toes - wide, heel - wide});
      add(name.substr(0, 1) + "heel", {start, heel});
      add(name.substr(0, 1) + "toes", {tip, toes});
    }
  }
  return shapes;
}

class Artist {
 public:
  explicit Artist(const Skeleton& skeleton)
      : skeleton_(skeleton),
        stander_(skeleton),
        standing_(stander_.Pose({}, SkeletonPose::Rest(skeleton))),
        shapes_(BodyShapes(skeleton, stander_.Frames(standing_))) {}

  // A panel with its left upper corner here.
  std::string Draw(const JointAngle& angle, double x_px, double y_px) const {
    const Panel& panel = PanelOf(angle.name);
    Angles angles = BaseOf(angle.name);
    SkeletonPose pose = stander_.Pose(angles, standing_);
    std::vector<BoneFrames> way = {stander_.Frames(pose)};
    constexpr int kSteps = 12;
    for (int step = 1; step <= kSteps; ++step) {
      angles[angle.name] = panel.value_deg * step / kSteps;
      pose = stander_.Pose(angles, pose);
      way.push_back(stander_.Frames(pose));
    }
    std::string others;
    for (const auto& [name, value_deg] : stander_.Read(pose))
      if (name != angle.name)
        others += fmt::format("{}{} {:.0f}", others.empty() ? "with " : ", ",
                              name.substr(name.starts_with("left_") ? 5 : 0), value_deg);
    const auto text = [&](double below_px, const char* style, const std::string& words) {
      return fmt::format("<text x=\"{:g}\" y=\"{:g}\"{}>{}</text>\n", x_px + kWidth_px / 2,
                         y_px + below_px, style, EscapedXml(words));
    };
    return text(kText_px, " font-weight=\"bold\" font-size=\"14\"",
                fmt::format("{} = {:g}°", angle.name, panel.value_deg)) +
           text(2 * kText_px, "", angle.positive) +
           Window(panel, way, x_px, y_px + 2 * kText_px + 8) +
           text(kHeight_px - kText_px - 6, " fill=\"#666666\"", panel.view.name) +
           text(kHeight_px - 8, " fill=\"#666666\"", others);
  }

 private:
  // The figures, in millimetres.
  std::string Window(const Panel& panel, const std::vector<BoneFrames>& way, double x_px,
                     double y_px) const {
    const BoneFrames &zero = way.front(), &moved = way.back();
    const auto is_moved = [&](int b) {
      return !moved.world_from_bone[b].isApprox(zero.world_from_bone[b], 1e-3);
    };
    int segment = 0;
    while (!is_moved(segment)) ++segment;
    const auto is_segment = [&](int b) { return SegmentOf(b) == segment; };
    const View& view = panel.view;
    const Eigen::Vector2d middle = Middle(panel, zero, moved);
    const double width = 1000 * panel.window_m, side_px = kWidth_px - 10;
    std::string svg = fmt::format(
        "<svg x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" viewBox=\"{:.0f} {:.0f} {:g} "
        "{:g}\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
        x_px + 5, y_px, side_px, side_px, middle.x() - width / 2, middle.y() - width / 2, width,
        width);
    const double px = width / side_px;
    const auto put = [&](const BoneFrames& frames, const char* color, double width_px,
                         const auto& which) {
      svg += fmt::format(
          "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:.1f}\" fill=\"{}\" "
          "fill-opacity=\"0.15\"/>\n",
          Outlines(view, frames, which), color, width_px * px, color);
    };
    put(zero, "#b0b0b0", 1.3, is_moved);
    put(moved, "#404040", 2.2, [&](int b) { return !is_moved(b); });
    put(moved, "#e69f00", 2.6, [&](int b) { return is_moved(b) && !is_segment(b); });
    put(moved, "#d55e00", 4, is_segment);
    return svg + Arrow(panel, way, px) + "</svg>\n";
  }

  int SegmentOf(int bone) const {  // a bone without dofs is part of its parent
    while (bone > 0 && skeleton_.bones[bone].dofs.empty()) bone = skeleton_.bones[bone].parent;
    return bone;
  }

  // From the start of a shape (0) to its tip (1).
  Eigen::Vector2d Along(const std::string& name, double part, const View& view,
                        const BoneFrames& frames) const {
    for (const Shape& shape : shapes_)
      if (shape.name == name)
        return OnPaper(
            view, frames, shape.bone,
            (1 - part) * shape.points_in_bone_m.front() + part * shape.points_in_bone_m.back());
    throw std::logic_error("no shape " + name);
  }

  Eigen::Vector2d Middle(const Panel& panel, const BoneFrames& zero,
                         const BoneFrames& moved) const {
    if (!panel.center.empty()) return Along(panel.center, 1, panel.view, zero);
    Eigen::AlignedBox2d box;
    for (const Shape& shape : shapes_)
      for (const BoneFrames* frames : {&zero, &moved})
        for (const Eigen::Vector3d& point_m : shape.points_in_bone_m)
          box.extend(OnPaper(panel.view, *frames, shape.bone, point_m));
    return box.center();
  }

  template <typename Which>
  std::string Outlines(const View& view, const BoneFrames& frames, const Which& which) const {
    std::string path;
    for (const Shape& shape : shapes_) {
      if (!which(shape.bone)) continue;
      const double radius = 1000 * shape.radius_m;
      char command = 'M';
      for (const Eigen::Vector3d& point_m : shape.points_in_bone_m) {
        const Eigen::Vector2d point = OnPaper(view, frames, shape.bone, point_m);
        path += fmt::format("{}{:.0f} {:.0f}", command, point.x() - radius, point.y());
        command = 'L';
      }
      if (radius > 0)
        path += fmt::format("a{0:g} {0:g} 0 0 0 {1:g} 0a{0:g} {0:g} 0 0 0 {2:g} 0", radius,
                            2 * radius, -2 * radius);
    }
    return path;
  }

  static constexpr double kArrowPlace = 0.8;  // on the tracer, from its start
  std::string Arrow(const Panel& panel, const std::vector<BoneFrames>& way, double px) const {
    std::string path;
    for (const BoneFrames& frames : way) {
      const Eigen::Vector2d point = Along(panel.tracer, kArrowPlace, panel.view, frames);
      path += fmt::format("{}{:.0f} {:.0f}", path.empty() ? 'M' : 'L', point.x(), point.y());
    }
    return fmt::format(
        "<path d=\"{}\" stroke=\"#0072b2\" stroke-width=\"{:.1f}\" marker-end=\"url(#head)\"/>\n",
        path, 1.8 * px);
  }

  const Skeleton& skeleton_;
  Stander stander_;
  SkeletonPose standing_;
  std::vector<Shape> shapes_;
};

// One picture for these joints. Returns the number of its panels.
size_t WriteSheet(const Artist& artist, const std::vector<std::string>& joints,
                  const std::filesystem::path& path) {
  std::vector<const JointAngle*> angles;
  for (const std::string& joint : joints)
    for (const JointAngle& angle : JointAngles())
      if (angle.name.starts_with(joint + ".")) angles.push_back(&angle);
  const size_t columns = angles.size() % 3 == 0 ? 3 : angles.size();
  const size_t rows = angles.size() / columns;
  std::string panels;
  for (size_t row = 0, next = 0; row < rows; ++row)
    for (size_t column = 0; column < columns; ++column)
      panels += artist.Draw(*angles[next++], kWidth_px * static_cast<double>(column),
                            kHeight_px * static_cast<double>(row));
  std::ofstream file(path);
  file << fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" font-family=\"sans-serif\" font-size=\"11\" text-anchor=\"middle\">\n"
      "<marker id=\"head\" viewBox=\"0 0 10 10\" refX=\"8\" refY=\"5\" markerWidth=\"5\" "
      "markerHeight=\"5\" orient=\"auto\"><path d=\"M0 0L10 5L0 10Z\" fill=\"#0072b2\"/></marker>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      kWidth_px * static_cast<double>(columns), kHeight_px * static_cast<double>(rows), panels);
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  return angles.size();
}

void WriteSheets(const std::filesystem::path& folder) {
  const std::map<std::string, std::vector<std::string>> sheets = {
      {"pelvis_and_spine", {"pelvis", "lower_back", "upper_back", "thorax"}},
      {"neck_and_head", {"lower_neck", "upper_neck", "head"}},
      {"hip", {"left_hip"}},
      {"knee_and_ankle", {"left_knee", "left_ankle"}},
      {"shoulder", {"left_shoulder"}},
      {"elbow_and_wrist", {"left_elbow", "left_wrist"}}};
  const Skeleton skeleton = ReadDictionary(DefaultDictionaryPath()).skeleton;
  const Artist artist(skeleton);
  std::filesystem::create_directories(folder);
  size_t pictured = 0;
  for (const auto& [name, joints] : sheets)
    pictured += WriteSheet(artist, joints, folder / (name + ".svg"));
  const auto is_pictured = [](const JointAngle& angle) {
    return !angle.name.starts_with("right_");
  };
  if (pictured !=
      static_cast<size_t>(std::count_if(JointAngles().begin(), JointAngles().end(), is_pictured)))
    throw std::logic_error("an angle has no picture");
}

}  // namespace
}  // namespace poselift

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: angle_pictures OUTDIR\n");
    return 2;
  }
  try {
    poselift::WriteSheets(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
