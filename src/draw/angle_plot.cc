// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/draw/angle_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "src/draw/plot_axis.h"
#include "src/draw/xml_text.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr std::array<const char*, 4> kDashes = {"", "7 4", "2 3", "9 3 2 3"};
constexpr double kLeft_px = 64, kRight_px = 20, kTop_px = 44, kAxis_px = 46, kStrip_px = 18,
                 kLegendRow_px = 22, kFont_px = 13, kSample_px = 30;
constexpr double kBandOpacity = 0.18;

template <typename... Args>
void Put(std::string* svg, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(*svg), format, std::forward<Args>(args)...);
}

// About; the font is the viewer's.
double TextWidth_px(std::string_view text) {
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // bytes that start one
  });
  return 0.56 * kFont_px * static_cast<double>(characters);
}

class Drawing {
 public:
  explicit Drawing(const AnglePlot& plot) : plot_(plot) {
    for (const AngleCurve& curve : plot.curves) {
      for (Eigen::Index i = 0; i < curve.times_s.size(); ++i) {
        if (!std::isfinite(curve.values_deg[i])) continue;
        times_s_.Add(curve.times_s[i]);
        const double band = Band_deg(curve, i);
        angles_deg_.Add(curve.values_deg[i] - band);
        angles_deg_.Add(curve.values_deg[i] + band);
      }
    }
    if (times_s_.IsEmpty() || angles_deg_.IsEmpty())
      throw InputError("found no angle to plot, wanted a curve with at least one value");
    times_s_ = times_s_.Widened(0.0, 1e-3);
    angles_deg_ = angles_deg_.Widened(0.05, 2.0);
    strips_top_px_ = kTop_px + plot.height_px;
    axis_px_ = strips_top_px_ + kStrip_px * static_cast<double>(plot.strips.size());
  }

  std::string Svg() {
    std::string body;
    DrawShades(&body);
    DrawGrid(&body);
    DrawStrips(&body);
    for (const AngleCurve& curve : plot_.curves) DrawBand(curve, &body);
    for (const AngleCurve& curve : plot_.curves) DrawCurve(curve, &body);
    const double bottom_px = DrawLegend(&body);
    std::string svg;
    Put(&svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
        "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"sans-serif\" font-size=\"{2}\">\n"
        "<title>{3}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        "<text x=\"{4:g}\" y=\"26\" font-size=\"17\" text-anchor=\"middle\">{3}</text>\n",
        plot_.width_px, bottom_px, kFont_px, EscapedXml(plot_.title), plot_.width_px / 2);
    return svg + body + "</svg>\n";
  }

 private:
  static double Band_deg(const AngleCurve& curve, Eigen::Index i) {
    if (curve.sigmas_deg.size() == 0 || !std::isfinite(curve.sigmas_deg[i])) return 0.0;
    return curve.sigmas_deg[i];
  }
  double X(double time_s) const {
    return kLeft_px + (plot_.width_px - kLeft_px - kRight_px) * (time_s - times_s_.low) /
                          (times_s_.high - times_s_.low);
  }
  double Y(double angle_deg) const {
    return kTop_px +
           plot_.height_px * (angles_deg_.high - angle_deg) / (angles_deg_.high - angles_deg_.low);
  }
  static const char* ColorOf(const AngleCurve& curve) { return CurveColor(curve.color_index); }
  static std::string DashOf(const AngleCurve& curve) {
    const char* dashes = kDashes[static_cast<size_t>(curve.dash_index) % kDashes.size()];
    return *dashes ? fmt::format(" stroke-dasharray=\"{}\"", dashes) : "";
  }

  void DrawSpan(const TimeSpan& span, double top_px, double height_px, const char* color,
                std::string* svg) const {
    const double from_px = X(std::max(span.from_s, times_s_.low));
    const double to_px = X(std::min(span.to_s, times_s_.high));
    if (!(to_px >= from_px)) return;
    Put(svg, "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
        from_px, top_px, std::max(1.0, to_px - from_px), height_px, color);
  }

