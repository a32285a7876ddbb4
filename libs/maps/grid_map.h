// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "maps/distance_field.h"

namespace mrpt::maps {
class COccupancyGridMap2D;
}

namespace sidestep {

/// MRPT's occupancy grid, and where its frame lies. MRPT's grids cannot be turned in their frame but maps of ROS can:
/// for these the grid's corner is at (0, 0) of its own frame and `T_map_grid` says where that is. All others have
/// T_map_grid = identity, so that the grid alone is the map.
struct GridMap {
  std::shared_ptr<mrpt::maps::COccupancyGridMap2D> grid;  ///< never null once read or made
  mrpt::math::TPose2D T_map_grid;

  /// The raster of its cells, with `T_map_grid` of the raster's own corner.
  GridFrame frame() const;
};

/// Which cells of a grid count as obstacles.
struct ObstacleParams {
  double occupied_above = 0.65;  ///< probability of being occupied from which a cell is an obstacle
  double free_below = 0.4;       ///< below this a cell is free; in between it is unknown
  bool unknown_blocks = true;    ///< a robot does not go where nobody has looked

  void visit(ParamVisitor& v);
  /// @throws ConfigError if the thresholds are crossed.
  void check() const;
};

/// One byte a cell, 1 = obstacle, in the order of GridFrame.
std::vector<uint8_t> blockedCells(const GridMap& map, const ObstacleParams& params = {});

/// The distance field of a map.
DistanceField distanceField(const GridMap& map, const ObstacleParams& obstacles = {},
                            const DistanceFieldParams& params = {});

}  // namespace sidestep
