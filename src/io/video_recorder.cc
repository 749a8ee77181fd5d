// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/video_recorder.h"

extern "C" {
#include <libavformat/avformat.h>
}

#include <cmath>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "src/input_error.h"

namespace poselift {
namespace {

// FFmpeg's error as text; most are a negative errno.
std::string Reason(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  if (av_strerror(error, text, sizeof text) == 0) return text;
  return std::strerror(AVUNERROR(error));
}

}  // namespace

void VideoRecorder::Release::operator()(AVFormatContext* context) const {
  avio_closep(&context->pb);
  avformat_free_context(context);
}

VideoRecorder::VideoRecorder(const std::filesystem::path& path, cv::Size size_px) : path_(path) {
  if (size_px.width <= 0 || size_px.height <= 0)
    throw std::invalid_argument("VideoRecorder: frames without a size");
  AVFormatContext* context = nullptr;
  if (avformat_alloc_output_context2(&context, nullptr, "matroska", nullptr) < 0)
    throw std::runtime_error("VideoRecorder: this FFmpeg writes no Matroska");
  context_.reset(context);
  context->flags |= AVFMT_FLAG_BITEXACT;  // no random numbers in the file

  AVStream* stream = avformat_new_stream(context, nullptr);
  if (stream == nullptr) throw std::bad_alloc();
  stream->codecpar->codec_type = AVMEDIA_TYPE_VIDEO;
  stream->codecpar->codec_id = AV_CODEC_ID_MJPEG;
  stream->codecpar->width = size_px.width;
  stream->codecpar->height = size_px.height;

  // As a URL, for FFmpeg takes "a:b.mkv" for a protocol.
  const std::string url = "file:" + path.string();
  int error = avio_open(&context->pb, url.c_str(), AVIO_FLAG_WRITE);
  if (error >= 0) error = avformat_write_header(context, nullptr);
  if (error < 0) throw InputError(path, "cannot be recorded to: " + Reason(error));
  Flush();
}

VideoRecorder::~VideoRecorder() {
  try {
    Close();
  } catch (const InputError&) {
  }
}

bool VideoRecorder::Add(const JpegFrame& frame) {
  if (!context_) throw std::logic_error("VideoRecorder: a frame behind the end");
  if (!std::isfinite(frame.time_s) || frame.bytes.empty()) return false;
  if (num_frames_ == 0) first_s_ = frame.time_s;
  const int64_t time_ms = std::llround((frame.time_s - first_s_) * 1000.0);
  if (num_frames_ > 0 && time_ms <= last_ms_) return false;

  AVPacket packet{};
  packet.data = const_cast<uint8_t*>(frame.bytes.data());  // only read
  packet.size = static_cast<int>(frame.bytes.size());
  packet.pts = packet.dts = time_ms;
  packet.flags = AV_PKT_FLAG_KEY;
  if (const int error = av_write_frame(context_.get(), &packet); error < 0) GiveUp(error);
  Flush();
  last_ms_ = time_ms;
  ++num_frames_;
  return true;
}

// Without a packet av_write_frame ends the cluster, which only then goes into the file.
void VideoRecorder::Flush() {
  const int error = av_write_frame(context_.get(), nullptr);
  avio_flush(context_->pb);
  if (error < 0) GiveUp(error);
  if (context_->pb->error < 0) GiveUp(context_->pb->error);
  good_bytes_ = avio_tell(context_->pb);
}

void VideoRecorder::GiveUp(int error) {
  context_.reset();
  std::error_code ignored;  // a device cannot be cut
  std::filesystem::resize_file(path_, static_cast<uintmax_t>(good_bytes_), ignored);
  throw InputError(path_, "cannot be written any further: " + Reason(error) + "; it ends after " +
                              std::to_string(num_frames_) + " frames");
}

void VideoRecorder::Close() {
  if (!context_) return;
  int error = av_write_trailer(context_.get());
  avio_flush(context_->pb);
  if (error >= 0) error = context_->pb->error;
  if (error < 0) GiveUp(error);
  context_.reset();
}

}  // namespace poselift
