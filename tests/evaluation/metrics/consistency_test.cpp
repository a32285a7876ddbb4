// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/consistency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "localization/filters/ekf.h"

namespace sidestep {
namespace {

TEST(NisBand, IsTheChiSquaresOwnWithoutAGate) {
  // mean k, variance 2 k; 1.96 standard errors of 100 of them
  for (int k = 1; k <= 3; ++k) {
    const auto b = nisBand(100, k, 1);
    EXPECT_NEAR(b.expected, k, 1e-12);
    EXPECT_NEAR(b.high - k, 1.959964 * std::sqrt(2.0 * k / 100), 1e-9);
    EXPECT_NEAR(k - b.low, b.high - k, 1e-12);
  }
}

TEST(NisBand, CountsWhatAGateTakesAway) {
  // Moments of the chi-square density below the gate, by the midpoint rule in x = t^2 (no pole at zero for k = 1).
  for (int k = 1; k <= 3; ++k) {
    const double gate = 0.9, q = chiSquareQuantile(gate, k);
    double mass = 0, mean = 0, square = 0;
    const int steps = 200000;
    const double width = std::sqrt(q) / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) * width, x = t * t, density = std::pow(x, k / 2.0 - 1) * std::exp(-x / 2) * 2 * t;
      mass += density;
      mean += x * density;
      square += x * x * density;
    }
    mean /= mass;
    const auto b = nisBand(400, k, gate);
    EXPECT_NEAR(b.expected, mean, 1e-6) << k;
    EXPECT_NEAR(b.high - b.expected, 1.959964 * std::sqrt((square / mass - mean * mean) / 400), 1e-6) << k;
  }
}

/// Mean NIS of n innovations of two dimensions whose sd is `factor` times the believed one, through a gate.
Consistency judged(uint64_t seed, double factor, double gate_probability, uint64_t count = 200) {
  Random random(seed);
  const double gate = gate_probability < 1 ? chiSquareQuantile(gate_probability, 2) : 1e18;
  double sum = 0;
  uint64_t n = 0;
  while (n < count) {
    const double x = factor * random.gaussian(), y = factor * random.gaussian(), nis = x * x + y * y;
    if (nis > gate) continue;
    sum += nis;
    ++n;
  }
  return judgeNis(sum / static_cast<double>(n), static_cast<double>(n), 2, gate_probability);
}

TEST(Consistency, MatchedNoisePassesAtNinetyFivePercent) {
  // 2000 runs, each consistent with 0.95: 1900, standard error sqrt(2000 * 0.95 * 0.05) = 9.7; 4 of them.
  for (const double gate : {1.0, 0.9973}) {
    int consistent = 0;
    for (uint64_t seed = 0; seed < 2000; ++seed) consistent += judged(seed, 1, gate).verdict == "consistent";
    EXPECT_NEAR(consistent, 1900, 39) << gate;
  }
}

TEST(Consistency, ANoiseThreeTimesWrongIsNamed) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const auto small = judged(seed, 3, 1), large = judged(seed, 1.0 / 3, 1);
    ASSERT_EQ(small.verdict, "over-confident");
    ASSERT_NEAR(small.sd_factor, 3, 0.6);
    ASSERT_EQ(large.verdict, "too cautious");
    ASSERT_NEAR(large.sd_factor, 1.0 / 3, 0.06);
    const auto gated = judged(seed, 3, 0.9973, 3000);  // though the gate hides the worst of it
    ASSERT_EQ(gated.verdict, "over-confident");
    ASSERT_NEAR(gated.sd_factor, 3, 0.7);
  }
}

TEST(Consistency, IsToldInOneLine) {
  EXPECT_EQ(
      consistencyLine("gps", "NIS", 18, judgeNis(18, 100, 2, 1)),
      "gps: over-confident: mean NIS 18, consistent is 1.61 .. 2.39; its errors have about 3 times the sd that the "
      "filter believes in");
  EXPECT_EQ(consistencyLine("gps", "NIS", 2, judgeNis(2, 100, 2, 1)),
            "gps: consistent: mean NIS 2, consistent is 1.61 .. 2.39");
}

}  // namespace
}  // namespace sidestep
