// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/smooth_stream.h"

#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

#include "lift/person_ik.h"
#include "lift/pose_to_person.h"
#include "lift/poses_to_motion.h"
#include "src/input_error.h"
#include "src/io/poses_json.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

class Stream {
 public:
  Stream(const std::string& name, const Skeleton& skeleton,
         std::shared_ptr<const MotionCodebook> codebook, const StreamOptions& options,
         std::ostream& out)
      : name_(name),
        skeleton_(skeleton),
        options_(options),
        ik_(skeleton),
        smoother_(std::move(codebook), options.online),
        person_id_(options.person_id),
        out_(out) {}

  void Add(const std::string& text, int line) {
    Waiting frame;
    FramePoses poses = ReadFramePosesLine(text, name_, line);
    if (!options_.frame_time_s && !poses.time_s)
      throw InputError(name_, line,
                       "found a frame without time_s, wanted its time, or the rate (--fps)");
    frame.time_s = options_.frame_time_s ? static_cast<double>(num_read_) * *options_.frame_time_s
                                         : *poses.time_s;
    frame.image = std::move(poses.image);
    ++num_read_;
    const PersonPose* person = Find(poses);
    SkeletonPose pose = UnknownPose(skeleton_);
    if (person) {
      // For good: what is measured from must not move.
      if (!camera_.centre_px.allFinite()) camera_ = FindCamera({person});
      pose = ik_.Solve(*person, camera_);
      if (std::isfinite(person->scale_px_per_m)) scale_px_per_m_ = person->scale_px_per_m;
    }
    frame.scale_px_per_m = scale_px_per_m_;
    waiting_.push_back(std::move(frame));
    try {
      smoother_.Add(waiting_.back().time_s, pose);
    } catch (const InputError& error) {
      throw InputError(name_, line, error.what());
    }
    WriteReady();
  }

  StreamReport End() {
    smoother_.End();
    WriteReady();
    return report_;
  }

 private:
  struct Waiting {
    double time_s = 0.0;
    std::string image;
    double scale_px_per_m = kUnknown;
  };

  const PersonPose* Find(const FramePoses& poses) {
    for (const PersonPose& person : poses.people) {
      if (person.status != "ok") continue;
      if (!person_id_) person_id_ = person.id;
      if (person.id == *person_id_) return &person;
    }
    return nullptr;
  }

  void WriteReady() {
    while (const auto frame = smoother_.Take()) {
      Write(*frame, waiting_.front());
      waiting_.pop_front();
    }
    out_.flush();
    if (!out_) throw InputError("the smoothed poses cannot be written: is the disk full?");
  }

  void Write(const SmoothedFrame& frame, const Waiting& source) {
    using Kind = SmoothedFrame::Kind;
    ++report_.num_frames;
    if (frame.kind == Kind::kFilled) ++report_.num_filled;
    if (frame.kind == Kind::kNotKnown) ++report_.num_unknown;
    const std::string_view status = frame.kind == Kind::kMeasured ? "ok"
                                    : frame.kind == Kind::kFilled ? kFilledStatus
                                                                  : kUnknownStatus;
    if (!to_person_) to_person_.emplace(skeleton_, camera_);
    PersonPose person = frame.kind == Kind::kNotKnown
                            ? PersonPose{}
                            : to_person_->Convert(frame.pose, source.scale_px_per_m);
    person.id = person_id_.value_or(0);
    person.status = status;
    if (frame.kind == Kind::kNotKnown) person.message = kUnknownMessage;
    out_ << FramePosesLine({source.image, source.time_s, {std::move(person)}});
  }

  const std::string& name_;
  const Skeleton& skeleton_;
  const StreamOptions& options_;
  PersonIk ik_;
  OnlineSmoother smoother_;
  std::optional<int> person_id_;
  std::ostream& out_;
  long num_read_ = 0;
  CameraTrack camera_{.centre_px = Eigen::Vector2d::Constant(kUnknown)};
  std::optional<PoseToPerson> to_person_;  // once a frame is there
  double scale_px_per_m_ = kUnknown;
  std::deque<Waiting> waiting_;
  StreamReport report_;
};

}  // namespace

StreamReport SmoothStream(std::istream& in, const std::string& name, const Skeleton& skeleton,
                          std::shared_ptr<const MotionCodebook> codebook,
                          const StreamOptions& options, std::ostream& out) {
  Stream stream(name, skeleton, std::move(codebook), options, out);
  std::string text;
  for (int line = 1; std::getline(in, text); ++line)
    if (text.find_first_not_of(" \t\r") != std::string::npos) stream.Add(text, line);
  if (in.bad()) throw InputError(name, "reading broke off");
  return stream.End();
}

StreamReport SmoothStreamFiles(const std::string& in, const std::string& out,
                               const Skeleton& skeleton,
                               std::shared_ptr<const MotionCodebook> codebook,
                               const StreamOptions& options) {
  std::ifstream file;
  if (in != kStandardStream) {
    file.open(in);
    if (!file || fs::is_directory(in)) throw InputError(in, "cannot be opened");
  }
  std::istream& lines = in == kStandardStream ? std::cin : file;
  const std::string name = in == kStandardStream ? "standard input" : in;
  if (out == kStandardStream)
    return SmoothStream(lines, name, skeleton, std::move(codebook), options, std::cout);

  const fs::path part = out + ".part";
  std::ofstream growing(part);
  if (!growing) throw InputError(out, "cannot be written");
  try {
    const StreamReport report =
        SmoothStream(lines, name, skeleton, std::move(codebook), options, growing);
    growing.close();
    if (!growing) throw InputError(out, "cannot be written: is the disk full?");
    fs::rename(part, out);
    return report;
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
}

}  // namespace poselift::cli
