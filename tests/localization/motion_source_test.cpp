// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/motion_source.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/readings.h"

namespace sidestep {
namespace {

using support::kStart_s;
using support::velocityAt;

class GyroAndWheels : public testing::Test {
 protected:
  /// The turn from second `from` to `to`, with wheels that say 0.2 rad/s.
  MotionStep between(double from, double to) {
    MotionSource source(odometry_, imu_, true);
    for (const auto& [t, rate] : rates_) source.addYawRate(kStart_s + t, rate);
    source.addOdometry(kStart_s + from, velocityAt(from, 1, 0.2));
    return source.addOdometry(kStart_s + to, velocityAt(to, 1, 0.2))->motion;
  }
  OdometryParams odometry_;
  ImuParams imu_;
  std::vector<std::pair<double, double>> rates_;
};

TEST_F(GyroAndWheels, IntegratesALinearRampExactly) {
  for (int i = 0; i <= 40; ++i) rates_.push_back({0.07 * i, 0.3 * 0.07 * i});
  // The integral of 0.3 t over [0.5, 2] is 0.15 (4 - 0.25); neither end falls on a sample.
  const auto step = between(0.5, 2);
  EXPECT_TRUE(step.turn_from_gyro);
  EXPECT_NEAR(step.turn_rad, 0.15 * 3.75, 1e-6);  // stamps of 1.6e9 s are good to 2e-7 s
  EXPECT_NEAR(step.turn_var, imu_.yaw_rate_sd * imu_.yaw_rate_sd * 1.5, 1e-9);
  EXPECT_NEAR(step.distance_m, 1.5, 1e-6);
}

TEST_F(GyroAndWheels, HoldsTheLastRateUntilTheEnd) {
  for (int i = 0; i <= 9; ++i) rates_.push_back({0.1 * i, 0.5});  // to 0.9 s
  EXPECT_NEAR(between(0, 1).turn_rad, 0.5, 1e-6);
}

TEST_F(GyroAndWheels, FallsBackToTheWheelsWhereTheGyroHasAHole) {
  for (int i = 0; i <= 20; ++i)
    if (i < 5 || i > 7) rates_.push_back({0.1 * i, 0.5});  // 0.4 s to 0.8 s, and 0.2 s is allowed
  EXPECT_FALSE(between(0, 1).turn_from_gyro);
  EXPECT_NEAR(between(0, 1).turn_rad, 0.2, 1e-6);
  EXPECT_TRUE(between(1, 2).turn_from_gyro);
}

TEST_F(GyroAndWheels, FallsBackToTheWheelsBeforeAndAfterTheGyro) {
  EXPECT_FALSE(between(0, 1).turn_from_gyro);
  for (int i = 0; i <= 10; ++i) rates_.push_back({1 + 0.1 * i, 0.5});
  EXPECT_FALSE(between(0, 1.5).turn_from_gyro);
  EXPECT_FALSE(between(1.5, 3).turn_from_gyro);
}

TEST_F(GyroAndWheels, BridgesHolesWhenTheGyroIsAskedFor) {
  imu_.yaw_rate = "on";
  rates_ = {{0, 0.5}, {1, 0.5}};
  EXPECT_TRUE(between(0, 1).turn_from_gyro);
  EXPECT_NEAR(between(0, 1).turn_rad, 0.5, 1e-6);
}

TEST_F(GyroAndWheels, PutsALateStampedGyroBack) {
  imu_.delay_s = 0.5;
  for (int i = 0; i <= 50; ++i) rates_.push_back({0.05 * i, 0.3 * (0.05 * i - 0.5)});  // a ramp from true time 0
  EXPECT_NEAR(between(0, 1).turn_rad, 0.15, 1e-6);
}

TEST_F(GyroAndWheels, PassesOverRatesThatAreNotFinite) {
  for (int i = 0; i <= 20; ++i) {
    rates_.push_back({0.05 * i, 0.5});
    rates_.push_back({0.05 * i + 0.01, std::numeric_limits<double>::quiet_NaN()});
  }
  EXPECT_NEAR(between(0, 1).turn_rad, 0.5, 1e-6);
}

TEST(MotionSource, ShowsTheGyrosBiasWhileTheWheelsRest) {
  MotionSource source({}, {}, true);
  for (int i = 0; i <= 20; ++i) source.addYawRate(kStart_s + 0.1 * i, 0.03);
  source.addOdometry(kStart_s, velocityAt(0, 0, 0));
  const auto step = source.addOdometry(kStart_s + 1, velocityAt(1, 0, 0));
  EXPECT_TRUE(step->motion.still);
  EXPECT_EQ(step->motion.turn_rad, 0);
  ASSERT_TRUE(step->resting_rate);
  EXPECT_NEAR(*step->resting_rate, 0.03, 1e-6);
}

TEST(MotionSource, DoesNotCallARobotStillThatIsBeingTurned) {
  MotionSource source({}, {}, true);
  for (int i = 0; i <= 20; ++i) source.addYawRate(kStart_s + 0.1 * i, 0.5);
  source.addOdometry(kStart_s, velocityAt(0, 0, 0));
  const auto step = source.addOdometry(kStart_s + 1, velocityAt(1, 0, 0));
  EXPECT_FALSE(step->motion.still);
  EXPECT_FALSE(step->resting_rate);
  EXPECT_NEAR(step->motion.turn_rad, 0.5, 1e-6);
}

TEST(MotionSource, CanBeToldNotToLookForStandingStill) {
  MotionSource source({}, {}, false);
  source.addOdometry(kStart_s, velocityAt(0, 0, 0));
  EXPECT_FALSE(source.addOdometry(kStart_s + 1, velocityAt(1, 0, 0))->motion.still);
}

}  // namespace
}  // namespace sidestep
