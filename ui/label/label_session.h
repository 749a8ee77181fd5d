// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lift/lift_photo.h"
#include "src/labels.h"
#include "src/layout.h"
#include "ui/label/background_job.h"
#include "ui/label/key_edits.h"
#include "ui/label/key_map.h"
#include "ui/label/key_repeat.h"
#include "ui/label/label_edits.h"
#include "ui/label/label_flow.h"
#include "ui/label/label_project.h"
#include "ui/label/person_motion.h"
#include "ui/label/picture_hit.h"
#include "ui/label/playback.h"
#include "ui/label/pose_drag.h"
#include "ui/label/pose_handles.h"
#include "ui/label/pose_solver.h"
#include "ui/label/trail.h"

namespace poselift {

// A person at work on a project: which frame, person and landmark is at hand, what the mouse and
// the keys do to the labels, and the 3D poses that answer. A window only paints it and forwards
// events. After each change of the labels of a frame its person is lifted anew, in the background.
// While something is dragged that goes on from the pose shown, which is quick (LiftPhotoFrom), and
// answers are shown although the mouse is farther by then; what is let go is lifted from all views.
class LabelSession {
 public:
  // answered: called in another thread when an answer waits to be taken. project and lifter must
  // outlive this.
  LabelSession(LabelProject* project, const PhotoLifter& lifter, std::function<void()> answered);

  const Labels& labels() const { return project_->labels(); }
  const Layout& layout() const { return *layout_; }
  size_t frame_index() const { return frame_index_; }
  size_t person_index() const { return person_index_; }
  int landmark() const { return landmark_; }  // of the layout: the one that a click places
  // How much is labelled: of the person at hand, and frames in which somebody placed labels.
  size_t NumLabels() const;
  size_t NumLabelledFrames() const;
  // The frame at hand, with what the mouse drags where it is now.
  FrameLabels Frame() const;
  // Null when the person has no label of it.
  static const LandmarkLabel* Find(const PersonLabels& person, std::string_view landmark);

  // The mouse in the picture. A landmark that is pressed and moved is dragged; a click places the
  // landmark at hand, where it has no label yet or nothing is near, and goes on to the next one
  // without a label.
  void Press(const Eigen::Vector2d& x_px, double reach_px);
  void PressPerson(const Eigen::Vector2d& x_px);  // drags all of the person at hand
  void Move(const Eigen::Vector2d& x_px);
  void Release();
  bool CycleStateAt(const Eigen::Vector2d& x_px, double reach_px);

  // The mouse on the pose in space: a handle that is pressed and moved is dragged (PoseDrag), as
  // one step; the pose answers on the way. Release() ends it.
  const std::vector<PoseHandle>& handles() const { return handles_; }
  void Hover(std::optional<size_t> handle);
  std::optional<size_t> hovered() const { return hovered_; }
  // False, and said in Status(), where there is nothing to drag.
  bool PressHandle(size_t handle, PoseDrag::Way way);
  void MoveHandle(const Eigen::Vector3d& to_in_cam_m);
  // Pins the joint where it is, or lets it go.
  void TogglePin(size_t handle);
  // Where a person wants a joint, metres of the skeleton; nothing for one that is not pinned.
  std::optional<Eigen::Vector3d> PinnedAt(size_t handle) const;
  // How the picture shows the pose: as the labels say, else the whole of it in the middle.
  WeakCamera PictureCamera() const;

  // Hints of the person at hand (src/labels.h).
  std::vector<LabelHint> Hints() const;
  void GiveHeight(double height_m);
  void RemoveHintAt(size_t index);

  void GoToFrame(size_t index);
  void GoToPerson(size_t index);            // one behind the last is a new one
  void GoToLandmark(int landmark);          // the nearest there is
  void TypeDigit(int digit, double now_s);  // to the landmark of that number, counted from 1
  // What a key does; false for what belongs to the view alone.
  bool Do(Action action);
  // The whole person at hand, about its middle; what is done in a row is one step.
  void TurnPersonBy(double angle_rad);  // clockwise
  void ScalePersonBy(double factor);

