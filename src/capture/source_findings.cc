// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/capture/source_findings.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cmath>

#include "src/capture/fourcc.h"

namespace poselift {
namespace {

using Weight = Finding::Weight;
using Findings = std::vector<Finding>;

// Rates are met within this: clocks of cameras differ.
constexpr double kRateSlack = 0.95;

double HighestRate(const std::vector<CameraFormat>& formats, uint32_t fourcc, cv::Size size_px) {
  double highest_hz = 0.0;
  for (const CameraFormat& format : formats)
    for (const CameraSize& size : format.sizes)
      if (format.fourcc == fourcc && size.size_px == size_px && !size.rates_hz.empty())
        highest_hz = std::max(highest_hz, size.rates_hz.front());
  return highest_hz;
}

const CameraControl* Find(const CameraFacts& camera, uint32_t id) {
  for (const CameraControl& control : camera.controls)
    if (control.id == id) return &control;
  return nullptr;
}

bool IsOn(const CameraFacts& camera, uint32_t id) {
  const CameraControl* control = Find(camera, id);
  return control && control->value.value_or(0) != 0;
}

bool IsExposureAutomatic(const CameraFacts& camera) {
  const CameraControl* automatic = Find(camera, V4L2_CID_EXPOSURE_AUTO);
  return automatic && automatic->value != V4L2_EXPOSURE_MANUAL &&
         automatic->value != V4L2_EXPOSURE_SHUTTER_PRIORITY;
}

std::string SetCommand(const SourceFacts& facts, const std::string& setting) {
  return fmt::format("poselift doctor {} --set {}", facts.name, setting);
}

void JudgeMode(const CameraFacts& camera, Findings* findings) {
  const bool is_other_size = camera.given.size_px != camera.asked.size_px;
  if (is_other_size || camera.given.fourcc != camera.asked.fourcc)
    findings->push_back({Weight::kAdvice,
                         fmt::format("was asked for {} and gives {}", ModeText(camera.asked),
                                     ModeText(camera.given)),
                         is_other_size ? "a calibration holds for one size of the picture"
                                       : "another format may be slower, or coarser",
                         is_other_size ? "calibrate and track with the size that it gives"
                                       : "ask for a format that it offers: `poselift doctor` "
                                         "without a name lists them"});
  if (camera.given.rate_hz > 0.0 && camera.given.rate_hz < kRateSlack * camera.wanted.rate_hz)
    findings->push_back(
        {Weight::kAdvice,
         fmt::format("offers {:.3g} pictures a second at {}x{}, {:.3g} were wanted",
                     camera.given.rate_hz, camera.given.size_px.width, camera.given.size_px.height,
                     camera.wanted.rate_hz),
         "a hand moves half a metre between two pictures at 10 a second, a few centimetres at 30",
         "choose MJPG or a smaller size: `poselift doctor` without a name lists what it offers"});
}

void JudgeRate(const SourceFacts& facts, const CameraFacts& camera, Findings* findings) {
  const double stated_hz = camera.given.rate_hz;
  if (facts.num_frames < 10 || stated_hz <= 0.0 || facts.rate_hz() > kRateSlack * stated_hz) return;
  // Frames that were lost have a finding of their own.
  const double all_hz = facts.rate_hz() *
                        static_cast<double>(facts.num_frames + camera.counts.num_missing()) /
                        facts.num_frames;
  if (all_hz > kRateSlack * stated_hz) return;
  const bool may_slow_down = IsOn(camera, V4L2_CID_EXPOSURE_AUTO_PRIORITY);
  findings->push_back(
      {Weight::kProblem,
       fmt::format("gives {:.3g} pictures a second, {:.3g} were stated", all_hz, stated_hz),
       may_slow_down ? "in dim light it exposes longer than a picture may last, which smears tags"
                     : "what is slower than stated exposes too long, or its bus is too busy",
       may_slow_down
           ? "keep the rate: " +
                 SetCommand(facts, Find(camera, V4L2_CID_EXPOSURE_AUTO_PRIORITY)->name + "=0") +
                 ", and light the room more"
           : "light the room more, set the exposure by hand, or use another USB port"});
}

void JudgeCounts(const SourceFacts& facts, const CameraFacts& camera, Findings* findings) {
  const CaptureCounts& counts = camera.counts;
  const double all = static_cast<double>(facts.num_frames + counts.num_missing());
  const auto add = [&](int64_t count, const char* what, const char* to_do) {
    constexpr double kBearablePart = 0.005;
    if (static_cast<double>(count) <= kBearablePart * all) return;
    findings->push_back({Weight::kProblem,
                         fmt::format("{} of {:.0f} pictures {}", count, all, what),
                         "a tag is followed by where it was a picture before", to_do});
  };
  add(counts.lost, "were lost before the driver had them",
      "use a USB port of its own, without a hub; a smaller size; MJPG");
  add(counts.bad, "came broken", "try another cable and another USB port; avoid long extensions");
  add(counts.dropped, "were dropped, as this computer was not fast enough",
      "close other programs, or take a smaller size or a lower rate");
}

void JudgeExposure(const SourceFacts& facts, const CameraFacts& camera, Findings* findings) {
  constexpr double kLongest_s = 0.010;
  constexpr double kUnit_s = 1e-4;  // of V4L2_CID_EXPOSURE_ABSOLUTE
  const CameraControl* exposure = Find(camera, V4L2_CID_EXPOSURE_ABSOLUTE);
  const char* why =
      "a hand moves at 1 to 3 m/s: in 10 ms a tag on it is smeared by 1 to 3 cm, a cell or more";
  if (!exposure) {
    findings->push_back({Weight::kNote, "has no exposure time that can be set", why,
                         "light the room brightly, so that it exposes shortly"});
    return;
  }
  const double exposure_s = kUnit_s * static_cast<double>(exposure->value.value_or(0));
  const bool is_automatic = IsExposureAutomatic(camera);
  if (!is_automatic && exposure_s <= kLongest_s) return;
  const int64_t wanted = std::clamp<int64_t>(50, exposure->lowest, exposure->highest);
  const std::string set = "more light, and " +
                          SetCommand(facts, fmt::format("exposure={}", wanted)) +
                          " (in 0.1 ms), then gain until the picture is bright enough";
  findings->push_back({exposure_s > kLongest_s ? Weight::kProblem : Weight::kAdvice,
                       fmt::format("exposes for {:.3g} ms{}", 1e3 * exposure_s,
                                   is_automatic ? ", set by itself, so it may be another" : ""),
                       why, set});
}

void JudgeFocus(const SourceFacts& facts, const CameraFacts& camera, Findings* findings) {
  const CameraControl* automatic = Find(camera, V4L2_CID_FOCUS_AUTO);
  if (!automatic || automatic->value.value_or(0) == 0) return;
  findings->push_back({Weight::kAdvice, "focuses by itself",
                       "its focal length, and so the calibration, changes with the focus",
                       "fix it at your distance: " + SetCommand(facts, automatic->name + "=0")});
}

void JudgeBrightness(const SourceFacts& facts, Findings* findings) {
  constexpr double kDim = 50.0;
  constexpr double kMostSaturated = 0.05;
  if (facts.num_frames == 0) return;
  if (facts.mean_grey < kDim)
    findings->push_back({Weight::kProblem,
                         fmt::format("is dark: mean grey {:.0f} of 255, {:.0f} % of it near black",
                                     facts.mean_grey, 100.0 * facts.dark_part),
                         "noise hides the bits of tags that are small or far",
                         "more light; then a longer exposure or more gain"});
  if (facts.saturated_part > kMostSaturated)
    findings->push_back(
        {Weight::kAdvice,
         fmt::format("is saturated in {:.0f} % of it", 100.0 * facts.saturated_part),
         "white that flows over moves the edges of tags",
         "a shorter exposure or less gain; no window behind the person"});
}

void JudgeTags(const SourceFacts& facts, Findings* findings) {
  constexpr double kSharp_px = 2.5;
  constexpr double kDirected = 1.6;
  if (!facts.tags) return;
  const TagFacts& tags = *facts.tags;
  if (tags.num_found == 0 && tags.num_found_mirrored > 0)
    findings->push_back({Weight::kProblem, "is mirrored: tags are found in its mirror image alone",
                         "a mirrored tag is no tag, and left and right are swapped",
                         "turn mirroring off where the picture is made"});
  if (tags.num_found == 0 && tags.num_found_mirrored == 0)
    findings->push_back({Weight::kNote, "shows no tag",
                         "with one in view its sharpness and mirroring are checked too",
                         "hold a printed tag before it and look again"});
  if (!(tags.wider_edge_px > kSharp_px)) return;
  const bool is_motion = tags.wider_edge_px > kDirected * tags.sharper_edge_px;
  findings->push_back(
      {Weight::kAdvice,
       fmt::format(
           "has tags with edges {:.1f} px wide{}", tags.wider_edge_px,
           is_motion ? fmt::format(" one way, {:.1f} px the other", tags.sharper_edge_px) : ""),
       "a sharp edge takes some 1.5 px; cells of a tag narrower than its edges are not read",
       is_motion ? "it moved: a shorter exposure and more light"
                 : "it is out of focus: focus at your distance, and clean the lens"});
}

void JudgeTimes(const SourceFacts& facts, Findings* findings) {
  constexpr double kMostUneven = 2.5;
  if (facts.num_frames == 0) {
    findings->push_back({Weight::kProblem, "gave no picture", "", "see the message above"});
    return;
  }
  if (facts.num_frames < 3 || facts.longest_gap_s * facts.rate_hz() <= kMostUneven) return;
  findings->push_back({Weight::kAdvice,
                       fmt::format("has a gap of {:.0f} ms; its pictures are {:.0f} ms apart",
                                   1e3 * facts.longest_gap_s, 1e3 / facts.rate_hz()),
                       "a tag that moves is lost in it", "record without other programs running"});
}

void SortByWeight(Findings* findings) {
  std::stable_sort(findings->begin(), findings->end(),
                   [](const Finding& a, const Finding& b) { return a.weight < b.weight; });
}

}  // namespace

Findings JudgeFormats(const std::vector<CameraFormat>& formats, const CameraMode& wanted) {
  Findings findings;
  const CameraMode best = ChooseMode(formats, wanted);
  if (best.fourcc == 0) {
    CameraMode any = wanted;
    any.fourcc = 0;
    if (ChooseMode(formats, any).fourcc != 0) return findings;  // JudgeMode says what came instead
    findings.push_back({Weight::kProblem, "offers no format that is decoded here",
                        "no picture, no tags", "take a camera with " + DecodableFormats()});
    return findings;
  }
  const double yuyv_hz = HighestRate(formats, kFourccYuyv, best.size_px);
  const double mjpg_hz = HighestRate(formats, kFourccMjpg, best.size_px);
  if (yuyv_hz > 0.0 && mjpg_hz > 0.0 && yuyv_hz < kRateSlack * mjpg_hz &&
      yuyv_hz < kRateSlack * wanted.rate_hz)
    findings.push_back(
        {best.fourcc == kFourccYuyv ? Weight::kAdvice : Weight::kNote,
         fmt::format("gives {:.3g} pictures a second as YUYV at {}x{}, {:.3g} as MJPG", yuyv_hz,
                     best.size_px.width, best.size_px.height, mjpg_hz),
         "pictures that are not compressed fill its USB bus",
         "take MJPG, which is what is chosen by itself; other programs may need to be told"});
  return findings;
}

Findings JudgeSource(const SourceFacts& facts) {
  Findings findings;
  if (facts.camera) {
    const CameraFacts& camera = *facts.camera;
    findings = JudgeFormats(camera.formats, camera.wanted);
    JudgeMode(camera, &findings);
    JudgeRate(facts, camera, &findings);
    JudgeCounts(facts, camera, &findings);
    JudgeExposure(facts, camera, &findings);
    JudgeFocus(facts, camera, &findings);
  }
  JudgeTimes(facts, &findings);
  JudgeBrightness(facts, &findings);
  JudgeTags(facts, &findings);
  SortByWeight(&findings);
  return findings;
}

}  // namespace poselift
