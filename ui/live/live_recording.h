// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <filesystem>
#include <optional>

#include "src/io/frame_source.h"
#include "ui/live/tag_session.h"
#include "ui/live/track_recording.h"
#include "ui/live/track_video.h"

namespace poselift {

// What is recorded while a camera is watched: of a person who wears tags the poses
// (TrackRecording), of a camera its raw video, video.mkv (TrackVideo).
class LiveRecording {
 public:
  // session: null without tags. source: a camera, or of files, which have their video already.
  // Throws InputError for a folder that has a recording, for files without tags, of which there
  // is nothing to record, and when a file cannot be written.
  LiveRecording(const std::filesystem::path& dir, const TagSession* session, double frame_time_s,
                const FrameSource& source);

  // Both throw InputError when a file cannot be written further.
  void AddPicture(const VideoFrame& frame);
  void AddPose(const TagSession::Tracked& tracked);
  void Close();

 private:
  std::optional<TrackRecording> poses_;
  std::optional<TrackVideo> video_;
};

}  // namespace poselift
