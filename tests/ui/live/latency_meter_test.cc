// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/latency_meter.h"

#include <gtest/gtest.h>

namespace poselift::cli {
namespace {

TEST(LatencyMeterTest, QuantilesAreThoseOfTheTimes) {
  LatencyMeter meter;
  EXPECT_EQ(meter.Quantile_ms(0.5), 0.0);
  for (int ms = 1; ms <= 100; ++ms) meter.Add(1e-3 * ms);
  EXPECT_EQ(meter.count(), 100);
  EXPECT_NEAR(meter.Quantile_ms(0.5), 50.0, 0.15);
  EXPECT_NEAR(meter.Quantile_ms(0.99), 99.0, 0.15);
}

TEST(LatencyMeterTest, TimesBeyondItsRangeCountAtItsEnds) {
  LatencyMeter meter;
  meter.Add(-1.0);
  EXPECT_NEAR(meter.Quantile_ms(1.0), 0.0, 0.1);
  meter.Add(1e9);
  EXPECT_NEAR(meter.Quantile_ms(1.0), 1e3 * LatencyMeter::kLongest_s, 0.1);
  EXPECT_EQ(meter.num_over(), 1);
  EXPECT_EQ(meter.QuantileText(1.0), "over 2 s");
  EXPECT_EQ(meter.QuantileText(0.5), "0.1 ms");
}

}  // namespace
}  // namespace poselift::cli
