// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/diff_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

RobotLimits wide() {
  RobotLimits l;
  l.v_max = 2, l.v_reverse = 1, l.w_max = 3, l.accel = l.brake = l.turn_accel = 1000;
  return l;
}

void go(DiffDrive& base, double from_s, double to_s, double dt = 0.01) {
  for (int k = 1; from_s + k * dt <= to_s + 1e-9; ++k) base.step(from_s + k * dt, dt);
}

TEST(DiffDrive, DrivesACircleExactlyWhateverTheStep) {
  for (const double dt : {0.01, 0.1}) {
    DiffDrive base({}, wide(), {0, 0, 0}, Random(1));
    base.order(0, {1, 0, 0.5});
    base.step(dt, dt);  // up to speed within the first step
    const auto start = base.pose();
    go(base, dt, dt + 2 * M_PI, dt);
    const double turned = 0.5 * std::floor(2 * M_PI / dt + 1e-9) * dt;
    const auto expected = alongArc(start, 2 * turned, turned);
    EXPECT_NEAR(base.pose().x, expected.x, 1e-9);
    EXPECT_NEAR(base.pose().y, expected.y, 1e-9);
  }
}

TEST(DiffDrive, AcceleratesAndBrakesWithinItsLimits) {
  RobotLimits l = wide();
  l.accel = 0.5, l.brake = 1;
  DiffDrive base({}, l, {0, 0, 0}, Random(1));
  base.order(0, {1, 0, 0});
  go(base, 0, 2);  // 0.5 m/s^2 for 2 s: 1 m/s, 1 m
  EXPECT_NEAR(base.pose().x, 1, 1e-9);
  EXPECT_NEAR(base.twist().vx, 1, 0.0026);  // mean of the last step
  base.order(2, {0, 0, 0});
  go(base, 2, 4);  // 1 m/s^2: another 0.5 m
  EXPECT_NEAR(base.pose().x, 1.5, 1e-9);
  EXPECT_NEAR(base.twist().vx, 0, 1e-12);
}

TEST(DiffDrive, AnswersAfterItsLatency) {
  DriveParams p;
  p.latency_s = 0.3;
  DiffDrive base(p, wide(), {0, 0, 0}, Random(1));
  base.order(0, {1, 0, 0});
  go(base, 0, 0.3);
  EXPECT_EQ(base.pose().x, 0);
  go(base, 0.3, 1.3);
  EXPECT_NEAR(base.pose().x, 1, 0.006);  // half a step to get up to speed
}

TEST(DiffDrive, LagsBehindAsAFirstOrderSystem) {
  DriveParams p;
  p.lag_s = 0.2;
  DiffDrive base(p, wide(), {0, 0, 0}, Random(1));
  base.order(0, {1, 0, 0});
  go(base, 0, 0.2);
  EXPECT_NEAR(base.twist().vx, 1 - std::exp(-1), 0.01);
}

TEST(DiffDrive, KeepsToTheLimitsOfSpeedAndWheels) {
  RobotLimits l = wide();
  DiffDrive base({}, l, {0, 0, 0}, Random(1));
  base.order(0, {9, 0, 9});
  go(base, 0, 0.1);
  EXPECT_DOUBLE_EQ(base.target().vx, 2);
  EXPECT_DOUBLE_EQ(base.target().omega, 3);
  base.order(0.1, {-9, 0, 0});
  go(base, 0.1, 0.2);
  EXPECT_DOUBLE_EQ(base.target().vx, -1);
  l.wheel_speed_max = 1.3, l.track_m = 0.4;  // 2 m/s and 3 rad/s need 2.6 m/s of one wheel: half of both is left
  DiffDrive slow({}, l, {0, 0, 0}, Random(1));
  slow.order(0, {2, 0, 3});
  go(slow, 0, 0.1);
  EXPECT_DOUBLE_EQ(slow.target().vx, 1);
  EXPECT_DOUBLE_EQ(slow.target().omega, 1.5);
}

TEST(DiffDrive, SlippingWheelsTurnMoreThanTheyRoll) {
  DriveParams p;
  p.slip_mean = 0.2;
  DiffDrive base(p, wide(), {0, 0, 0}, Random(1));
  base.order(0, {1, 0, 0});
  go(base, 0, 1);
  const double before = base.pose().x;
  base.step(1.01, 0.01);
  EXPECT_NEAR(base.wheelDistance(), 0.01, 1e-12);
  EXPECT_NEAR(base.pose().x - before, 0.008, 1e-12);
}

TEST(DiffDrive, StopsWhenNobodyOrdersAndForOrdersThatAreNoNumbers) {
  DriveParams p;
  p.timeout_s = 0.5;
  DiffDrive base(p, wide(), {0, 0, 0}, Random(1));
  base.order(0, {1, 0, 0});
  go(base, 0, 0.5);
  EXPECT_GT(base.twist().vx, 0.9);
  go(base, 0.5, 0.7);
  EXPECT_EQ(base.twist().vx, 0);
  base.order(0.7, {std::nan(""), 0, 1});
  go(base, 0.7, 0.8);
  EXPECT_EQ(base.twist().vx, 0);
  EXPECT_TRUE(std::isfinite(base.pose().x));
}

}  // namespace
}  // namespace sidestep
