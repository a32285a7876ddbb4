// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/measurements.h"

namespace sidestep {
namespace {

using support::stepOf;

TEST(Moved, GoesAlongTheHeadingHalfWayThroughTheTurn) {
  // From (1, 2) heading 90 deg, 2 m and a turn of 60 deg: direction 120 deg, cos = -1/2, sin = sqrt(3)/2.
  const auto p = moved({1, 2, M_PI / 2}, stepOf(1, 2, M_PI / 3));
  EXPECT_NEAR(p.x, 1 - 1, 1e-15);
  EXPECT_NEAR(p.y, 2 + std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(p.phi, M_PI * 5 / 6, 1e-15);
}

TEST(Moved, GoesBackOnTheSameChord) {
  const auto there = moved({3, -1, 0.7}, stepOf(1, 1.5, 0.4));
  const auto back = moved(there, stepOf(1, -1.5, -0.4));
  EXPECT_NEAR(back.x, 3, 1e-15);
  EXPECT_NEAR(back.y, -1, 1e-15);
  EXPECT_NEAR(back.phi, 0.7, 1e-15);
}

TEST(MotionStep, PartsAddUpToTheWhole) {
  auto whole = stepOf(2, 3, -0.5);
  whole.distance_var = 0.2;
  whole.turn_var = 0.1;
  whole.turn_from_gyro = true;
  const auto a = whole.part(0.3), b = whole.part(0.7);
  EXPECT_DOUBLE_EQ(a.dt_s, 0.6);
  EXPECT_DOUBLE_EQ(a.dt_s + b.dt_s, whole.dt_s);
  EXPECT_DOUBLE_EQ(a.distance_m + b.distance_m, whole.distance_m);
  EXPECT_DOUBLE_EQ(a.turn_rad + b.turn_rad, whole.turn_rad);
  EXPECT_DOUBLE_EQ(a.distance_var + b.distance_var, whole.distance_var);
  EXPECT_DOUBLE_EQ(a.turn_var + b.turn_var, whole.turn_var);
  EXPECT_TRUE(a.turn_from_gyro);
  EXPECT_FALSE(a.still);
}

/// Variances after 10 s at 2 m/s and 0.5 rad/s, read `rate` times a second.
MotionStep variancesAfterTenSeconds(const MotionNoiseParams& noise, int rate) {
  MotionStep sum;
  for (int i = 0; i < 10 * rate; ++i) {
    auto s = stepOf(1.0 / rate, 2.0 / rate, 0.5 / rate);
    noise.apply(s);
    sum.distance_var += s.distance_var;
    sum.turn_var += s.turn_var;
  }
  return sum;
}

TEST(MotionNoise, GrowsAlikeAtAnyRateWithANoisePeriod) {
  MotionNoiseParams noise;
  noise.noise_period_s = 2;
  // sd_v = 0.05 * 2 + 0.01 * 0.5 = 0.105; sum of sd_v^2 * dt * T over 10 s = 0.105^2 * 10 * 2.
  // sd_w = 0.02 * 2 + 0.05 * 0.5 + 0.002 = 0.067.
  for (int rate : {1, 10, 100}) {
    const auto sum = variancesAfterTenSeconds(noise, rate);
    EXPECT_NEAR(sum.distance_var, 0.105 * 0.105 * 20, 1e-12) << rate;
    EXPECT_NEAR(sum.turn_var, 0.067 * 0.067 * 20, 1e-12) << rate;
  }
}

TEST(MotionNoise, IsOfEachStepAsPrintedWithoutANoisePeriod) {
  MotionNoiseParams noise;
  noise.noise_period_s = 0;
  noise.turn_floor = 0;
  noise.a5 = 0.03;
  noise.a6 = 0.04;
  auto s = stepOf(0.1, -0.2, 0.05);  // v = -2, w = 0.5: noise goes with their sizes
  noise.apply(s);
  // (3.2): sd_v = 0.05*2 + 0.01*0.5 = 0.105, sd_w = 0.02*2 + 0.05*0.5 = 0.065; (3.6): sd_gamma = 0.03*2 + 0.04*0.5 =
  // 0.08.
  EXPECT_NEAR(s.distance_var, std::pow(0.105 * 0.1, 2), 1e-15);
  EXPECT_NEAR(s.turn_var, (0.065 * 0.065 + 0.08 * 0.08) * 0.1 * 0.1, 1e-15);
  // Ten times the rate, a tenth of the variance: N steps of (sd dt)^2 are T^2 sd^2 / N.
  EXPECT_NEAR(variancesAfterTenSeconds(noise, 10).distance_var, 10 * variancesAfterTenSeconds(noise, 100).distance_var,
              1e-12);
}

TEST(MotionNoise, LeavesAStepWithoutDurationAlone) {
  auto s = stepOf(0, 1, 1);
  MotionNoiseParams().apply(s);
  EXPECT_EQ(s.distance_var, 0);
  EXPECT_EQ(s.turn_var, 0);
}

}  // namespace
}  // namespace sidestep