  void DrawShades(std::string* svg) const {
    for (const TimeSpan& span : plot_.shaded) DrawSpan(span, kTop_px, plot_.height_px, kShade, svg);
  }

  void DrawGrid(std::string* svg) const {
    const double right_px = plot_.width_px - kRight_px;
    const double step_s = TickStep(times_s_, plot_.width_px / 100.0);
    for (double n = std::ceil(times_s_.low / step_s); n * step_s <= times_s_.high; ++n)
      Put(svg,
          "<path d=\"M{0:.2f} {1:g}V{2:g}\" stroke=\"#dddddd\"/>"
          "<text x=\"{0:.2f}\" y=\"{3:g}\" text-anchor=\"middle\">{4}</text>\n",
          X(n * step_s), kTop_px, axis_px_, axis_px_ + 18, TickText(n * step_s, step_s));
    const double step_deg = TickStep(angles_deg_, plot_.height_px / 60.0);
    for (double n = std::ceil(angles_deg_.low / step_deg); n * step_deg <= angles_deg_.high; ++n)
      Put(svg,
          "<path d=\"M{0:g} {1:.2f}H{2:g}\" stroke=\"{3}\"/>"
          "<text x=\"{4:g}\" y=\"{5:.2f}\" text-anchor=\"end\">{6}</text>\n",
          kLeft_px, Y(n * step_deg), right_px, n == 0.0 ? "#999999" : "#dddddd", kLeft_px - 7,
          Y(n * step_deg) + 4.5, TickText(n * step_deg, step_deg));
    Put(svg, "<path d=\"M{0:g} {1:g}V{2:g}H{3:g}\" fill=\"none\" stroke=\"#202020\"/>\n", kLeft_px,
        kTop_px, axis_px_, right_px);
    Put(svg, "<text x=\"{:.2f}\" y=\"{:g}\" text-anchor=\"middle\">time (s)</text>\n",
        (kLeft_px + right_px) / 2, axis_px_ + 37);
    Put(svg,
        "<text transform=\"translate(17 {:.2f}) rotate(-90)\" text-anchor=\"middle\">angle "
        "(degrees)</text>\n",
        kTop_px + plot_.height_px / 2);
  }

  void DrawStrips(std::string* svg) const {
    double top_px = strips_top_px_;
    for (const AngleStrip& strip : plot_.strips) {
      for (const TimeSpan& span : strip.spans)
        DrawSpan(span, top_px + 3, kStrip_px - 6, kStripColor, svg);
      Put(svg, "<text x=\"{:g}\" y=\"{:g}\" text-anchor=\"end\" font-size=\"10\">{}</text>\n",
          kLeft_px - 5, top_px + kStrip_px - 5, EscapedXml(strip.name));
      top_px += kStrip_px;
    }
  }

  // The runs of values between two gaps, [from, to).
  template <typename Draw>
  static void ForEachRun(const AngleCurve& curve, const Draw& draw) {
    const auto is_there = [&](Eigen::Index i) {
      return std::isfinite(curve.values_deg[i]) && std::isfinite(curve.times_s[i]);
    };
    for (Eigen::Index from = 0; from < curve.values_deg.size(); ++from) {
      if (!is_there(from)) continue;
      Eigen::Index to = from;
      while (to < curve.values_deg.size() && is_there(to)) ++to;
      draw(from, to);
      from = to;
    }
  }

  void DrawBand(const AngleCurve& curve, std::string* svg) const {
    if (curve.sigmas_deg.size() == 0) return;
    ForEachRun(curve, [&](Eigen::Index from, Eigen::Index to) {
      Put(svg, "<path d=\"");
      for (Eigen::Index i = from; i < to; ++i)
        Put(svg, "{}{:.2f} {:.2f}", i == from ? "M" : "L", X(curve.times_s[i]),
            Y(curve.values_deg[i] + Band_deg(curve, i)));
      for (Eigen::Index i = to; i-- > from;)
        Put(svg, "L{:.2f} {:.2f}", X(curve.times_s[i]),
            Y(curve.values_deg[i] - Band_deg(curve, i)));
      Put(svg, "Z\" fill=\"{}\" fill-opacity=\"{}\"/>\n", ColorOf(curve), kBandOpacity);
    });
  }

