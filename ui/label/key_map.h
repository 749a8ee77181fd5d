// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace poselift {

// What a person can do by a key: in the labelling window, and in the camera's.
enum class Action {
  kNextFrame,
  kPreviousFrame,
  kForward10,
  kBack10,
  kForward100,
  kBack100,
  kFirstFrame,
  kLastFrame,
  kNextVideo,
  kPreviousVideo,
  kNextUnlabelled,
  kNextLabelled,
  kPreviousLabelled,
  kSuggested,
  kLastChanged,
  kNextJoint,
  kPreviousJoint,
  kCycleState,
  kRemove,
  kNudgeLeft,
  kNudgeRight,
  kNudgeUp,
  kNudgeDown,
  kStepLeft,
  kStepRight,
  kStepUp,
  kStepDown,
  kCopyPrevious,
  kCopyFollowed,
  kCopy,
  kPaste,
  kFollowAll,
  kFollowForwards,
  kFollowBackwards,
  kPosesBetween,
  kAccept,
  kStop,
  kSwapSides,
  kNextPerson,
  kNewPerson,
  kRemovePerson,
  kNextPose,
  kFlipLimb,
  kKeepPose,
  kTowardsCamera,
  kAwayFromCamera,
  kNearer,
  kOnFloor,
  kForgetHints,
  kPinJoint,
  kAddKeyFrame,
  kRemoveFrame,
  kKeyEarlier,
  kKeyLater,
  kStepBack,
  kStepForward,
  kSmoothMotion,
  kShowMotion,
  kPlay,
  kZoomIn,
  kZoomOut,
  kFit,
  kFullSize,
  kZoomToBox,
  kMirrorView,
  kToggleLoupe,
  kToggleLabels,
  kToggleEdges,
  kToggleSkeleton,
  kToggleTrail,
  kSave,
  kUndo,
  kRedo,
  kHelp,
  kFreeze,
  kRecord,
  kWatchAgain,
  kStillFolder,
};

struct ActionInfo {
  Action action;
  std::string_view name;          // in the keys file: "next_frame"
  const char* description;        // in the list of keys: "Next picture"
  std::string_view default_keys;  // as QKeySequence reads them, apart by spaces
  bool is_live = false;           // of the camera's window, whose keys may be used here, too
};

std::span<const ActionInfo> Actions();
const ActionInfo& InfoOf(Action action);

// Which keys do what: the defaults, changed by a file.
class KeyMap {
 public:
  KeyMap();

  // TOML: `next_frame = ["Right", "D"]`, one or several keys, none to have none. What the file
  // does not name stays, without keys that the file gives to others. Throws InputError with
  // file:line for names of no action and for keys that it gives to two actions.
  static KeyMap Read(const std::filesystem::path& path);

  const std::vector<std::string>& Keys(Action action) const {
    return keys_[static_cast<size_t>(action)];
  }

 private:
  void GiveWay(const ActionInfo& info, const std::vector<const ActionInfo*>& named);

  std::vector<std::vector<std::string>> keys_;
};

}  // namespace poselift
