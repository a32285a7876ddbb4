// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/drive_conversion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sidestep::testing {
namespace {

TEST(DriveConversion, StraightAheadIsStraight) {
  const auto t = driveFor({0.5, 0.5}, M_PI / 4, 1, 2, 2);
  EXPECT_NEAR(t.vx, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(t.omega, 0, 1e-12);
}

TEST(DriveConversion, EndsOnTheArcNearestToTheVelocitysEnd) {
  // phi = 90 deg in 1 s: arc of radius R = v / w ends at (R, R), nearest to (0, 1) for R = 1/2: v = pi / 4.
  const auto t = driveFor({0, 1}, 0, 1, 2, 2);
  EXPECT_NEAR(t.omega, M_PI / 2, 1e-12);
  EXPECT_NEAR(t.vx, M_PI / 4, 1e-12);
}

TEST(DriveConversion, BehindItTurnsOnTheSpotAndLimitsHold) {
  const auto t = driveFor({-1, 1e-9}, 0, 1, 2, 2);
  EXPECT_NEAR(t.vx, 0, 1e-6);
  EXPECT_NEAR(t.omega, 2, 1e-9);
  const auto still = driveFor({0, 0}, 1, 1, 2, 2);
  EXPECT_EQ(still.vx, 0);
  EXPECT_EQ(still.omega, 0);
}

}  // namespace
}  // namespace sidestep::testing
