// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/cli/recognisers.h"

#include <array>
#include <nlohmann/json.hpp>

#include "src/io/text_scanner.h"

namespace poselift::cli {

std::span<const Recogniser> Recognisers() {
  static constexpr std::array kRecognisers = {
      Recogniser{"BVH motion", IsBvh, DescribeBvh},
      Recogniser{"ASF skeleton", IsAsf, DescribeAsf},
      Recogniser{"AMC motion", IsAmc, DescribeAmc},
      Recogniser{"pose dictionary", IsDictionary, DescribeDictionary},
      Recogniser{"motion codebook", IsMotionCodebook, DescribeMotionCodebook},
      Recogniser{"picture", IsImage, DescribeImage},
      Recogniser{"tags of a body", IsBodyTags, DescribeBodyTags},  // these two before cameras
      Recogniser{"calibration board", IsAprilGrid, DescribeAprilGrid},
      Recogniser{"camera", IsCamera, DescribeCamera},
      Recogniser{"video", IsVideoOfFrames, DescribeVideo},
      Recogniser{"folder of pictures", IsPictureFolder, DescribePictureFolder},
      Recogniser{"table of angles", IsAnglesCsv, DescribeAnglesCsv},
      Recogniser{"report", IsReport, DescribeReport},
      Recogniser{"lifted poses", IsPoses, DescribePoses},
      Recogniser{"true joints", IsTruth, DescribeTruth},
      Recogniser{"labels", IsLabels, DescribeLabels},  // of all JSON, so the last
  };
  return kRecognisers;
}

bool HasEnding(const std::filesystem::path& path, std::string_view ending) {
  return EqualsIgnoringCase(path.extension().string(), ending);
}

}  // namespace poselift::cli
