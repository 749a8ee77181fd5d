// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What a person says that no landmark shows.
#include <algorithm>
#include <array>

#include "lift/body_proportions.h"
#include "lift/depth_mirror.h"
#include "src/translated.h"
#include "ui/label/label_edits.h"
#include "ui/label/label_session.h"

namespace poselift {
namespace {

std::optional<Limb> LimbOf(std::string_view landmark) {
  const auto joint = FindJoint(std::string(landmark));
  if (!joint) return std::nullopt;
  for (const Limb limb : {Limb::kLeftLeg, Limb::kRightLeg, Limb::kLeftArm, Limb::kRightArm})
    if (std::ranges::count(JointsOfLimb(limb), *joint) > 0) return limb;
  return std::nullopt;
}

}  // namespace

bool LabelSession::DoHint(Action action) {
  using Kind = LabelHint::Kind;
  const std::string joint(layout_->landmarks[static_cast<size_t>(landmark_)].name);
  switch (action) {
    case Action::kFlipLimb:
      FlipLimb(joint);
      return true;
    case Action::kKeepPose:
      KeepPose();
      return true;
    case Action::kTowardsCamera:
      Give({{.kind = Kind::kTowardsCamera, .joint = joint}});
      return true;
    case Action::kAwayFromCamera:
      Give({{.kind = Kind::kAwayFromCamera, .joint = joint}});
      return true;
    case Action::kOnFloor:
      Give({{.kind = Kind::kOnFloor, .joint = joint}});
      return true;
    case Action::kNearer:
      nearer_ = landmark_;
      return true;
    case Action::kForgetHints:
      chosen_in_cam_m_.reset();
      if (HasPerson()) Apply(RemoveHints(labels(), Ref()));
      return true;
    default:
      return false;
  }
}

void LabelSession::FlipLimb(const std::string& joint) {
  const auto limb = LimbOf(joint);
  if (!limb || !pose()) {
    notice_ = Translated("to flip a limb, choose a joint of an arm or a leg of a pose");
    return;
  }
  auto hints = HintsToFlip(*limb, pose()->joints_in_cam_m);
  if (hints.empty())
    notice_ = Translated("this limb lies in the picture's plane: there is nothing to flip");
  Give(std::move(hints));
}

// Of what would be chosen without, the best.
void LabelSession::KeepPose() {
  if (!pose() || result_.poses.size() < 2) return;
  const LiftedPose& other = result_.poses[pose_index_ == 0 ? 1 : 0];
  auto hints = HintsToChoose(pose()->joints_in_cam_m, other.joints_in_cam_m);
  if (hints.empty()) notice_ = Translated("the poses differ in no limb that a hint can tell apart");
  Give(std::move(hints));
}

// What pins alone have made grows with the person.
void LabelSession::GiveHeight(double height_m) {
  std::vector<LabelHint> hints = {{.kind = LabelHint::Kind::kHeight, .metres_m = height_m}};
  if (pose() && !HasLabelsInForce()) {
    const double before_m = pose()->size * Stature_m(lifter_.dictionary().skeleton);
    for (LabelHint hint : Hints()) {
      if (hint.kind != LabelHint::Kind::kPin) continue;
      hint.x_in_cam_m *= height_m / before_m;
      hints.push_back(hint);
    }
  }
  Give(std::move(hints));
}

void LabelSession::RemoveHintAt(size_t index) {
  if (index < Hints().size()) Apply(RemoveHint(labels(), Ref(), index));
}

std::vector<LabelHint> LabelSession::Hints() const {
  if (labels().frames.empty() || !HasPerson()) return {};
  return labels().frames[frame_index_].people[person_index_].hints;
}

void LabelSession::Give(const std::vector<LabelHint>& hints) {
  if (hints.empty() || !HasPerson()) return;
  chosen_in_cam_m_.reset();  // the hints say it
  Apply(GiveHints(labels(), Ref(), hints));
}

}  // namespace poselift
