// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/window/player.h"

#include <utility>

namespace poselift {
namespace {

constexpr int kTick_ms = 4;

}  // namespace

Player::Player(LabelSession* session, std::function<bool()> is_late, QObject* parent)
    : QObject(parent), session_(session), is_late_(std::move(is_late)) {
  timer_.setTimerType(Qt::PreciseTimer);
  timer_.setInterval(kTick_ms);
  connect(&timer_, &QTimer::timeout, this, &Player::Tick);
}

void Player::Toggle() {
  if (is_playing()) return Stop();
  const size_t num_frames = session_->labels().frames.size();
  if (num_frames < 2) return;
  const bool is_at_end = session_->frame_index() + 1 == num_frames;
  playback_.emplace(session_->labels(), is_at_end ? 0 : session_->frame_index());
  shown_ = session_->frame_index();
  clock_.start();
  timer_.start();
}

void Player::Tick() {
  if (!playback_) return;
  if (session_->frame_index() != shown_) return Stop();
  if (is_late_()) return;
  const double elapsed_s = static_cast<double>(clock_.nsecsElapsed()) * 1e-9;
  const size_t frame = playback_->FrameAt(elapsed_s);
  if (frame != shown_) {
    shown_ = frame;
    emit FrameDue(static_cast<int>(frame));
  }
  if (playback_ && playback_->IsOver(elapsed_s)) Stop();
}

void Player::Stop() {
  timer_.stop();
  playback_.reset();
  emit Stopped();
}

}  // namespace poselift
