// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/calibrate_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "calib/calibration_coverage.h"
#include "src/capture/open_frame_source.h"
#include "src/input_error.h"
#include "src/io/image.h"
#include "src/io/image_folder.h"
#include "src/io/video.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/progress.h"

namespace poselift::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> FindPictures(const std::vector<std::string>& inputs) {
  std::vector<fs::path> pictures;
  for (const fs::path input : inputs) {
    if (fs::is_directory(input)) {
      const size_t before = pictures.size();
      for (const auto& entry : fs::directory_iterator(input))
        if (HasImageEnding(entry.path())) pictures.push_back(entry.path());
      if (pictures.size() == before) throw InputError(input, "found no picture in this folder");
      std::sort(pictures.begin() + static_cast<std::ptrdiff_t>(before), pictures.end(),
                [](const fs::path& a, const fs::path& b) {
                  return IsNaturallyBefore(a.native(), b.native());
                });
    } else {
      pictures.push_back(input);
    }
  }
  return pictures;
}

cv::Mat ReadGrey(const fs::path& path) {
  cv::Mat grey;
  cv::cvtColor(ReadImage(path), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

struct FoundPicture {
  std::string flaw;  // of a picture that cannot be read
  cv::Size size_px;
  BoardView view;
  BoardAbsence absence;
};

cv::Size MostFrequentSize(const std::vector<FoundPicture>& pictures) {
  std::map<std::pair<int, int>, int> times;
  cv::Size most;
  for (const FoundPicture& picture : pictures) {
    if (!picture.flaw.empty()) continue;
    // A picture with the board tells more than one without.
    int& count = times[{picture.size_px.width, picture.size_px.height}];
    count += picture.view.empty() ? 1 : 1000;
    if (count > times[{most.width, most.height}]) most = picture.size_px;
  }
  return most;
}

SurveyedViews SurveyPictures(const std::vector<fs::path>& paths, BoardFinder* finder) {
  Progress progress("find board", static_cast<int64_t>(paths.size()), "pictures");
  std::vector<FoundPicture> found;
  for (const fs::path& path : paths) {
    FoundPicture& picture = found.emplace_back();
    cv::Mat grey;
    try {
      grey = ReadGrey(path);
    } catch (const InputError& error) {
      if (paths.size() == 1) throw;
      picture.flaw = error.what();
      continue;
    }
    picture.size_px = grey.size();
    picture.view = finder->Find(grey);
    if (picture.view.empty()) picture.absence = finder->Explain(grey);
    progress.Advance(static_cast<double>(found.size()) / static_cast<double>(paths.size()));
  }
  SurveyedViews surveyed;
  surveyed.size_px = MostFrequentSize(found);
  if (surveyed.size_px.empty()) throw InputError(found.front().flaw);
  for (size_t i = 0; i < paths.size(); ++i) {
    SurveyedPicture& picture = surveyed.pictures.emplace_back();
    picture.name = paths[i].filename();
    if (!found[i].flaw.empty()) {
      picture.skipped = found[i].flaw;
      continue;
    }
    if (found[i].size_px != surveyed.size_px) {
      picture.skipped =
          fmt::format("{} x {} pixels, the others have {} x {}", found[i].size_px.width,
                      found[i].size_px.height, surveyed.size_px.width, surveyed.size_px.height);
      continue;
    }
    if (found[i].view.empty()) {
      picture.skipped = Describe(*finder, found[i].absence);
      surveyed.survey.absences.push_back(found[i].absence);
      continue;
    }
    surveyed.survey.AddFound(found[i].view);
    surveyed.views.push_back(found[i].view);
  }
  return surveyed;
}

// Some frames without the board, to say why when there are no others.
class Absences {
 public:
  void Add(const cv::Mat& grey) {
    constexpr size_t kKept = 5;
    if (num_++ % step_ != 0) return;
    if (frames_.size() == kKept) {
      for (size_t i = 1; 2 * i < frames_.size(); ++i) frames_[i] = frames_[2 * i];
      frames_.resize((kKept + 1) / 2);
      step_ *= 2;
    }
    frames_.push_back(grey.clone());
  }

  void Explain(BoardFinder* finder, BoardSurvey* survey) const {
    for (const cv::Mat& frame : frames_) survey->absences.push_back(finder->Explain(frame));
  }

 private:
  std::vector<cv::Mat> frames_;
  size_t num_ = 0, step_ = 1;
};

SurveyedViews Chosen(const ViewChooser& chooser, const Absences& absences, cv::Size size_px,
                     BoardFinder* finder) {
  SurveyedViews surveyed;
  surveyed.size_px = size_px;
  for (const ChosenView& view : chooser.SharpViews()) {
    surveyed.pictures.push_back({fmt::format("frame {} ({:.2f} s)", view.frame, view.time_s), ""});
    surveyed.views.push_back(view.view);
    surveyed.survey.AddFound(view.view);
  }
  if (surveyed.views.size() < 3) absences.Explain(finder, &surveyed.survey);
  return surveyed;
}

SurveyedViews SurveyVideo(const std::string& path, const ViewsOptions& options,
                          BoardFinder* finder) {
  const double last_s = ReadFrameTimes(path).back();
  VideoFile video(path, Pictures::kGrey);
  Progress progress("find board");
  ViewChooser chooser(video.size_px(), options.chooser);
  Absences absences;
  double step_s = 0.0;  // from frame to frame, as the last two had it
  for (auto frame = video.Next(); frame; frame = video.Next()) {
    const BoardView view = finder->Find(frame->grey);
    if (view.empty()) absences.Add(frame->grey);
    chooser.Offer(frame->grey, view, frame->index, frame->time_s);
    progress.Advance(frame->time_s / std::max(1e-3, last_s));
    for (double time_s = frame->time_s; time_s + 1.5 * step_s < frame->time_s + options.every_s;) {
      const auto skipped_s = video.Skip_s();
      if (!skipped_s) break;
      step_s = *skipped_s - time_s;
      time_s = *skipped_s;
    }
  }
  return Chosen(chooser, absences, video.size_px(), finder);
}

CalibrationCoverage CoverageSoFar(const ViewChooser& chooser, const BoardFinder& finder,
                                  cv::Size size_px) {
  std::vector<const BoardView*> views;
  for (const ChosenView& view : chooser.views()) views.push_back(&view.view);
  return CoverageOf(finder.board(), views, size_px.width, size_px.height);
}

void TellCoverage(const CalibrationCoverage& coverage, const std::string& hint, double time_s) {
  const nlohmann::ordered_json line = {{"time_s", std::round(100.0 * time_s) / 100.0},
                                       {"views", coverage.num_views},
                                       {"share", std::round(100.0 * coverage.share) / 100.0},
                                       {"hint", hint}};
  fmt::print(stderr, "{}\n", line.dump());
}

void TellCoverage(const CalibrationCoverage& coverage, double time_s) {
  TellCoverage(coverage, coverage.hints.empty() ? "enough" : coverage.hints.front(), time_s);
}

SurveyedViews SurveyCamera(const std::string& name, const ViewsOptions& options,
                           BoardFinder* finder) {
  FrameSourceOptions opening{.pictures = Pictures::kGrey};
  opening.live.camera = options.device.Options();
  const auto camera = OpenFrameSource(name, opening);
  TellCamera(*camera);
  const Interrupt interrupt;
  ViewChooser chooser(camera->size_px(), options.chooser);
  Absences absences;
  CalibrationCoverage coverage = CoverageSoFar(chooser, *finder, camera->size_px());
  TellCoverage(coverage, 0.0);
  constexpr double kPatience_s = 2.0;  // of who moves the board and looks
  double seen_s = 0.0;                 // the board, or told that it is not
  while (!interrupt.asked() && !coverage.hints.empty()) {
    const auto frame = camera->Next();
    if (!frame || frame->time_s > options.seconds) break;
    const BoardView view = finder->Find(frame->grey);
    if (view.empty()) absences.Add(frame->grey);
    if (!view.empty()) seen_s = frame->time_s;
    if (frame->time_s > seen_s + kPatience_s) {
      TellCoverage(coverage, Describe(*finder, finder->Explain(frame->grey)), frame->time_s);
      seen_s = frame->time_s;
    }
    if (!chooser.Offer(frame->grey, view, frame->index, frame->time_s)) continue;
    coverage = CoverageSoFar(chooser, *finder, camera->size_px());
    TellCoverage(coverage, frame->time_s);
  }
  return Chosen(chooser, absences, camera->size_px(), finder);
}

}  // namespace

SurveyedViews SurveyViews(const std::vector<std::string>& inputs, const ViewsOptions& options,
                          BoardFinder* finder) {
  for (const std::string& input : inputs) {
    const SourceKind kind = KindOfSource(input);
    if (kind != SourceKind::kVideo && kind != SourceKind::kCamera) continue;
    if (kind == SourceKind::kVideo && !IsVideoFile(input)) continue;  // a picture by another name
    if (inputs.size() > 1)
      throw InputError(input, "found it among other inputs, wanted a video or a camera alone");
    return kind == SourceKind::kVideo ? SurveyVideo(input, options, finder)
                                      : SurveyCamera(input, options, finder);
  }
  return SurveyPictures(FindPictures(inputs), finder);
}

}  // namespace poselift::cli
