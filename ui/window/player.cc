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
  if (session_->labels().frames.size() < 2) return;
  shown_ = session_->MotionFrame();
  const bool is_at_end = shown_ + 1 == session_->NumMotionFrames();
  playback_ = session_->PlaybackFrom(is_at_end ? 0 : shown_);
  clock_.start();
  timer_.start();
}

void Player::Tick() {
  if (!playback_) return;
  if (session_->MotionFrame() != shown_) return Stop();
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
