// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/random_codebook.h"

#include <limits>

#include "tests/support/planted_pose.h"
#include "tests/support/random_dictionary.h"

namespace poselift::testing {

MotionCodebook RandomCodebook(int num_segments, std::mt19937_64 rng) {
  MotionCodebook codebook;
  codebook.skeleton = SmallSkeleton();
  codebook.segments = RandomMatrix(kSegmentRows, num_segments, &rng).cast<float>();
  codebook.rates = RandomMatrix(kNumFeatures, num_segments, &rng).cast<float>();
  codebook.deviations = RandomMatrix(kNumFeatures, num_segments, &rng).cast<float>().cwiseAbs();
  AccelerationModels& models = codebook.accelerations;
  models.means = RandomMatrix(kNumFeatures, num_segments, &rng).cast<float>();
  models.directions =
      RandomMatrix(kAccelerationInputs * kAccelerationRank, num_segments, &rng).cast<float>();
  models.responses =
      RandomMatrix(kNumFeatures * kAccelerationRank, num_segments, &rng).cast<float>();
  models.deviations = RandomMatrix(kNumFeatures, num_segments, &rng).cast<float>().cwiseAbs();
  codebook.record = {.sources = {"a.amc", "b \"1\".amc"},
                     .command = "poselift train --motion",
                     .commit = "0123abc",
                     .num_segments = 3'000'000'000,
                     .seed = std::numeric_limits<unsigned long>::max(),
                     .rms_error_mm = 12.345678901234567};
  return codebook;
}

}  // namespace poselift::testing