  // Key frames, poses without pictures (lift/key_frames.h): the motion through them is made anew
  // after each change, and between them, at a number of its frames, there is that to be seen.
  bool HasKeyFrames() const { return AreKeyFrames(labels()); }
  KeyTimes Keys() const;
  int Number() const;  // that is shown
  bool IsBetween() const { return between_.has_value(); }
  void GoToNumber(int number);  // the key frame there, or the last one before is at hand
  void MoveKey(size_t key, int number, Along along);
  void ChangeRate(double fps);
  // Frames of the motion: those of the labels, or of key frames all from the first to the last.
  size_t NumMotionFrames() const;
  size_t MotionFrame() const;  // that is shown
  void GoToMotionFrame(size_t frame);
  Playback PlaybackFrom(size_t motion_frame) const;

  // While labels are followed through a video: how far that is.
  std::optional<double> FollowProgress() const;
  // What goes on in the background that Action::kStop ends, in words; empty when nothing does.
  std::string Working() const;
  // Ends when they have been followed; for programs without events.
  void WaitUntilFollowed();

  // Takes the newest answer, if one has come; true when what is shown changed.
  bool TakeAnswer();
  // Of the person at hand, the chosen pose; null while there is none.
  const LiftedPose* pose() const;
  const LiftResult& result() const { return result_; }
  const Observation& observation() const;  // that the shown pose explains
  size_t pose_index() const { return pose_index_; }
  bool is_solving() const { return asked_ != answered_; }
  void WaitUntilSolved();

  // The frames of the person at hand as one motion, asked for by Action::kSmoothMotion and there
  // when TakeAnswer says so. Null before the first; its message says why when there is none.
  const PersonMotion* motion() const { return motion_.get(); }
  bool IsMotionCurrent() const;  // the person's labels are those that it was made of
  // Of the frame at hand; null where the motion has none, or was made of other labels of it.
  const LiftedPose* MotionPose() const;
  bool shows_motion = true;  // instead of frames by themselves
  bool ShowsMotion() const;  // here and now
  const LiftedPose* ShownPose() const;
  // While it is made: how far that is. A new one ends the one before.
  std::optional<double> MotionProgress() const;
  void StopMotion() { motion_job_.Stop(); }
  void WaitUntilSmoothed();
  // To a frame that is not stayed at: not lifted by itself where the motion is shown.
  void PlayTo(size_t motion_frame);

  // Both in the background, of the labels as they are now. Throws InputError while another export
  // goes on. Lifts all frames, as a motion where they are one (WhyFramesAlone), and leaves in a
  // folder what `lift` does, but pictures.
  void Export(const std::filesystem::path& folder);
  // One file of the motion, by its ending (LiftedFormats). Throws InputError also when there is no
  // motion, or none of these labels.
  void ExportMotion(const std::filesystem::path& path);
  // Where the files are, once, when they have been written. Throws InputError when they cannot be.
  std::optional<std::filesystem::path> TakeExported();
  void WaitUntilExported() { export_job_.WaitUntilIdle(); }

  // Of the landmark at hand.
  std::vector<TrailPoint> Trail() const;
  // How far the shown pose is from a landmark's label; nothing without one of them.
  std::optional<double> Residual_px(std::string_view landmark) const;
  std::optional<double> ResidualInSigmas(std::string_view landmark) const;
  std::filesystem::path PicturePath() const;  // of the frame at hand; empty without one
  // Points to pictures that moved there; returns how many. Throws InputError as LabelProject.
  size_t Relink(const std::filesystem::path& folder) { return project_->Relink(folder); }

  std::string Title() const;   // of the window: file, picture, whether all is saved
  std::string Status() const;  // a line for who works: what a click does, what went wrong
  const LabelProject& project() const { return *project_; }

