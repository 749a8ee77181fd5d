// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "calib/tag_family.h"

#include <apriltag.h>
#include <common/image_u8.h>
#include <fmt/ranges.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h10.h>
#include <tag36h11.h>
#include <tagCircle21h7.h>
#include <tagCircle49h12.h>
#include <tagCustom48h12.h>
#include <tagStandard41h12.h>
#include <tagStandard52h13.h>

#include <algorithm>
#include <array>

#include "src/input_error.h"

namespace poselift {
namespace {

struct Row {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

// The same codes with a black border of two cells, as AprilTag 1 allowed and Kalibr prints them.
apriltag_family_t* CreateTag36h11b2() {
  apriltag_family_t* family = tag36h11_create();
  family->width_at_border += 2;
  family->total_width += 2;
  for (uint32_t i = 0; i < family->nbits; ++i) {
    ++family->bit_x[i];
    ++family->bit_y[i];
  }
  return family;
}

constexpr std::array kFamilies = {
    Row{"tag36h11", tag36h11_create, tag36h11_destroy},
    Row{"tag36h11b2", CreateTag36h11b2, tag36h11_destroy},
    Row{"tag36h10", tag36h10_create, tag36h10_destroy},
    Row{"tag25h9", tag25h9_create, tag25h9_destroy},
    Row{"tag16h5", tag16h5_create, tag16h5_destroy},
    Row{"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    Row{"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy},
    Row{"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy},
    Row{"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    Row{"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
};

}  // namespace

const std::vector<std::string>& TagFamily::Names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const Row& row : kFamilies) names.emplace_back(row.name);
    return names;
  }();
  return kNames;
}

TagFamily::TagFamily(const std::string& name) : name_(name) {
  const auto row = std::find_if(kFamilies.begin(), kFamilies.end(),
                                [&](const Row& candidate) { return candidate.name == name; });
  if (row == kFamilies.end())
    throw InputError(fmt::format("found the tag family '{}', wanted one of: {}", name,
                                 fmt::join(Names(), ", ")));
  family_ = {row->create(), row->destroy};
}

int TagFamily::num_ids() const { return static_cast<int>(family_->ncodes); }
int TagFamily::cells() const { return family_->total_width; }
int TagFamily::cells_of_size() const { return family_->width_at_border; }

cv::Mat TagFamily::Image(int id) const {
  if (id < 0 || id >= num_ids())
    throw InputError(fmt::format("found the tag id {}, wanted 0 to {}: {} has no more", id,
                                 num_ids() - 1, name_));
  const std::unique_ptr<image_u8_t, decltype(&image_u8_destroy)> image(
      apriltag_to_image(family_.get(), id), image_u8_destroy);
  return cv::Mat(image->height, image->width, CV_8U, image->buf, image->stride).clone();
}

}  // namespace poselift
