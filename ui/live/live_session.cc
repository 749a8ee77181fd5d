// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/live_session.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <utility>

#include "src/translated.h"

namespace poselift {
namespace {

double Now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::string StatusLine(const LiveStatus& status, const LiveView& view) {
  if (status.state == LiveStatus::State::kOpening) return Translated("opening ...");
  std::string line = Translated("{:.1f} pictures a second, {} lost, {} not shown", status.rate_hz,
                                status.num_lost, status.num_not_shown);
  if (std::isfinite(status.latency_s))
    line += Translated(", {:.0f} ms late", 1e3 * status.latency_s);
  if (status.has_tags)
    line += Translated(", {} tags", view.tags.size()) +
            (view.pose ? std::string() : Translated(", no pose yet"));
  if (!status.recording.empty())
    line += Translated("; {} recorded to {}", status.num_recorded,
                       status.recording.filename().string());
  return line;
}

LiveSession::LiveSession(std::function<LiveParts()> open, std::function<void()> changed)
    : open_(std::move(open)), changed_(std::move(changed)), thread_([this] { Run(); }) {}

LiveSession::~LiveSession() {
  Stop();
  thread_.join();
}

void LiveSession::Stop() {
  const std::scoped_lock lock(mutex_);
  stop_ = true;
  if (source_) source_->Stop();
}

LiveSession::Latest LiveSession::Take() {
  const std::scoped_lock lock(mutex_);
  is_taken_ = true;
  is_told_ = false;
  return {view_, status_};
}

std::optional<LiveView> LiveSession::Freeze() const {
  const std::scoped_lock lock(mutex_);
  if (view_.bgr.empty()) return std::nullopt;
  return view_;
}

void LiveSession::Record(const std::filesystem::path& dir) {
  const std::scoped_lock lock(mutex_);
  wanted_recording_ = dir;
  is_wanted_new_ = true;
  status_.recording_message.clear();
}

void LiveSession::StopRecording() { Record({}); }

void LiveSession::Run() {
  std::string message;
  try {
    Watch();
    message = Translated("there are no more pictures");
  } catch (const std::exception& error) {
    message = error.what();
  }
  End(message);
}

void LiveSession::Watch() {
  parts_ = open_();
  {
    const std::scoped_lock lock(mutex_);
    source_ = parts_.source.get();
    status_.state = LiveStatus::State::kRunning;
    status_.has_tags = parts_.tags != nullptr;
    if (stop_) return;
  }
  while (auto frame = parts_.source->Next()) {
    {
      const std::scoped_lock lock(mutex_);
      if (stop_) return;
    }
    Look(std::move(*frame));
  }
}

void LiveSession::Look(VideoFrame frame) {
  {
    const std::scoped_lock lock(mutex_);
    ++status_.num_pictures;
    status_.num_lost += frame.num_lost;
  }
  ObeyRecording(frame);
  if (!parts_.tags) return Publish({.bgr = frame.bgr}, frame.monotonic_s);
  parts_.tags->Add(frame);
  tracked_.push_back(std::move(frame));
  TakeTracked();
}

void LiveSession::TakeTracked() {
  while (const auto tracked = parts_.tags->Take()) {
    const VideoFrame frame = std::move(tracked_.front());
    tracked_.pop_front();
    if (recording_) TryToRecord([&] { recording_->AddPose(*tracked); });
    Publish({.bgr = frame.bgr,
             .tags = tracked->tags,
             .pose = LivePoseOf(tracked->poses.people.front(), parts_.tags->tags(),
                                parts_.tags->camera(), parts_.up_in_cam)},
            frame.monotonic_s);
  }
}

void LiveSession::Publish(LiveView view, double taken_s) {
  {
    const std::scoped_lock lock(mutex_);
    view.number = view_.number + 1;
    status_.num_not_shown += is_taken_ ? 0 : 1;
    is_taken_ = false;
    view_ = std::move(view);
    rates_.Add(Now_s(), taken_s);
    status_.rate_hz = rates_.Rate_hz();
    status_.latency_s = rates_.Latency_s();
  }
  Tell();
}

// Without the lock: who is told may ask.
void LiveSession::Tell() {
  {
    const std::scoped_lock lock(mutex_);
    if (std::exchange(is_told_, true)) return;
  }
  if (changed_) changed_();
}

// Begins or ends what was asked for, then adds the picture.
void LiveSession::ObeyRecording(const VideoFrame& frame) {
  std::filesystem::path dir;
  bool is_new = false;
  {
    const std::scoped_lock lock(mutex_);
    is_new = std::exchange(is_wanted_new_, false);
    dir = wanted_recording_;
  }
  if (is_new) CloseRecording("");
  if (is_new && !dir.empty()) {
    TryToRecord([&] {
      recording_.emplace(dir, parts_.tags.get(), parts_.frame_time_s, *parts_.source);
      const std::scoped_lock lock(mutex_);
      status_.recording = dir;
      status_.num_recorded = 0;
    });
  }
  if (!recording_) return;
  TryToRecord([&] { recording_->AddPicture(frame); });
  const std::scoped_lock lock(mutex_);
  status_.num_recorded += recording_ ? 1 : 0;
}

// A disk that is full ends the recording, not the view.
void LiveSession::TryToRecord(const std::function<void()>& write) {
  try {
    write();
  } catch (const std::exception& error) {
    CloseRecording(error.what());
  }
}

void LiveSession::CloseRecording(const std::string& message) {
  std::string flaw = message;
  if (recording_) try {
      recording_->Close();
    } catch (const std::exception& error) {
      if (flaw.empty()) flaw = error.what();
    }
  recording_.reset();
  const std::scoped_lock lock(mutex_);
  status_.recording.clear();
  status_.recording_message = flaw;
}

// The poses that wait still are recorded, and shown.
void LiveSession::End(const std::string& message) {
  std::string flaw;
  if (parts_.tags) try {
      parts_.tags->End();
      TakeTracked();
    } catch (const std::exception& error) {
      flaw = std::string("; ") + error.what();
    }
  if (recording_) CloseRecording("");
  {
    const std::scoped_lock lock(mutex_);
    source_ = nullptr;
  }
  parts_.source.reset();  // so that the camera can be opened again
  {
    const std::scoped_lock lock(mutex_);
    if (is_wanted_new_ && !wanted_recording_.empty())
      status_.recording_message = Translated("nothing was recorded: no picture came after");
    status_.state = LiveStatus::State::kEnded;
    status_.message = message + flaw;
    is_told_ = false;
  }
  Tell();
}

}  // namespace poselift
