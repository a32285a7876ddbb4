// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/collision_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sidestep {
namespace {

TEST(CollisionIndex, IsOneOnTopOfAnObstacleAndZeroWithoutAny) {
  const std::vector<mrpt::math::TPoint2D> obstacles = {{1, 2}};
  EXPECT_EQ(collisionIndex({1, 2}, obstacles), 1);
  EXPECT_EQ(collisionIndex({1, 2}, {}), 0);
}

TEST(CollisionIndex, TheNearestObstacleCounts) {
  // one sigma away: exp(-1/2)
  const std::vector<mrpt::math::TPoint2D> obstacles = {{3, 0}, {0, 0.45}, {-2, -2}};
  EXPECT_NEAR(collisionIndex({0, 0}, obstacles), std::exp(-0.5), 1e-12);
}

TEST(CollisionIndex, TheThresholdIsHalfAMetreBetweenCentres) {
  // 0.45 sqrt(-2 ln 0.54) = 0.4996
  const std::vector<mrpt::math::TPoint2D> obstacles = {{0, 0}};
  EXPECT_GT(collisionIndex({0.499, 0}, obstacles), kCollisionIndexThreshold);
  EXPECT_LT(collisionIndex({0.5, 0}, obstacles), kCollisionIndexThreshold);
}

}  // namespace
}  // namespace sidestep
