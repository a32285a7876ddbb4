// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>

#include "core/random.h"
#include "maps/grid_map.h"

/// A room drawn in the test, and what a laser sees in it.
namespace sidestep::support {

/// 10 m x 6 m, its corner at the origin, with an alcove and a pillar so that no two places look alike; cells of 5 cm.
inline GridMap room() {
  GridMap map;
  map.grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(-1.0f, 11.0f, -1.0f, 7.0f, 0.05f);
  map.grid->fill(0.5f);
  const auto block = [&](double x0, double y0, double x1, double y1, float free) {
    for (double x = x0 + 0.025; x < x1; x += 0.05)
      for (double y = y0 + 0.025; y < y1; y += 0.05)
        map.grid->setPos(static_cast<float>(x), static_cast<float>(y), free);
  };
  block(-0.1, -0.1, 10.1, 6.1, 0.02f);
  block(0, 0, 10, 6, 0.98f);
  block(0, 4, 3, 6, 0.02f);
  block(6.5, 1, 7.2, 1.5, 0.02f);
  block(8.5, 3, 10, 3.3, 0.02f);
  return map;
}

/// 14 m x 10 m with boxes and pieces of wall at random, its corner at the origin; cells of 5 cm.
inline GridMap randomRoom(uint64_t seed) {
  Random random(seed, 100);
  GridMap map;
  map.grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(-1.0f, 15.0f, -1.0f, 11.0f, 0.05f);
  map.grid->fill(0.5f);
  const auto block = [&](double x0, double y0, double x1, double y1, float free) {
    for (double x = x0 + 0.025; x < x1; x += 0.05)
      for (double y = y0 + 0.025; y < y1; y += 0.05)
        map.grid->setPos(static_cast<float>(x), static_cast<float>(y), free);
  };
  block(-0.1, -0.1, 14.1, 10.1, 0.02f);
  block(0, 0, 14, 10, 0.98f);
  for (int k = 0; k < 6; ++k) {
    const bool wall = k < 2;
    const double w = wall ? 0.1 : random.uniform(0.4, 2.5), h = random.uniform(wall ? 3 : 0.4, wall ? 6 : 1.5);
    const double x = random.uniform(1, 13 - w), y = random.uniform(0, 10 - h);
    block(x, y, x + w, y + h, 0.02f);
  }
  return map;
}

/// Range to the first occupied cell, in steps of 1 cm; far beyond the room if there is none.
inline double rangeIn(const GridMap& map, double x, double y, double angle) {
  for (double r = 0; r < 20; r += 0.01)
    if (map.grid->getPos(static_cast<float>(x + r * std::cos(angle)), static_cast<float>(y + r * std::sin(angle))) <
        0.4f)
      return r;
  return 20;
}

/// 181 beams over 270 degrees from a laser at the robot's centre.
inline mrpt::obs::CObservation2DRangeScan scanIn(const GridMap& map, const mrpt::math::TPose2D& pose, double sd,
                                                 Random& random) {
  constexpr size_t kBeams = 181;
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = static_cast<float>(1.5 * M_PI);
  o.maxRange = 20;
  o.rightToLeft = true;
  o.resizeScanAndAssign(kBeams, 0, true);
  for (size_t i = 0; i < kBeams; ++i) {
    const double angle = pose.phi - 0.75 * M_PI + 1.5 * M_PI * static_cast<double>(i) / (kBeams - 1);
    o.setScanRange(i, static_cast<float>(rangeIn(map, pose.x, pose.y, angle) + sd * random.gaussian()));
  }
  return o;
}

}  // namespace sidestep::support
