// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cmath>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "src/io/frame_source.h"
#include "ui/live/live_rates.h"
#include "ui/live/live_recording.h"
#include "ui/live/live_view.h"
#include "ui/live/tag_session.h"

namespace poselift {

// What a LiveSession watches.
struct LiveParts {
  // Gives colours; with tags grey pictures too; of a camera the encoded ones to record them.
  std::unique_ptr<FrameSource> source;
  std::unique_ptr<TagSession> tags;  // null: pictures alone
  Eigen::Vector3d up_in_cam = -Eigen::Vector3d::UnitY();
  double frame_time_s = 1.0 / 30.0;  // of a recording
};

struct LiveStatus {
  enum class State { kOpening, kRunning, kEnded };
  State state = State::kOpening;
  std::string message;       // why it ended
  int64_t num_pictures = 0;  // that were looked at
  int64_t num_lost = 0;      // that the camera, or who looks for tags, had no time for
  int64_t num_not_shown = 0;
  double rate_hz = 0.0;
  double latency_s = std::nan("");  // from the picture being taken to its being ready to be shown
  bool has_tags = false;
  std::filesystem::path recording;  // where to; empty: nothing is recorded
  int64_t num_recorded = 0;         // pictures, of this recording or the last one
  std::string recording_message;    // why it could not begin, or ended before its time
};

// "29.9 pictures a second, 12 lost, 21 ms late, 7 tags"
std::string StatusLine(const LiveStatus& status, const LiveView& view);

// A camera that is watched, or files as if they were one, in a thread of its own: each picture is
// taken, tags are looked for and the person is tracked. Who shows it takes the newest picture when
// there is time; it never waits, nor is waited for.
//
// An error ends it, as does the last picture: with a message, and the recording as it should be.
class LiveSession {
 public:
  // open: called in the thread, for a camera takes its time; what it throws is the message.
  // changed: called in the thread when there is something new; not again before Take.
  LiveSession(std::function<LiveParts()> open, std::function<void()> changed);
  ~LiveSession();  // Stop, and waits for the picture at hand
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  // The newest picture and how it goes.
  struct Latest {
    LiveView view;
    LiveStatus status;
  };
  Latest Take();
  // The newest picture, to keep; nothing before the first.
  std::optional<LiveView> Freeze() const;

  // Takes effect with the next picture; Take tells. dir: see LiveRecording.
  void Record(const std::filesystem::path& dir);
  void StopRecording();
  void Stop();

 private:
  void Run();
  void Watch();
  void Look(VideoFrame frame);
  void Publish(LiveView view, double taken_s);
  void ObeyRecording(const VideoFrame& frame);
  void TryToRecord(const std::function<void()>& write);
  void CloseRecording(const std::string& message);
  void TakeTracked();
  void End(const std::string& message);
  void Tell();

  const std::function<LiveParts()> open_;
  const std::function<void()> changed_;

  // The thread's.
  LiveParts parts_;
  std::deque<VideoFrame> tracked_;  // pictures whose poses wait for what comes
  std::optional<LiveRecording> recording_;
  LiveRates rates_;

  mutable std::mutex mutex_;  // guards what follows
  FrameSource* source_ = nullptr;
  LiveView view_;
  LiveStatus status_;
  std::filesystem::path wanted_recording_;  // empty: none
  bool is_wanted_new_ = false;
  bool is_taken_ = true, is_told_ = false, stop_ = false;

  std::thread thread_;  // the last, for it uses the others
};

}  // namespace poselift
