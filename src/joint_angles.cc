// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/joint_angles.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "src/forward_kinematics.h"
#include "src/input_error.h"
#include "src/units.h"

namespace poselift {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kGimbalLock = 1e-7;  // cosine of the middle angle, or of half the swing

enum class Sequence { kXzy, kYzx, kSwingTwist };

// One angle: its name, the axis of its part of D and the sign that makes the
// named movement positive.
struct Reading {
  JointAngle angle;
  int axis;
  double sign;
};

struct Row {
  std::string parent;  // a CMU bone; empty: the world
  std::string child;
  Sequence sequence;
  std::vector<Reading> readings;
};

Row SpineRow(const std::string& name, const std::string& below, const std::string& bone) {
  return {below,
          bone,
          Sequence::kXzy,
          {{{name + ".flexion", "bends forward"}, 0, 1},
           {{name + ".lateral_bend", "bends to the subject's left"}, 2, -1},
           {{name + ".rotation", "turns to the subject's left"}, 1, 1}}};
}

// outward: the sign, about z and y, of turns to the outside: 1 left, -1 right.
void AddLimbRows(const std::string& side, const std::string& letter, double outward,
                 std::vector<Row>* rows) {
  const double inward = -outward;
  rows->push_back(
      {"root",
       letter + "femur",
       Sequence::kSwingTwist,
       {{{side + "_hip.flexion", "the thigh swings forward"}, 0, -1},
        {{side + "_hip.abduction", "the thigh swings outward"}, 2, outward},
        {{side + "_hip.rotation", "the thigh turns inward about its length"}, 1, inward}}});
  rows->push_back({letter + "femur",
                   letter + "tibia",
                   Sequence::kXzy,
                   {{{side + "_knee.flexion", "the knee bends, the heel goes back"}, 0, 1}}});
  rows->push_back({letter + "tibia",
                   letter + "foot",
                   Sequence::kXzy,
                   {{{side + "_ankle.dorsiflexion", "the toes rise towards the shin"}, 0, -1},
                    {{side + "_ankle.inversion", "the sole turns inward"}, 2, inward},
                    {{side + "_ankle.rotation", "the toes turn inward"}, 1, inward}}});
  rows->push_back(
      {"thorax",
       letter + "humerus",
       Sequence::kSwingTwist,
       {{{side + "_shoulder.flexion", "the arm swings forward"}, 0, -1},
        {{side + "_shoulder.abduction", "the arm swings outward"}, 2, outward},
        {{side + "_shoulder.rotation", "the arm turns inward about its length"}, 1, inward}}});
  rows->push_back(
      {letter + "humerus",
       letter + "radius",
       Sequence::kXzy,
       {{{side + "_elbow.flexion", "the elbow bends, the hand comes forward"}, 0, -1}}});
  rows->push_back(
      {letter + "radius",
       letter + "wrist",
       Sequence::kXzy,
       {{{side + "_wrist.pronation", "the thumb turns inward, the palm to the back"}, 1, inward}}});
}

std::vector<Row> MakeRows() {
  std::vector<Row> rows = {{"",
                            "root",
                            Sequence::kYzx,
                            {{{"pelvis.tilt", "leans forward"}, 0, 1},
                             {{"pelvis.obliquity", "the left side rises"}, 2, 1},
                             {{"pelvis.rotation", "turns to the subject's left"}, 1, 1}}},
                           SpineRow("lower_back", "root", "lowerback"),
                           SpineRow("upper_back", "lowerback", "upperback"),
                           SpineRow("thorax", "upperback", "thorax"),
                           SpineRow("lower_neck", "thorax", "lowerneck"),
                           SpineRow("upper_neck", "lowerneck", "upperneck"),
                           SpineRow("head", "upperneck", "head")};
  AddLimbRows("left", "l", 1, &rows);
  AddLimbRows("right", "r", -1, &rows);
  return rows;
}

const std::vector<Row>& Rows() {
  static const std::vector<Row> kRows = MakeRows();
  return kRows;
}

double Unwrapped(double angle, double previous) {
  return angle + kTurn_rad * std::round((previous - angle) / kTurn_rad);
}

Eigen::Matrix3d AxisRotation(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

// The angles of D = R_i(a) R_j(b) R_k(c), each at the place of its axis, and
// each the nearest to its previous value.
Eigen::Vector3d EulerAngles(const Eigen::Matrix3d& D, const std::array<int, 3>& axes,
                            bool either_branch, const Eigen::Vector3d& previous) {
  const int i = axes[0], j = axes[1], k = axes[2];
  const double parity = (i + 1) % 3 == j ? 1.0 : -1.0;
  const auto solve = [&](double a) {
    // With a given, the other two are well-conditioned everywhere.
    const Eigen::Matrix3d rest = AxisRotation(i, -a) * D;
    Eigen::Vector3d angles;
    angles[i] = a;
    angles[j] = std::atan2(parity * rest(i, k), rest(k, k));
    angles[k] = std::atan2(parity * rest(j, i), rest(j, j));
    for (int axis = 0; axis < 3; ++axis) angles[axis] = Unwrapped(angles[axis], previous[axis]);
    return angles;
  };
  // In gimbal lock any a is an answer: the previous one.
  if (std::hypot(D(j, k), D(k, k)) < kGimbalLock) return solve(previous[i]);
  const double a = std::atan2(-parity * D(j, k), D(k, k));
  Eigen::Vector3d answer = solve(a);
  if (!either_branch) return answer;
  const Eigen::Vector3d other = solve(a + kTurn_rad / 2);
  return (other - previous).norm() < (answer - previous).norm() ? other : answer;
}

// D = Exp(sx, 0, sz) Ry(t) as (sx, t, sz).
Eigen::Vector3d SwingTwist(const Eigen::Matrix3d& D, const Eigen::Vector3d& previous) {
  const Eigen::Quaterniond q(D);
  const double cos_half_swing = std::hypot(q.w(), q.y());
  const double twist = cos_half_swing < kGimbalLock ? previous.y() : 2 * std::atan2(q.y(), q.w());
  const Eigen::Quaterniond swing =
      q * Eigen::Quaterniond(std::cos(twist / 2), 0, -std::sin(twist / 2), 0);
  Eigen::Vector2d direction(swing.x(), swing.z());
  if (swing.w() < 0) direction = -direction;
  const double sin_half_swing = direction.norm();
  double angle = 2 * std::atan2(sin_half_swing, std::abs(swing.w()));
  if (sin_half_swing > 0) direction /= sin_half_swing;
  // Over the top and on by a quarter turn; a whole turn would again be hanging,
  // where the direction of so long a vector means nothing.
  const double along = direction.dot(Eigen::Vector2d(previous.x(), previous.z()));
  if (angle > kTurn_rad / 4 && along < angle - kTurn_rad / 2) angle -= kTurn_rad;
  return {angle * direction.x(), Unwrapped(twist, previous.y()), angle * direction.y()};
}

Eigen::Vector3d Decomposed(const Eigen::Matrix3d& D, Sequence sequence,
                           const Eigen::Vector3d& previous) {
  switch (sequence) {
    case Sequence::kXzy:
      return EulerAngles(D, {0, 2, 1}, false, previous);
    // Whoever turns a cartwheel passes the gimbal lock; a joint cannot.
    case Sequence::kYzx:
      return EulerAngles(D, {1, 2, 0}, true, previous);
    case Sequence::kSwingTwist:
      return SwingTwist(D, previous);
  }
  return Eigen::Vector3d::Zero();
}

int FindBoneOrThrow(const Skeleton& skeleton, const std::string& name) {
  if (const auto bone = skeleton.FindBone(name)) return *bone;
  throw InputError(skeleton.name,
                   "found no bone '" + name + "', wanted the bones of a CMU skeleton");
}

// world_from_bone of a limb's bone that hangs straight down, turned about its
// length so that the hinge (of the knee or elbow) lies along x: +1 or -1.
Eigen::Matrix3d Hanging(const Skeleton& skeleton, const std::string& bone,
                        const std::string& hinge_bone, double hinge_sign) {
  const Eigen::Vector3d along = skeleton.bones[FindBoneOrThrow(skeleton, bone)].tip_m;
  Eigen::Matrix3d down =
      Eigen::Quaterniond::FromTwoVectors(along, -Eigen::Vector3d::UnitY()).toRotationMatrix();
  if (hinge_bone.empty()) return down;
  const Bone& hinge = skeleton.bones[FindBoneOrThrow(skeleton, hinge_bone)];
  if (hinge.dofs.empty() || !hinge.dofs[0].IsRotation()) return down;
  const Eigen::Vector3d axis = hinge_sign * (down * hinge.rest_from_axis.col(hinge.dofs[0].Axis()));
  return AxisRotation(1, std::atan2(axis.z(), axis.x())) * down;
}

// world_from_bone when the skeleton stands straight, facing z.
Eigen::Matrix3d Standing(const Skeleton& skeleton, const std::string& bone) {
  const std::string side = bone.substr(0, 1);
  const std::string part = bone.substr(1);
  if (part == "femur" || part == "tibia") return Hanging(skeleton, bone, side + "tibia", 1);
  if (part == "foot") return Hanging(skeleton, side + "tibia", side + "tibia", 1);
  if (part == "humerus" || part == "radius") return Hanging(skeleton, bone, side + "radius", -1);
  if (part == "wrist") return Hanging(skeleton, bone, "", 0);
  return Eigen::Matrix3d::Identity();  // trunk, neck, head: as at rest
}

}  // namespace

const std::vector<JointAngle>& JointAngles() {
  static const std::vector<JointAngle> kAngles = [] {
    std::vector<JointAngle> angles;
    for (const Row& row : Rows())
      for (const Reading& reading : row.readings) angles.push_back(reading.angle);
    return angles;
  }();
  return kAngles;
}

bool IsOfLimb(const JointAngle& angle) {
  return angle.name.starts_with("left_") || angle.name.starts_with("right_");
}

JointAngleReader::JointAngleReader(const Skeleton& skeleton) : skeleton_(skeleton) {
  for (const Row& row : Rows()) {
    const bool is_root = row.parent.empty();
    Segment segment{-1, is_root ? 0 : FindBoneOrThrow(skeleton, row.child),
                    Eigen::Matrix3d::Identity(), Standing(skeleton, row.child)};
    if (!is_root) {
      segment.parent_bone = FindBoneOrThrow(skeleton, row.parent);
      segment.parent_in_standing = Standing(skeleton, row.parent);
    }
    segments_.push_back(segment);
  }
}

Eigen::VectorXd JointAngleReader::ReadDeg(const SkeletonPose& pose) const {
  return Read(pose, nullptr);
}

Eigen::VectorXd JointAngleReader::ReadDeg(const SkeletonPose& pose,
                                          const Eigen::VectorXd& previous_deg) const {
  return Read(pose, &previous_deg);
}

Eigen::MatrixXd JointAngleReader::DerivativeDeg(const SkeletonPose& pose) const {
  constexpr double kStep = 1e-5;
  const Eigen::VectorXd here_deg = ReadDeg(pose);
  Eigen::MatrixXd derivative_deg(here_deg.size(), 3 + pose.dofs.size());
  const auto moved_deg = [&](Eigen::Index column, double step) {
    SkeletonPose moved = pose;
    if (column < 3)
      moved.world_from_root =
          Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(column)) * pose.world_from_root;
    else
      moved.dofs[column - 3] += step;
    return ReadDeg(moved, here_deg);
  };
  for (Eigen::Index column = 0; column < derivative_deg.cols(); ++column)
    derivative_deg.col(column) =
        (moved_deg(column, kStep) - moved_deg(column, -kStep)) / (2.0 * kStep);
  return derivative_deg;
}

