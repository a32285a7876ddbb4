// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/map_walls.h"

#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <cmath>

namespace sidestep {
namespace {

TEST(MapWalls, AreTheOutlineOfWhatIsOccupied) {
  // 10 x 10 cells of 0.5 m from (0, 0): an L of three cells at (2, 3), (3, 3), (2, 4), turned by 90 degrees in the map.
  GridMap map;
  map.grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(0.0f, 5.0f, 0.0f, 5.0f, 0.5f);
  map.grid->fill(0.9f);  // of being free
  for (const auto& [x, y] : {std::pair{2, 3}, {3, 3}, {2, 4}}) map.grid->setCell(x, y, 0.05f);
  map.grid->setCell(7, 7, 0.5f);  // unknown
  map.T_map_grid = {10, 0, M_PI / 2};
  ObstacleParams known_only;
  known_only.unknown_blocks = false;
  const auto walls = wallsOf(map, known_only);
  ASSERT_EQ(walls.size(), 6u);  // an L has six sides
  double length = 0;
  for (const auto& w : walls) {
    length += (w.b - w.a).norm();
    for (const auto& p : {w.a, w.b}) {  // grid x 1 .. 2 is map y, grid y 1.5 .. 2.5 is 10 - map x
      EXPECT_GE(p.y, 1 - 1e-9);
      EXPECT_LE(p.y, 2 + 1e-9);
      EXPECT_GE(p.x, 7.5 - 1e-9);
      EXPECT_LE(p.x, 8.5 + 1e-9);
    }
  }
  EXPECT_NEAR(length, 4, 1e-9);
  EXPECT_EQ(wallsOf(map, {}).size(), 10u) << "the unknown cell counts by default";
}

}  // namespace
}  // namespace sidestep
