// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// What the mouse does to the pose in space, and poses without pictures.
#include <fmt/format.h>

#include <algorithm>

#include "src/translated.h"
#include "ui/label/in_words.h"
#include "ui/label/label_edits.h"
#include "ui/label/label_session.h"

namespace poselift {

void LabelSession::Hover(std::optional<size_t> handle) {
  hovered_ = handle;
  if (handle) notice_.clear();
}

bool LabelSession::PressHandle(size_t handle, PoseDrag::Way way) {
  if (!pose() || !HasPerson() || IsBetween()) return false;
  notice_.clear();
  nearer_.reset();
  const PoseHandle& pressed = handles_[handle];
  const bool is_pelvis = pressed.joint == joint::kPelvis;
  const std::vector<LabelHint> hints = Hints();
  if (way == PoseDrag::Way::kByAngles && !is_pelvis && LimbUpTo(pressed.joint).empty()) {
    notice_ =
        Translated("the {} goes with the trunk: drag it without Shift", InWords(pressed.name));
    return false;
  }
  if (is_pelvis && HasLabelsInForce() && std::ranges::none_of(hints, IsFirmPin)) {
    notice_ =
        Translated("the labels say where the pelvis is: pin what is to stay before you drag it");
    return false;
  }
  landmark_ = layout_->Find(pressed.name).value_or(landmark_);
  drag_ = Drag{.is_new = false,
               .pose = std::make_shared<PoseDrag>(
                   PoseDrag::Start{handles_, hints, *pose(), HasLabelsInForce()}, handle, way,
                   lifter_.dictionary().skeleton)};
  return true;
}

void LabelSession::MoveHandle(const Eigen::Vector3d& to_in_cam_m) {
  if (!drag_ || !drag_->pose) return;
  const std::vector<LabelHint> pins = drag_->pose->PinsAt(to_in_cam_m);
  if (pins.empty()) return;
  drag_->edit = GiveHints(labels(), Ref(), pins);
  drag_->edit->name = Translated("pose {}", InWords(drag_->pose->handle().name));
  Ask();
}

void LabelSession::TogglePin(size_t handle) {
  if (!pose() || !HasPerson() || drag_ || IsBetween()) return;
  const PoseHandle& toggled = handles_[handle];
  if (toggled.joint == joint::kPelvis) {
    notice_ = Translated("pins are counted from the pelvis: pin a foot or a hand");
    return;
  }
  std::vector<LabelHint> others = Hints();
  const bool was_pinned = std::erase_if(others, [&](const LabelHint& hint) {
                            return IsFirmPin(hint) && hint.joint == toggled.name;
                          }) > 0;
  const Pose3& joints_m = pose()->joints_in_cam_m;
  LabelEdit edit;
  if (HasLabelsInForce() && was_pinned) {
    const auto hints = Hints();
    const auto pin = std::ranges::find_if(hints, [&](const LabelHint& hint) {
      return IsFirmPin(hint) && hint.joint == toggled.name;
    });
    edit = RemoveHint(labels(), Ref(), static_cast<size_t>(pin - hints.begin()));
  } else {
    // Without labels all else stays as it is now, not as it was at an earlier drag.
    std::vector<LabelHint> pins;
    if (!HasLabelsInForce()) pins = SoftPins(handles_, others, joints_m, pose()->size);
    if (!was_pinned) pins.push_back(FirmPin(toggled, joints_m, pose()->size));
    edit = GiveHints(labels(), Ref(), pins);
  }
  edit.name = was_pinned ? Translated("let go of {}", InWords(toggled.name))
                         : Translated("pin {}", InWords(toggled.name));
  Apply(std::move(edit));
}

std::optional<Eigen::Vector3d> LabelSession::PinnedAt(size_t handle) const {
  const FrameLabels frame = Frame();
  if (!pose() || person_index_ >= frame.people.size()) return std::nullopt;
  for (const LabelHint& hint : frame.people[person_index_].hints)
    if (IsFirmPin(hint) && hint.joint == handles_[handle].name)
      return hint.x_in_cam_m / pose()->size;
  return std::nullopt;
}

std::optional<size_t> LabelSession::HandleAtHand() const {
  if (hovered_) return hovered_;
  const std::string_view name = layout_->landmarks[static_cast<size_t>(landmark_)].name;
  const auto found = std::ranges::find(handles_, name, &PoseHandle::name);
  if (found == handles_.end()) return std::nullopt;
  return static_cast<size_t>(found - handles_.begin());
}

bool LabelSession::DoPose(Action action) {
  switch (action) {
    case Action::kPinJoint:
      if (const auto handle = HandleAtHand())
        TogglePin(*handle);
      else
        notice_ = Translated("this landmark cannot be pinned: choose a joint of the 3D pose");
      return true;
    default:
      return false;
  }
}

std::string LabelSession::HandleStatus(size_t handle) const {
  const PoseHandle& hovered = handles_[handle];
  if (hovered.joint == joint::kPelvis)
    return Translated(
        "drag: the pelvis; legs and pinned joints stay behind, the trunk comes along");
  const std::string name = InWords(hovered.name);
  return PinnedAt(handle)
             ? Translated(
                   "drag: {} (pinned)   with Shift: its limb alone   right button: let it go", name)
             : Translated("drag: {}   with Shift: its limb alone   right button: pin it", name);
}

WeakCamera LabelSession::PictureCamera() const {
  constexpr double kHeight_m = 2.3, kWithoutPicture_px = 1000.0;
  WeakCamera camera = pose() ? pose()->camera : WeakCamera();
  if (!pose() || camera.scale_px_per_m > 0.0 || labels().frames.empty()) return camera;
  const FrameLabels& frame = labels().frames[frame_index_];
  Eigen::Vector2d size_px(frame.width_px, frame.height_px);
  if (!(size_px.minCoeff() > 0.0)) size_px.setConstant(kWithoutPicture_px);
  camera.scale_px_per_m = size_px.minCoeff() / kHeight_m;
  camera.translation_px = size_px / 2.0;
  return camera;
}

}  // namespace poselift