  void DrawCurve(const AngleCurve& curve, std::string* svg) const {
    std::string path;
    ForEachRun(curve, [&](Eigen::Index from, Eigen::Index to) {
      for (Eigen::Index i = from; i < to; ++i)
        Put(&path, "{}{:.2f} {:.2f}", i == from ? "M" : "L", X(curve.times_s[i]),
            Y(curve.values_deg[i]));
      if (to == from + 1) path += "h0";  // a dot, by the round ends
    });
    Put(svg,
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" stroke-linejoin=\"round\" "
        "stroke-linecap=\"round\"{}/>\n",
        path, ColorOf(curve), DashOf(curve));
  }

  // Returns where the picture ends.
  double DrawLegend(std::string* svg) const {
    double x_px = kLeft_px;
    double y_px = axis_px_ + kAxis_px + kLegendRow_px / 2;
    const auto next = [&](const std::string& name) {
      const double width_px = kSample_px + 6 + TextWidth_px(name) + 22;
      if (x_px > kLeft_px && x_px + width_px > plot_.width_px) {
        x_px = kLeft_px;
        y_px += kLegendRow_px;
      }
      Put(svg, "<text x=\"{:.2f}\" y=\"{:g}\">{}</text>\n", x_px + kSample_px + 6, y_px + 4.5,
          EscapedXml(name));
      const double at_px = x_px;
      x_px += width_px;
      return at_px;
    };
    for (const AngleCurve& curve : plot_.curves) {
      const double at_px = next(curve.name);
      Put(svg, "<path d=\"M{:.2f} {:g}h{:g}\" stroke=\"{}\" stroke-width=\"2.2\"{}/>\n", at_px,
          y_px, kSample_px, ColorOf(curve), DashOf(curve));
    }
    const auto has_band = [](const AngleCurve& curve) { return curve.sigmas_deg.size() > 0; };
    const auto banded = std::find_if(plot_.curves.begin(), plot_.curves.end(), has_band);
    if (banded != plot_.curves.end()) {
      const double at_px = next("± 1 standard deviation");
      Put(svg,
          "<rect x=\"{:.2f}\" y=\"{:g}\" width=\"{:g}\" height=\"12\" fill=\"{}\" "
          "fill-opacity=\"{}\"/>\n",
          at_px, y_px - 6, kSample_px, ColorOf(*banded), kBandOpacity);
    }
    if (!plot_.shaded.empty()) {
      const double at_px = next(plot_.shaded_name);
      Put(svg, "<rect x=\"{:.2f}\" y=\"{:g}\" width=\"{:g}\" height=\"12\" fill=\"{}\"/>\n", at_px,
          y_px - 6, kSample_px, kShade);
    }
    return y_px + kLegendRow_px;
  }

  static constexpr const char* kShade = "#e8e8e8";
  static constexpr const char* kStripColor = "#606060";

  const AnglePlot& plot_;
  PlotRange times_s_, angles_deg_;
  double strips_top_px_ = 0.0;
  double axis_px_ = 0.0;
};

}  // namespace

std::string AnglePlotSvg(const AnglePlot& plot) {
  for (const AngleCurve& curve : plot.curves)
    if (curve.times_s.size() != curve.values_deg.size() ||
        (curve.sigmas_deg.size() != 0 && curve.sigmas_deg.size() != curve.values_deg.size()))
      throw std::invalid_argument("AnglePlotSvg: a curve's times, values and sigmas differ");
  return Drawing(plot).Svg();
}

}  // namespace poselift
