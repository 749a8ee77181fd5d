// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_search.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <tuple>

#include "src/input_error.h"

namespace poselift {
namespace {

using Corners = TagSearch::Corners;

constexpr int kOverlap_px = 160;  // of strips
constexpr int kRim_px = 8;        // of a strip: tags on it are the next one's
constexpr int kTile_px = 32;      // that strips begin at: libapriltag's tiles, 8 times decimated
constexpr double kCoarse = 4.0;

TagDetectorOptions Decimated(TagDetectorOptions options, double decimate) {
  options.decimate = std::max(options.decimate, decimate);
  return options;
}

cv::Rect RegionAround(const Corners& corners_px, const TagSearchOptions& options) {
  double edge_px = 0.0;
  for (int i = 0; i < 4; ++i)
    edge_px = std::max(edge_px, (corners_px.col((i + 1) % 4) - corners_px.col(i)).norm());
  const double margin_px = std::max(options.min_margin_px, options.margin * edge_px);
  const Eigen::Vector2d first = corners_px.rowwise().minCoeff().array() - margin_px;
  const Eigen::Vector2d last = corners_px.rowwise().maxCoeff().array() + margin_px;
  const auto bounded = [](double px) { return static_cast<int>(std::clamp(px, -1e6, 1e6)); };
  return {cv::Point(bounded(first.x()), bounded(first.y())),
          cv::Point(bounded(last.x()) + 1, bounded(last.y()) + 1)};
}

// Regions that overlap become one, so that no tag is cut by another's region nor found twice.
void Merge(std::vector<cv::Rect>* regions) {
  for (size_t i = 0; i < regions->size(); ++i)
    for (size_t k = i + 1; k < regions->size(); ++k) {
      if (((*regions)[i] & (*regions)[k]).empty()) continue;
      (*regions)[i] |= (*regions)[k];
      regions->erase(regions->begin() + static_cast<std::ptrdiff_t>(k));
      i = static_cast<size_t>(-1);  // the larger one may reach others
      break;
    }
}

// Of each tag; sorted by ids.
void KeepBest(std::vector<TagDetection>* found) {
  std::ranges::sort(*found, {}, [](const TagDetection& tag) {
    return std::tuple(tag.id, tag.hamming, -tag.decision_margin);
  });
  const auto again = std::unique(
      found->begin(), found->end(),
      [](const TagDetection& one, const TagDetection& other) { return one.id == other.id; });
  found->erase(again, found->end());
}

// What each region shows, in pixels of the whole picture.
std::vector<std::vector<TagDetection>> DetectInEach(const cv::Mat& grey,
                                                    const std::vector<cv::Rect>& regions,
                                                    std::vector<TagDetector>* detectors) {
  std::vector<std::vector<TagDetection>> found_in(regions.size());
  const auto detect_every = [&](size_t worker) {
    for (size_t i = worker; i < regions.size(); i += detectors->size()) {
      found_in[i] = (*detectors)[worker].Detect(grey(regions[i]));
      const Eigen::Vector2d corner_px(regions[i].x, regions[i].y);
      for (TagDetection& tag : found_in[i]) {
        tag.corners_px.colwise() += corner_px;
        tag.centre_px += corner_px;
      }
    }
  };
  std::vector<std::jthread> workers;  // joined, whatever is thrown
  for (size_t w = 1; w < std::min(detectors->size(), regions.size()); ++w)
    workers.emplace_back(detect_every, w);
  detect_every(0);
  workers.clear();
  return found_in;
}

// The best of each tag.
std::vector<TagDetection> Together(const std::vector<std::vector<TagDetection>>& found_in) {
  std::vector<TagDetection> found;
  for (const auto& some : found_in) found.insert(found.end(), some.begin(), some.end());
  KeepBest(&found);
  return found;
}

}  // namespace

std::string TagSearchOptions::Validate() const {
  if (glance_every < 1 || full_every < 1)
    return fmt::format("TagSearchOptions::glance_every, full_every = {}, {}, wanted at least 1",
                       glance_every, full_every);
  if (!(margin >= 0.0 && margin <= 100.0))
    return fmt::format("TagSearchOptions::margin = {}, wanted 0 to 100", margin);
  if (!(min_margin_px >= 8.0))
    return fmt::format("TagSearchOptions::min_margin_px = {}, wanted at least 8", min_margin_px);
  if (patience < 0)
    return fmt::format("TagSearchOptions::patience = {}, wanted 0 or more", patience);
  if (threads < 1 || threads > 64)
    return fmt::format("TagSearchOptions::threads = {}, wanted 1 to 64", threads);
  return Decimated(detector, glance_decimate).Validate();
}

TagSearch::TagSearch(const TagFamily& family, const TagSearchOptions& options)
    : options_(options), coarse_(family, Decimated(options.detector, kCoarse)) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  for (int i = 0; i < options.threads; ++i) {
    at_full_.emplace_back(family, options.detector);
    at_glance_.emplace_back(family, Decimated(options.detector, options.glance_decimate));
  }
}

