// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_detector.h"

#include <apriltag.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "calib/tag_corners.h"
#include "src/input_error.h"

namespace poselift {
namespace {

// libapriltag's thresholds look at tiles of 4 pixels and their neighbours; no tag is smaller.
constexpr int kSmallestPicture_px = 12;

struct DestroyDetector {
  void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
};
struct DestroyDetections {
  void operator()(zarray_t* detections) const { apriltag_detections_destroy(detections); }
};

bool IsBetter(const TagDetection& a, const TagDetection& b) {
  if (a.hamming != b.hamming) return a.hamming < b.hamming;
  return a.decision_margin > b.decision_margin;
}

// libapriltag puts the centre of the first pixel at (0.5, 0.5), and its corners begin at the
// bottom left and go round the other way.
TagDetection Converted(const apriltag_detection_t& found) {
  TagDetection tag;
  tag.id = found.id;
  tag.hamming = found.hamming;
  tag.decision_margin = found.decision_margin;
  for (int i = 0; i < 4; ++i)
    tag.corners_px.col(i) << found.p[3 - i][0] - 0.5, found.p[3 - i][1] - 0.5;
  return tag;
}

}  // namespace

std::string TagDetectorOptions::Validate() const {
  if (!(decimate == 1.5 ||
        (decimate >= 1.0 && decimate <= 16.0 && std::floor(decimate) == decimate)))
    return fmt::format("TagDetectorOptions::decimate = {}, wanted 1, 1.5, 2, 3, ... 16", decimate);
  if (!(blur_sigma_px >= 0.0 && blur_sigma_px <= 10.0))
    return fmt::format("TagDetectorOptions::blur_sigma_px = {}, wanted 0 to 10", blur_sigma_px);
  if (max_hamming < 0 || max_hamming > 1)
    return fmt::format("TagDetectorOptions::max_hamming = {}, wanted 0 or 1", max_hamming);
  if (!(min_decision_margin >= 0.0 && min_decision_margin <= 255.0))
    return fmt::format("TagDetectorOptions::min_decision_margin = {}, wanted 0 to 255",
                       min_decision_margin);
  return "";
}

// The family is this detector's own: libapriltag keeps a detector's table of codes in it.
struct TagDetector::Impl {
  TagFamily family;
  TagDetectorOptions options;
  uint64_t* all_codes;
  uint32_t num_all_codes;
  std::vector<uint64_t> codes;  // of the known ids
  std::unique_ptr<apriltag_detector_t, DestroyDetector> detector;
  std::vector<int> duplicated_ids;

  Impl(const std::string& name, TagDetectorOptions wanted)
      : family(name),
        options(std::move(wanted)),
        all_codes(family.get()->codes),
        num_all_codes(family.get()->ncodes) {
    KeepKnownCodes();
    detector.reset(apriltag_detector_create());
    detector->nthreads = 1;
    detector->quad_decimate = static_cast<float>(options.decimate);
    detector->quad_sigma = static_cast<float>(options.blur_sigma_px);
    apriltag_detector_add_family_bits(detector.get(), family.get(), options.max_hamming);
  }

  ~Impl() {
    detector.reset();
    family.get()->codes = all_codes;
    family.get()->ncodes = num_all_codes;
  }

  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // The table is made of the codes that the family has: let these be the known ones.
  void KeepKnownCodes() {
    std::vector<int>& ids = options.known_ids;
    if (ids.empty()) return;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (const int id : {ids.front(), ids.back()})
      if (id < 0 || id >= family.num_ids())
        throw InputError(fmt::format("found the tag id {}, wanted 0 to {}: {} has no more", id,
                                     family.num_ids() - 1, family.name()));
    for (const int id : ids) codes.push_back(all_codes[id]);
    family.get()->codes = codes.data();
    family.get()->ncodes = static_cast<uint32_t>(codes.size());
  }

  // Of each id, by rising id.
  void KeepBest(std::vector<TagDetection>* tags) {
    std::sort(tags->begin(), tags->end(), [](const TagDetection& a, const TagDetection& b) {
      return a.id != b.id ? a.id < b.id : IsBetter(a, b);
    });
    const auto same_id = [&](const TagDetection& kept, const TagDetection& next) {
      if (kept.id != next.id) return false;
      if (duplicated_ids.empty() || duplicated_ids.back() != kept.id)
        duplicated_ids.push_back(kept.id);
      return true;
    };
    tags->erase(std::unique(tags->begin(), tags->end(), same_id), tags->end());
  }
};

TagDetector::TagDetector(const TagFamily& family, const TagDetectorOptions& options) {
  if (const std::string error = options.Validate(); !error.empty()) throw InputError(error);
  impl_ = std::make_unique<Impl>(family.name(), options);
}

TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&& other) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&& other) noexcept = default;

const std::vector<int>& TagDetector::duplicated_ids() const { return impl_->duplicated_ids; }
const TagDetectorOptions& TagDetector::options() const { return impl_->options; }

std::vector<TagDetection> TagDetector::Detect(const cv::Mat& grey) {
  if (!grey.empty() && grey.type() != CV_8UC1)
    throw std::invalid_argument("tag detector: a picture is 8-bit grey");
  std::vector<TagDetection> tags;
  impl_->duplicated_ids.clear();
  if (std::min(grey.cols, grey.rows) < kSmallestPicture_px * impl_->options.decimate) return tags;
  // Without decimation libapriltag would blur the caller's picture.
  const cv::Mat picture = impl_->options.blur_sigma_px > 0.0 ? grey.clone() : grey;
  image_u8_t image{picture.cols, picture.rows, static_cast<int32_t>(picture.step), picture.data};
  const std::unique_ptr<zarray_t, DestroyDetections> found(
      apriltag_detector_detect(impl_->detector.get(), &image));
  for (int i = 0; i < zarray_size(found.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found.get(), i, &detection);
    if (detection->decision_margin < impl_->options.min_decision_margin) continue;
    TagDetection tag = Converted(*detection);
    if (!impl_->options.known_ids.empty())
      tag.id = impl_->options.known_ids[static_cast<size_t>(tag.id)];
    tags.push_back(tag);
  }
  impl_->KeepBest(&tags);
  for (TagDetection& tag : tags) {
    if (impl_->options.refine_corners)
      tag.is_refined = RefineTagCorners(grey, impl_->family.cells_of_size(), &tag.corners_px);
    tag.centre_px = PxFromTag(tag.corners_px).col(2).head<2>();
  }
  return tags;
}

}  // namespace poselift