 private:
  PersonRef Ref() const;  // the person at hand; a new id for one that is not there yet
  void Apply(LabelEdit edit);
  void Ask();
  void ShowWhatWasChosen();
  void Advance();
  bool HasPerson() const { return person_index_ < labels().frames[frame_index_].people.size(); }
  bool HasLabelAtHand() const;
  bool DoGo(Action action);
  bool DoOnLandmark(Action action);
  bool DoOnPerson(Action action);
  bool DoOnProject(Action action);
  bool DoHint(Action action);
  bool DoFlow(Action action);
  void Follow(BackgroundJob<GuessedLabels>::Work work);
  void Follow(Reach reach);
  bool TakeFollowed();
  void Stop();
  void StartExport(BackgroundJob<std::filesystem::path>::Work work);
  bool DoPose(Action action);
  bool DoKeys(Action action);
  void AddKey();
  void CheckIsKey() const;
  std::vector<PersonLabels> PeopleHere() const;
  std::string KeyStatus() const;
  void LabelsChanged();
  bool HasLabelsInForce() const { return observation_.Count(ObservedPoint::Kind::k2D) > 0; }
  std::optional<size_t> HandleAtHand() const;
  std::string HandleStatus(size_t handle) const;
  bool DoMotion(Action action);
  int PersonOfMotion() const;
  bool TakeMotion();
  const std::vector<std::uint64_t>& MarksOfMotion() const;
  void FlipLimb(const std::string& joint);
  void KeepPose();
  void Give(const std::vector<LabelHint>& hints);
  size_t NextWhere(bool is_labelled, int step) const;
  std::optional<size_t> GoalOf(Action action) const;

  LabelProject* project_;
  const PhotoLifter& lifter_;
  const Layout* layout_;
  size_t frame_index_ = 0, person_index_ = 0;
  int landmark_ = 0;
  TypedNumber typed_;
  std::optional<int> nearer_;  // the next landmark that is clicked is farther than this one
  std::string notice_;         // of what was done last, when nothing came of it
  struct Drag {
    Eigen::Vector2d pressed_px;
    double shake_px = 0.0;  // a mouse moves so far in a click
    size_t person_before = 0;
    int landmark_before = 0;                            // what was at hand
    bool is_new = true;                                 // not dragged but placed
    bool is_person = false;                             // all of them
    std::shared_ptr<PoseDrag> pose = {};                // in space
    Eigen::Vector2d grab_px = Eigen::Vector2d::Zero();  // from the mouse to the landmark
    std::optional<LabelEdit> edit = {};                 // what it comes to if it ends here
  };
  std::optional<Drag> drag_;
  std::vector<PoseHandle> handles_;
  std::optional<size_t> hovered_;

  std::shared_ptr<const PersonMotion> motion_;
  std::uint64_t num_motions_ = 0;
  mutable std::vector<std::uint64_t> marks_;  // LabelMarks of the labels' state and the motion
  mutable std::pair<std::uint64_t, std::uint64_t> marks_of_;
  bool is_playing_ = false;
  double key_fps_ = KeyTimes::kFps;
  std::optional<int> between_;  // the number of a frame that is no key frame, or is played

  std::mutex mutex_;
  std::optional<PoseSolver::Answer> waiting_;  // guarded by mutex_
  std::function<void()> wake_;                 // the window, from another thread
  std::optional<PersonLabels> clipboard_;
  uint64_t asked_ = 0, answered_ = 0;
  uint64_t first_wanted_ = 0;  // answers from this request on are shown: all those of a drag
  size_t asked_person_ = 0;
  Observation asked_observation_, observation_;
  LiftResult result_;
  size_t pose_index_ = 0;
  // What was chosen, or dragged in space: of the poses of the labels that come then, the nearest is
  // shown. Nothing where the best is.
  std::optional<Pose3> chosen_in_cam_m_;
  // The last members: their threads use the others.
  PoseSolver solver_;
  BackgroundJob<GuessedLabels> follow_job_;
  BackgroundJob<PersonMotion> motion_job_;
  BackgroundJob<std::filesystem::path> export_job_;
};

}  // namespace poselift