std::vector<TagDetection> TagSearch::Detect(const cv::Mat& grey,
                                            const std::map<int, Corners>& predicted_px) {
  std::vector<TagDetection> found;
  last_look_ = to_full_ == 0 ? Look::kFull : Look::kRegions;
  if (last_look_ == Look::kFull) {
    found = DetectInStrips(grey, &at_full_);
    if (options_.threads > 1) found = Together({found, coarse_.Detect(grey)});
  } else {
    found = Together(DetectInEach(grey, Regions(grey.size(), predicted_px), &at_full_));
    if (to_glance_ == 0 || IsOneMissing(found)) last_look_ = Look::kGlance;
  }
  if (last_look_ == Look::kGlance) {
    // Lower resolution loses small tags that their regions show: keep both.
    found = Together({found, DetectInStrips(grey, &at_glance_)});
  }
  to_full_ = (to_full_ == 0 ? options_.full_every : to_full_) - 1;
  to_glance_ = (last_look_ != Look::kRegions ? options_.glance_every : to_glance_) - 1;
  Remember(found);
  return found;
}

std::vector<cv::Rect> TagSearch::Regions(const cv::Size& size,
                                         const std::map<int, Corners>& predicted_px) const {
  std::vector<cv::Rect> regions;
  const auto add = [&](const Corners& corners_px) {
    const cv::Rect region = corners_px.allFinite()
                                ? RegionAround(corners_px, options_) & cv::Rect({0, 0}, size)
                                : cv::Rect();
    if (!region.empty()) regions.push_back(region);
  };
  for (const auto& [id, corners_px] : predicted_px) add(corners_px);
  for (const auto& [id, seen] : seen_) {
    if (predicted_px.count(id) != 0) continue;
    // Where it goes on to, and where it was: motion may stop.
    cv::Rect region = RegionAround(seen.corners_px, options_);
    region |= RegionAround(seen.corners_px + (seen.frames_ago + 1) * seen.moved_px, options_);
    region &= cv::Rect({0, 0}, size);
    if (!region.empty()) regions.push_back(region);
  }
  Merge(&regions);
  return regions;
}

// Only a tag that the last frame showed asks for a glance, so that one that is hidden for
// long does not bring one in every frame.
bool TagSearch::IsOneMissing(const std::vector<TagDetection>& found) const {
  return std::any_of(seen_.begin(), seen_.end(), [&](const auto& seen) {
    return seen.second.frames_ago == 0 &&
           std::none_of(found.begin(), found.end(),
                        [&](const TagDetection& tag) { return tag.id == seen.first; });
  });
}

// In strips that overlap, one a thread. What is on the rim of a strip is whole in the next one,
// or so large that only the coarse look at a whole frame finds it.
std::vector<TagDetection> TagSearch::DetectInStrips(const cv::Mat& grey,
                                                    std::vector<TagDetector>* detectors) {
  const int count = static_cast<int>(detectors->size());
  if (count == 1 || grey.rows < count * 2 * kOverlap_px) return detectors->front().Detect(grey);
  std::vector<cv::Rect> strips;
  for (int i = 0; i < count; ++i) {
    const int middle = i * grey.rows / count, next = (i + 1) * grey.rows / count;
    const int first = i == 0 ? 0 : (middle - kOverlap_px / 2) / kTile_px * kTile_px;
    const int last = i + 1 == count ? grey.rows : next + kOverlap_px / 2;
    strips.emplace_back(0, first, grey.cols, last - first);
  }
  auto found_in = DetectInEach(grey, strips, detectors);
  for (int i = 0; i < count; ++i) {
    const double first = i == 0 ? -1.0 : strips[i].y + kRim_px;
    const double last = i + 1 == count ? grey.rows : strips[i].br().y - kRim_px;
    std::erase_if(found_in[i], [&](const TagDetection& tag) {
      const auto y_px = tag.corners_px.row(1);
      return y_px.minCoeff() < first || y_px.maxCoeff() > last;
    });
  }
  return Together(found_in);
}

void TagSearch::Remember(const std::vector<TagDetection>& found) {
  for (auto& [id, seen] : seen_) ++seen.frames_ago;
  for (const TagDetection& tag : found) {
    const auto before = seen_.find(tag.id);
    Seen now{tag.corners_px, Corners::Zero(), 0};
    if (before != seen_.end())
      now.moved_px = (tag.corners_px - before->second.corners_px) / before->second.frames_ago;
    seen_[tag.id] = now;
  }
  std::erase_if(seen_,
                [&](const auto& seen) { return seen.second.frames_ago > options_.patience; });
}

}  // namespace poselift
