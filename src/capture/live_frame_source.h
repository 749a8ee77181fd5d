// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "src/capture/camera_stream.h"
#include "src/capture/frame_decoder.h"
#include "src/io/frame_source.h"

namespace poselift {

struct LiveOptions {
  CameraOptions camera;
  Pictures pictures = Pictures::kBgr;
  bool keep_encoded = false;
  int max_waiting = 2;      // frames that may wait for Next(); more delay, fewer dropped
  double patience_s = 5.0;  // without a good frame, until it throws

  std::string Validate() const;
};

// A camera as a source of frames. A thread of its own takes the frames from the driver as they
// come, whatever the reader does; of those that wait the oldest are dropped, and counted.
//
// time_s counts from the first frame. Frames that cannot be decoded are passed over and
// counted. Next() gives the frames that were taken before an error (see CameraStream), then
// throws it as InputError; so it does when no good frame comes for patience_s.
// Next and Skip_s are called by one thread; Stop and counts by any.
class LiveFrameSource : public FrameSource {
 public:
  LiveFrameSource(const std::string& path, const LiveOptions& options,
                  SystemCalls* system = RealSystem());
  ~LiveFrameSource() override;

  cv::Size size_px() const override { return stream_.given().size_px; }
  std::optional<VideoFrame> Next() override;
  std::optional<double> Skip_s() override;

  // Ends the source: the frames that wait are given still, then nothing. May be called in a
  // handler of signals.
  void Stop() override { stop_ = true; }
  CaptureCounts counts() const;
  // What it was opened with: not to be read from.
  const CameraStream& camera() const { return stream_; }

 private:
  void Run();
  void Add(std::optional<CameraFrame> frame);
  std::optional<CameraFrame> Take();
  std::string Decode(const CameraFrame& taken, VideoFrame* frame);
  void PassOver(const CameraFrame& taken, const std::string& flaw);
  double SinceFirst_s(const CameraFrame& taken);

  const LiveOptions options_;
  CameraStream stream_;  // the thread's, but for what does not change

  // The reader's.
  FrameDecoder decoder_;
  int index_ = 0;
  int num_lost_ = 0;  // passed over since the last frame given
  std::optional<double> first_s_;
  double last_good_s_ = 0.0;

  std::atomic<bool> stop_ = false;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<CameraFrame> waiting_;
  CaptureCounts counts_;
  int64_t num_undecodable_ = 0;
  bool ended_ = false;
  std::string error_;

  std::thread thread_;  // the last, for it uses the others
};

}  // namespace poselift
