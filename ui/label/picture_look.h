// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <opencv2/core/mat.hpp>

namespace poselift {

// How a picture is shown, so that joints in the dark are seen. Of a grey g from 0 to 1:
//   g -> ((g - 1/2) contrast + 1/2 + brightness) ^ (1 / gamma), within 0 and 1.
struct PictureLook {
  double brightness = 0.0;  // -1 to 1
  double contrast = 1.0;    // 0.1 to 10
  double gamma = 1.0;       // 0.1 to 10

  bool IsPlain() const { return brightness == 0.0 && contrast == 1.0 && gamma == 1.0; }
  // 1 x 256, for cv::LUT.
  cv::Mat1b Table() const;
};

}  // namespace poselift
