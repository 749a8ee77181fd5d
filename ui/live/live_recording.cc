// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/live_recording.h"

#include <system_error>

#include "src/capture/live_frame_source.h"
#include "src/input_error.h"

namespace poselift {

namespace fs = std::filesystem;

LiveRecording::LiveRecording(const fs::path& dir, const TagSession* session, double frame_time_s,
                             const FrameSource& source) {
  const auto* const camera = dynamic_cast<const LiveFrameSource*>(&source);
  if (!session && !camera)
    throw InputError(dir.string(),
                     "found no tags to record, wanted a tags file (--tags), or a camera");
  std::error_code error;
  for (const char* name : {"poses.json", "video.mkv"})
    if (fs::exists(dir / name, error))
      throw InputError(dir.string(), "found a recording, wanted a folder without: name another");
  fs::create_directories(dir, error);
  if (error) throw InputError(dir.string(), "cannot be made a folder: " + error.message());
  if (session)
    poses_.emplace(dir, session->skeleton(), frame_time_s,
                   camera ? TrackRecording::kCamera : TrackRecording::kFiles);
  if (camera) video_.emplace(dir / "video.mkv", camera->camera().format(), std::nullopt);
}

void LiveRecording::AddPicture(const VideoFrame& frame) {
  if (video_ && !frame.encoded.empty()) video_->Add(frame);
}

void LiveRecording::AddPose(const TagSession::Tracked& tracked) {
  if (poses_) poses_->Add(tracked.poses, tracked.pose, *tracked.poses.time_s);
}

void LiveRecording::Close() {
  if (poses_) poses_->Close();
  if (video_) video_->Close();
}

}  // namespace poselift
