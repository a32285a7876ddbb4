// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"

namespace sidestep {
namespace {

TEST(Trajectory, TheCircleIsACircle) {
  TrajectoryParams p;  // diameter 40 m, 2 m/s: w = 0.1 rad/s, centre (0, 20)
  const auto truth = sampleTrajectory(p);
  ASSERT_EQ(truth.size(), 6301u);
  for (const auto& s : truth) {
    const double a = 0.1 * s.time_s;
    EXPECT_NEAR(s.pose.x, 20 * std::sin(a), 1e-10);
    EXPECT_NEAR(s.pose.y, 20 - 20 * std::cos(a), 1e-10);
    EXPECT_NEAR(std::remainder(s.pose.phi - a, 2 * M_PI), 0, 1e-12);
    EXPECT_DOUBLE_EQ(s.w, 0.1);
  }
  EXPECT_EQ(truth[0].distance_m, 0);
  EXPECT_NEAR(truth[1].distance_m, 0.02, 1e-15);
  EXPECT_NEAR(truth[1].turn_rad, 0.001, 1e-15);
}

TEST(Trajectory, ANegativeDiameterMirrorsTheCircle) {
  TrajectoryParams p;
  const auto left = sampleTrajectory(p);
  p.diameter_m = -p.diameter_m;
  const auto right = sampleTrajectory(p);
  for (size_t i = 0; i < left.size(); i += 100) {
    EXPECT_NEAR(left[i].pose.x, right[i].pose.x, 1e-12);
    EXPECT_NEAR(left[i].pose.y, -right[i].pose.y, 1e-12);
  }
}

TEST(Trajectory, TheStepDoesNotChangeWhereItLeads) {
  TrajectoryParams p;
  p.kind = "sinusoid";
  p.w_amplitude = 1.5, p.w_frequency = 1.1, p.w_phase = 0.3, p.w_mean = 0.05;
  p.duration_s = 20;
  p.step_s = 0.001;
  const auto fine = sampleTrajectory(p).back();
  p.step_s = 0.1;
  const auto coarse = sampleTrajectory(p).back();
  EXPECT_NEAR(fine.pose.x, coarse.pose.x, 1e-9);
  EXPECT_NEAR(fine.pose.y, coarse.pose.y, 1e-9);
  EXPECT_NEAR(fine.pose.phi, coarse.pose.phi, 1e-12);
}

TEST(Trajectory, ATableIsLinearBetweenItsRows) {
  // 0.5 s of ramp to 1 m/s, 1 s straight on, then 1 s of a quarter turn: 0.25 + 1 m, then a quarter of a circle of
  // radius 1 / (pi / 2). The corner at 1.5 s is a jump, written as two close rows, and lies inside a step of 0.4 s.
  TrajectoryParams p;
  p.kind = "table";
  p.duration_s = 2.5;
  p.step_s = 0.5;
  p.profile = {{0, 0, 0}, {0.5, 1, 0}, {1.5, 1, 0}, {1.5 + 1e-9, 1, M_PI / 2}};
  const auto truth = sampleTrajectory(p);
  ASSERT_EQ(truth.size(), 6u);
  EXPECT_NEAR(truth[1].pose.x, 0.25, 1e-12);
  EXPECT_NEAR(truth[3].pose.x, 1.25, 1e-12);
  EXPECT_NEAR(truth[5].pose.x, 1.25 + 2 / M_PI, 1e-8);
  EXPECT_NEAR(truth[5].pose.y, 2 / M_PI, 1e-8);
  EXPECT_NEAR(truth[5].pose.phi, M_PI / 2, 1e-8);
  p.step_s = 0.4;
  EXPECT_NEAR(sampleTrajectory(p)[6].pose.phi, M_PI / 2 * 0.9, 1e-8);
}

TEST(Trajectory, ATableThatBeginsLateGoesOnAsItsFirstRowBefore) {
  TrajectoryParams p;
  p.kind = "table";
  p.duration_s = 2;
  p.step_s = 1;
  p.profile = {{1, 2, 0}, {2, 4, 0}};
  const auto truth = sampleTrajectory(p);
  EXPECT_NEAR(truth[1].pose.x, 2, 1e-12);      // 2 m/s for 1 s
  EXPECT_NEAR(truth[2].pose.x, 2 + 3, 1e-12);  // the mean of 2 and 4 m/s for 1 s
}

std::string errorOf(const TrajectoryParams& p) {
  try {
    p.check();
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(Trajectory, WhatCannotBeIsRefusedByName) {
  TrajectoryParams p;
  p.kind = "table";
  EXPECT_EQ(errorOf(p), "trajectory.profile: kind: table needs rows of t, v, w");
  p.profile = {{0, 1, 0}, {0, 2, 0}};
  EXPECT_EQ(errorOf(p), "trajectory.profile[1].t: times must grow from row to row");
  p = {};
  p.diameter_m = 0;
  EXPECT_EQ(errorOf(p), "trajectory.diameter_m = 0 m: no circle; at least 0.001");
  p = {};
  p.duration_s = 0.001;
  EXPECT_EQ(errorOf(p), "trajectory.duration_s: is shorter than trajectory.step_s");
}

}  // namespace
}  // namespace sidestep
