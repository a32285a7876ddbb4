// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <string>

#include "core/obstacles.h"
#include "core/robot_limits.h"

namespace sidestep {

/// Whether any way leads from (0, 0) to (8, 0) at the clearance that a band needs, found without bands.
struct WayVerdict {
  std::string exists;  ///< yes, no, unsure (only a raster coarser than the gap could tell)
  double least_s = 0;  ///< of the shortest way on the grid, driven straight on [s]; 0 if there is none
};

/// Obstacles stand: any-angle A* on a grid of 0.025 m around the field, at the robot's radius; `least_s` is that of the
/// shortest path driven straight.
WayVerdict standingWay(std::span<const MovingObstacle> obstacles, const RobotLimits& robot);

/// Obstacles move: all places that a disc of that size can be at, step by step in time, on a grid of 0.1 m. The disc
/// may go in any direction at up to v_max and turn at once: without such a way there is none for the robot.
WayVerdict movingWay(std::span<const MovingObstacle> obstacles, const RobotLimits& robot);

}  // namespace sidestep
