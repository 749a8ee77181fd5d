// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/label/key_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "src/input_error.h"
#include "src/io/toml_file.h"
#include "src/nearest_names.h"
#include "src/translated.h"

namespace poselift {
namespace {

constexpr std::array kActions = {
    ActionInfo{Action::kNextFrame, "next_frame", ToTranslate("Next picture"), "Right D"},
    ActionInfo{Action::kPreviousFrame, "previous_frame", ToTranslate("Previous picture"), "Left A"},
    ActionInfo{Action::kForward10, "forward_10", ToTranslate("10 pictures forward"), "Shift+Right"},
    ActionInfo{Action::kBack10, "back_10", ToTranslate("10 pictures back"), "Shift+Left"},
    ActionInfo{Action::kForward100, "forward_100", ToTranslate("100 pictures forward"),
               "Ctrl+Right"},
    ActionInfo{Action::kBack100, "back_100", ToTranslate("100 pictures back"), "Ctrl+Left"},
    ActionInfo{Action::kFirstFrame, "first_frame", ToTranslate("First picture"), "Home"},
    ActionInfo{Action::kLastFrame, "last_frame", ToTranslate("Last picture"), "End"},
    ActionInfo{Action::kNextVideo, "next_video", ToTranslate("Next video"), "PgDown"},
    ActionInfo{Action::kPreviousVideo, "previous_video", ToTranslate("Previous video"), "PgUp"},
    ActionInfo{Action::kNextUnlabelled, "next_unlabelled",
               ToTranslate("Next picture without labels"), "N"},
    ActionInfo{Action::kNextLabelled, "next_labelled", ToTranslate("Next picture with labels"),
               "]"},
    ActionInfo{Action::kPreviousLabelled, "previous_labelled",
               ToTranslate("Previous picture with labels"), "["},
    ActionInfo{Action::kSuggested, "suggested", ToTranslate("Picture where labels would tell most"),
               "Shift+N"},
    ActionInfo{Action::kLastChanged, "last_changed", ToTranslate("Picture that was changed last"),
               "U"},
    ActionInfo{Action::kNextJoint, "next_joint", ToTranslate("Next joint"), "Down Tab"},
    ActionInfo{Action::kPreviousJoint, "previous_joint", ToTranslate("Previous joint"),
               "Up Shift+Tab"},
    ActionInfo{Action::kCycleState, "cycle_state", ToTranslate("Visible, occluded, absent"), "O"},
    ActionInfo{Action::kRemove, "remove", ToTranslate("Remove the joint's label"),
               "Delete Backspace"},
    ActionInfo{Action::kNudgeLeft, "nudge_left", ToTranslate("Joint left by 0.1 px"), "Alt+Left"},
    ActionInfo{Action::kNudgeRight, "nudge_right", ToTranslate("Joint right by 0.1 px"),
               "Alt+Right"},
    ActionInfo{Action::kNudgeUp, "nudge_up", ToTranslate("Joint up by 0.1 px"), "Alt+Up"},
    ActionInfo{Action::kNudgeDown, "nudge_down", ToTranslate("Joint down by 0.1 px"), "Alt+Down"},
    ActionInfo{Action::kStepLeft, "step_left", ToTranslate("Joint left by 1 px"), "Alt+Shift+Left"},
    ActionInfo{Action::kStepRight, "step_right", ToTranslate("Joint right by 1 px"),
               "Alt+Shift+Right"},
    ActionInfo{Action::kStepUp, "step_up", ToTranslate("Joint up by 1 px"), "Alt+Shift+Up"},
    ActionInfo{Action::kStepDown, "step_down", ToTranslate("Joint down by 1 px"), "Alt+Shift+Down"},
    ActionInfo{Action::kCopyPrevious, "copy_previous", ToTranslate("Labels of the picture before"),
               "C"},
    ActionInfo{Action::kCopyFollowed, "copy_followed",
               ToTranslate("Labels of the picture before, moved with the picture"), "Shift+C"},
    ActionInfo{Action::kCopy, "copy", ToTranslate("Copy the person's labels"), "Ctrl+C"},
    ActionInfo{Action::kPaste, "paste", ToTranslate("Put in the labels that were copied"),
               "Ctrl+V"},
    ActionInfo{Action::kFollowAll, "follow_all",
               ToTranslate("Follow the labels through all of the video"), "Ctrl+P"},
    ActionInfo{Action::kFollowForwards, "follow_forwards",
               ToTranslate("Follow the labels from here to the next key picture"), "."},
    ActionInfo{Action::kFollowBackwards, "follow_backwards",
               ToTranslate("Follow the labels from here back to the key picture before"), ","},
    ActionInfo{Action::kPosesBetween, "poses_between",
               ToTranslate("Labels between two key pictures, by the poses' joint angles"), "I"},
    ActionInfo{Action::kAccept, "accept", ToTranslate("These labels are right: a key picture"),
               "Y"},
    ActionInfo{Action::kStop, "stop", ToTranslate("Stop what is at work"), "Esc"},
    ActionInfo{Action::kSwapSides, "swap_sides", ToTranslate("Swap left and right"), "X"},
    ActionInfo{Action::kNextPerson, "next_person", ToTranslate("Next person"), "G"},
    ActionInfo{Action::kNewPerson, "new_person", ToTranslate("A further person"), "Insert"},
    ActionInfo{Action::kRemovePerson, "remove_person", ToTranslate("Remove the person"),
               "Shift+Delete"},
    ActionInfo{Action::kNextPose, "next_pose", ToTranslate("Next 3D pose that fits"), "P"},
    ActionInfo{Action::kFlipLimb, "flip_limb", ToTranslate("Flip the limb's depth"), "B"},
    ActionInfo{Action::kKeepPose, "keep_pose", ToTranslate("Keep this one of the 3D poses"),
               "Return"},
    ActionInfo{Action::kTowardsCamera, "towards_camera",
               ToTranslate("The bone to this joint comes nearer"), "T"},
    ActionInfo{Action::kAwayFromCamera, "away_from_camera",
               ToTranslate("The bone to this joint goes away"), "Shift+T"},
    ActionInfo{Action::kNearer, "nearer",
               ToTranslate("This joint is nearer than the one that is clicked next"), "V"},
    ActionInfo{Action::kOnFloor, "on_floor", ToTranslate("This joint is on the floor"), "Shift+F"},
    ActionInfo{Action::kForgetHints, "forget_hints", ToTranslate("Forget the person's hints"),
               "Shift+B"},
    ActionInfo{Action::kPinJoint, "pin_joint",
               ToTranslate("Pin the joint where it is, or let it go"), "J"},
    ActionInfo{Action::kAddKeyFrame, "add_key_frame",
               ToTranslate("Add a key frame: this pose once more"), "Shift+Insert"},
    ActionInfo{Action::kRemoveFrame, "remove_frame", ToTranslate("Remove this key frame"),
               "Ctrl+Delete"},
    ActionInfo{Action::kKeyEarlier, "key_earlier", ToTranslate("This key frame a frame earlier"),
               "Ctrl+Shift+Left"},
    ActionInfo{Action::kKeyLater, "key_later", ToTranslate("This key frame a frame later"),
               "Ctrl+Shift+Right"},
    ActionInfo{Action::kStepBack, "step_back", ToTranslate("A frame of the motion back"), "Ctrl+,"},
    ActionInfo{Action::kStepForward, "step_forward", ToTranslate("A frame of the motion forward"),
               "Ctrl+."},
    ActionInfo{Action::kSmoothMotion, "smooth_motion",
               ToTranslate("Smooth the motion of the person"), "M"},
    ActionInfo{Action::kShowMotion, "show_motion",
               ToTranslate("Show the motion, or each picture by itself"), "Shift+K"},
    ActionInfo{Action::kPlay, "play", ToTranslate("Play or pause"), "K"},
    ActionInfo{Action::kZoomIn, "zoom_in", ToTranslate("Zoom in"), "+ ="},
    ActionInfo{Action::kZoomOut, "zoom_out", ToTranslate("Zoom out"), "-"},
    ActionInfo{Action::kFit, "fit", ToTranslate("The whole picture"), "F"},
    ActionInfo{Action::kFullSize, "full_size", ToTranslate("100 %"), "Ctrl+0"},
    ActionInfo{Action::kZoomToBox, "zoom_to_box", ToTranslate("Zoom to a box that is drawn next"),
               "Z"},
    ActionInfo{Action::kMirrorView, "mirror_view", ToTranslate("Mirror what is shown"), "Shift+M"},
    ActionInfo{Action::kToggleLoupe, "toggle_loupe", ToTranslate("Show or hide the loupe"), "Q"},
    ActionInfo{Action::kToggleLabels, "toggle_labels", ToTranslate("Show or hide labels"), "L"},
    ActionInfo{Action::kToggleEdges, "toggle_edges",
               ToTranslate("Show or hide lines between labels"), "E"},
    ActionInfo{Action::kToggleSkeleton, "toggle_skeleton",
               ToTranslate("Show or hide the 3D pose's skeleton"), "H"},
    ActionInfo{Action::kToggleTrail, "toggle_trail",
               ToTranslate("Show or hide the joint's way through the video"), "W"},
    ActionInfo{Action::kSave, "save", ToTranslate("Save"), "Ctrl+S"},
    ActionInfo{Action::kUndo, "undo", ToTranslate("Undo"), "Ctrl+Z"},
    ActionInfo{Action::kRedo, "redo", ToTranslate("Redo"), "Ctrl+Shift+Z Ctrl+Y"},
    ActionInfo{Action::kHelp, "help", ToTranslate("All keys"), "F1 ?"},
    ActionInfo{Action::kFreeze, "freeze", ToTranslate("Keep this picture and label it"), "F", true},
    ActionInfo{Action::kRecord, "record", ToTranslate("Record into a new folder, or stop"), "R",
               true},
    ActionInfo{Action::kWatchAgain, "watch_again",
               ToTranslate("Open the camera, or begin the video, again"), "A", true},
    ActionInfo{Action::kStillFolder, "still_folder",
               ToTranslate("Where stills, labels and recordings go"), "O", true},
};

std::vector<std::string> KeysOf(const toml::node& node, const std::filesystem::path& path) {
  std::vector<std::string> keys;
  const auto add = [&](const toml::node& key) {
    const auto text = key.value<std::string>();
    if (!text)
      throw InputError(path, static_cast<int>(key.source().begin.line),
                       "found no text, wanted a key, \"Ctrl+S\", or a list of them");
    keys.push_back(*text);
  };
  if (const toml::array* list = node.as_array())
    for (const toml::node& key : *list) add(key);
  else
    add(node);
  return keys;
}

std::vector<std::string> NearestActions(std::string_view name) {
  std::vector<std::string> names;
  for (const ActionInfo& info : kActions) names.emplace_back(info.name);
  return NearestNames(name, std::move(names), 4);
}

}  // namespace

std::span<const ActionInfo> Actions() { return kActions; }

const ActionInfo& InfoOf(Action action) { return kActions[static_cast<size_t>(action)]; }

KeyMap::KeyMap() {
  for (const ActionInfo& info : kActions) {
    std::istringstream keys{std::string(info.default_keys)};
    std::vector<std::string>& list = keys_.emplace_back();
    for (std::string key; keys >> key;) list.push_back(key);
  }
}

// A default key that the file gives to another action is that one's.
void KeyMap::GiveWay(const ActionInfo& info, const std::vector<const ActionInfo*>& named) {
  std::erase_if(keys_[static_cast<size_t>(info.action)], [&](const std::string& key) {
    return std::ranges::any_of(named, [&](const ActionInfo* other) {
      return other->is_live == info.is_live && std::ranges::count(Keys(other->action), key) > 0;
    });
  });
}

KeyMap KeyMap::Read(const std::filesystem::path& path) {
  const toml::table table = ReadToml(path, "a file of keys: save = \"Ctrl+S\"");
  KeyMap map;
  std::vector<const ActionInfo*> named;
  for (const auto& [name, node] : table) {
    const auto info = std::ranges::find(kActions, name.str(), &ActionInfo::name);
    if (info == kActions.end())
      throw InputError(path, static_cast<int>(name.source().begin.line),
                       fmt::format("found '{}', wanted the name of an action, perhaps one of {}",
                                   name.str(), fmt::join(NearestActions(name.str()), ", ")));
    map.keys_[static_cast<size_t>(info->action)] = KeysOf(node, path);
    named.push_back(&*info);
  }
  for (const ActionInfo& info : kActions)
    if (std::ranges::find(named, &info) == named.end()) map.GiveWay(info, named);
  std::map<std::pair<std::string, bool>, std::string_view> owners;
  for (const ActionInfo& info : kActions)
    for (const std::string& key : map.Keys(info.action)) {
      const auto [owner, is_new] = owners.emplace(std::pair(key, info.is_live), info.name);
      if (!is_new)
        throw InputError(path, fmt::format("found '{}' for {} and {}, wanted one action for a key",
                                           key, owner->second, info.name));
    }
  return map;
}

}  // namespace poselift
