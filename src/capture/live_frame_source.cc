// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/live_frame_source.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "src/input_error.h"

namespace poselift {
namespace {

// How long Stop() may go unnoticed.
constexpr double kSlice_s = 0.1;

LiveOptions Checked(const std::string& path, const LiveOptions& options) {
  if (const std::string flaw = options.Validate(); !flaw.empty()) throw InputError(path, flaw);
  return options;
}

}  // namespace

std::string LiveOptions::Validate() const {
  if (max_waiting < 1) return fmt::format("max_waiting = {}, wanted at least 1", max_waiting);
  if (!(patience_s > 0.0)) return fmt::format("patience_s = {}, wanted above 0", patience_s);
  return camera.Validate();
}

LiveFrameSource::LiveFrameSource(const std::string& path, const LiveOptions& options,
                                 SystemCalls* system)
    : options_(Checked(path, options)),
      stream_(path, options.camera, system),
      last_good_s_(system->Now_s()),
      thread_(&LiveFrameSource::Run, this) {}

LiveFrameSource::~LiveFrameSource() {
  Stop();
  thread_.join();
}

CaptureCounts LiveFrameSource::counts() const {
  const std::lock_guard lock(mutex_);
  CaptureCounts counts = counts_;
  counts.bad += num_undecodable_;
  return counts;
}

void LiveFrameSource::Run() {
  SystemCalls& system = stream_.device().system();
  std::string error;
  try {
    double last_s = system.Now_s();
    while (!stop_) {
      auto frame = stream_.Read(kSlice_s);
      if (frame) last_s = system.Now_s();
      Add(std::move(frame));
      if (system.Now_s() - last_s > options_.patience_s)
        throw InputError(
            stream_.device().path(),
            fmt::format("gave no picture for {:.3g} s ({} broken ones so far); plug the camera in "
                        "again, into a port of its own",
                        options_.patience_s, stream_.counts().bad));
    }
  } catch (const std::exception& caught) {
    error = caught.what();
  }
  const std::lock_guard lock(mutex_);
  error_ = std::move(error);
  ended_ = true;
  changed_.notify_one();
}

// Whatever came of a Read.
void LiveFrameSource::Add(std::optional<CameraFrame> frame) {
  const std::lock_guard lock(mutex_);
  counts_.lost = stream_.counts().lost;
  counts_.bad = stream_.counts().bad;
  if (!frame) return;
  if (waiting_.size() >= static_cast<size_t>(options_.max_waiting)) {
    ++counts_.dropped;
    CameraFrame& successor = waiting_.size() > 1 ? waiting_[1] : *frame;
    successor.num_lost += waiting_.front().num_lost + 1;
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(*frame));
  changed_.notify_one();
}

std::optional<CameraFrame> LiveFrameSource::Take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ended_ || !waiting_.empty(); });
  if (!waiting_.empty()) {
    CameraFrame taken = std::move(waiting_.front());
    waiting_.pop_front();
    return taken;
  }
  if (!error_.empty()) throw InputError(error_);
  return std::nullopt;
}

double LiveFrameSource::SinceFirst_s(const CameraFrame& taken) {
  if (!first_s_) first_s_ = taken.monotonic_s;
  return taken.monotonic_s - *first_s_;
}

std::string LiveFrameSource::Decode(const CameraFrame& taken, VideoFrame* frame) {
  const RawFormat& format = stream_.format();
  std::string flaw;
  if (options_.pictures != Pictures::kGrey) flaw = decoder_.ToBgr(format, taken.bytes, &frame->bgr);
  if (options_.pictures != Pictures::kBgr && flaw.empty())
    flaw = decoder_.ToGrey(format, taken.bytes, &frame->grey);
  return flaw;
}

void LiveFrameSource::PassOver(const CameraFrame& taken, const std::string& flaw) {
  num_lost_ += taken.num_lost + 1;
  {
    const std::lock_guard lock(mutex_);
    ++num_undecodable_;
  }
  if (taken.monotonic_s - last_good_s_ > options_.patience_s)
    throw InputError(
        stream_.device().path(),
        fmt::format("gave no picture that is whole for {:.3g} s (the last: {}); choose another "
                    "format or size, or another cable or port",
                    options_.patience_s, flaw));
}

std::optional<VideoFrame> LiveFrameSource::Next() {
  while (auto taken = Take()) {
    VideoFrame frame;
    if (const std::string flaw = Decode(*taken, &frame); !flaw.empty()) {
      PassOver(*taken, flaw);
      continue;
    }
    last_good_s_ = taken->monotonic_s;
    frame.index = index_++;
    frame.time_s = SinceFirst_s(*taken);
    frame.num_lost = taken->num_lost + std::exchange(num_lost_, 0);
    frame.monotonic_s = taken->monotonic_s;
    if (options_.keep_encoded) {
      frame.encoded = std::move(taken->bytes);
      frame.fourcc = stream_.format().fourcc;
    }
    const std::lock_guard lock(mutex_);
    ++counts_.given;
    return frame;
  }
  return std::nullopt;
}

std::optional<double> LiveFrameSource::Skip_s() {
  const auto taken = Take();
  if (!taken) return std::nullopt;
  ++index_;
  num_lost_ += taken->num_lost;
  return SinceFirst_s(*taken);
}

}  // namespace poselift
