// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/nearest_reachable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grid_worlds.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

DistanceField fieldOf(const std::vector<std::string>& lines) {
  const auto world = testing::drawn(lines, 0.1);
  return DistanceField(world.frame, world.blocked);
}

double length(const std::vector<TPoint2D>& way) {
  double out = 0;
  for (size_t i = 1; i < way.size(); ++i) out += (way[i] - way[i - 1]).norm();
  return out;
}

/// A corridor two cells high beside a hall, a wall of one cell between them, open at the far right.
const std::vector<std::string> kCorridor = {"....................", "....................", "....................",
                                            "....................", "....................", "##############......",
                                            "....................", "....................", "####################"};

TEST(NearestReachable, LeadsAroundTheWallWhereTheCrowFliesThroughIt) {
  const auto field = fieldOf(kCorridor);
  const TPoint2D from(0.95, 0.15);  // in the corridor, 0.4 m below the hall
  const auto as_the_crow_flies = field.nearestFree(from, 0.2, 5);
  ASSERT_TRUE(as_the_crow_flies);
  EXPECT_LT((*as_the_crow_flies - from).norm(), 0.6);
  const auto way = wayToClearance(field, from, 0.2, 5);
  ASSERT_GT(way.size(), 2u);
  EXPECT_EQ(way.front(), from);
  EXPECT_GE(field.clearance(way.back().x, way.back().y), 0.2);
  EXPECT_GT(way.back().x, 1.3) << "the opening begins at x = 1.4";
  for (const auto& p : way) EXPECT_GT(field.clearance(p.x, p.y), 0);
  EXPECT_TRUE(wayToClearance(field, from, 0.2, length(way) - 0.2).empty()) << "farther than allowed";
}

TEST(NearestReachable, APlaceWithRoomIsItself) {
  const auto field = fieldOf(kCorridor);
  const auto way = wayToClearance(field, {0.95, 0.65}, 0.1, 5);
  ASSERT_EQ(way.size(), 1u);
  EXPECT_EQ(way[0], TPoint2D(0.95, 0.65));
}

TEST(NearestReachable, OutOfAnObstacleItGoesTheShortestWay) {
  const auto field = fieldOf(kCorridor);
  const auto way = wayToClearance(field, {0.95, 0.35}, 0.1, 5);
  ASSERT_GE(way.size(), 2u);
  EXPECT_LT(length(way), 0.3);
}

TEST(NearestReachable, NothingIsFoundWhereNothingIs) {
  const auto field = fieldOf({"####", "#..#", "#..#", "####"});
  EXPECT_TRUE(wayToClearance(field, {0.2, 0.2}, 0.5, 10).empty());
  EXPECT_TRUE(wayToClearance(field, {90, 90}, 0.1, 10).empty());
  EXPECT_TRUE(wayToClearance(field, {std::nan(""), 0}, 0.1, 10).empty());
}

/// A wall without thickness, known exactly.
TEST(NearestReachable, AWallThinnerThanACellIsAWall) {
  GridFrame frame{40, 40, 0.05, {0, 0, 0}};
  std::vector<float> clearances;
  for (int iy = 0; iy < 40; ++iy)
    for (int ix = 0; ix < 40; ++ix) {
      const auto p = frame.centre(ix, iy);
      // the line y = 0.512 from end to end, and y = 0.3 as the other side of a corridor
      clearances.push_back(static_cast<float>(std::min(std::abs(p.y - 0.512), std::abs(p.y - 0.3))));
    }
  const DistanceField field(frame, std::span<const float>(clearances));
  EXPECT_TRUE(wayToClearance(field, {1, 0.4}, 0.3, 5).empty());
  EXPECT_FALSE(wayToClearance(field, {1, 0.6}, 0.3, 5).empty());
  EXPECT_NEAR(field.clearance(1.025, 0.425), 0.087, 1e-6);
}

}  // namespace
}  // namespace sidestep