Eigen::VectorXd JointAngleReader::Read(const SkeletonPose& pose,
                                       const Eigen::VectorXd* previous_deg) const {
  BoneFrames frames;
  ForwardKinematics(skeleton_, pose, &frames);
  const auto world_from_segment = [&](int bone, const Eigen::Matrix3d& in_standing) {
    return bone < 0 ? in_standing : frames.world_from_bone[bone] * in_standing.transpose();
  };
  Eigen::VectorXd angles_deg(static_cast<Eigen::Index>(JointAngles().size()));
  Eigen::Index next = 0;
  for (size_t r = 0; r < segments_.size(); ++r) {
    const Row& row = Rows()[r];
    const Segment& segment = segments_[r];
    Eigen::Vector3d previous = Eigen::Vector3d::Zero();
    for (size_t i = 0; previous_deg && i < row.readings.size(); ++i)
      previous[row.readings[i].axis] =
          kRadFromDeg * row.readings[i].sign * (*previous_deg)[next + static_cast<Eigen::Index>(i)];
    const Eigen::Matrix3d D =
        world_from_segment(segment.parent_bone, segment.parent_in_standing).transpose() *
        world_from_segment(segment.child_bone, segment.child_in_standing);
    const Eigen::Vector3d angles = Decomposed(D, row.sequence, previous);
    for (const Reading& reading : row.readings)
      angles_deg[next++] = kDegFromRad * reading.sign * angles[reading.axis];
  }
  return angles_deg;
}

Eigen::MatrixXd ReadJointAnglesDeg(const Motion& motion) {
  const JointAngleReader reader(motion.skeleton);
  Eigen::MatrixXd angles_deg(static_cast<Eigen::Index>(JointAngles().size()),
                             static_cast<Eigen::Index>(motion.frames.size()));
  for (Eigen::Index f = 0; f < angles_deg.cols(); ++f) {
    const SkeletonPose& pose = motion.frames[static_cast<size_t>(f)];
    angles_deg.col(f) = f == 0 ? reader.ReadDeg(pose) : reader.ReadDeg(pose, angles_deg.col(f - 1));
  }
  return angles_deg;
}

}  // namespace poselift
