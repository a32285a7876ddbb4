// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/grid_map.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <array>

#include "core/errors.h"

namespace sidestep {

using mrpt::maps::COccupancyGridMap2D;

GridFrame GridMap::frame() const {
  const double x = grid->getXMin(), y = grid->getYMin();
  const double c = std::cos(T_map_grid.phi), s = std::sin(T_map_grid.phi);
  return {static_cast<int>(grid->getSizeX()),
          static_cast<int>(grid->getSizeY()),
          grid->getResolution(),
          {T_map_grid.x + c * x - s * y, T_map_grid.y + s * x + c * y, T_map_grid.phi}};
}

void ObstacleParams::visit(ParamVisitor& v) {
  v.number("occupied_above", occupied_above, {0.01, 0.99}, "",
           "probability of being occupied above which a cell is an obstacle");
  v.number("free_below", free_below, {0.01, 0.99}, "",
           "below this probability a cell is free; in between it is unknown");
  v.flag("unknown_blocks", unknown_blocks, "unknown cells are obstacles");
}

void ObstacleParams::check() const {
  if (free_below > occupied_above)
    throw ConfigError("free_below = " + shortestNumber(free_below) + " lies above occupied_above = " +
                      shortestNumber(occupied_above) + "; a cell cannot be both free and occupied");
}

std::vector<uint8_t> blockedCells(const GridMap& map, const ObstacleParams& params) {
  params.check();
  const double limit = params.unknown_blocks ? params.free_below : params.occupied_above;
  std::array<uint8_t, 256> blocked{};  // by log-odds of being free, as MRPT keeps them
  for (int l = -128; l < 128; ++l) {
    const double occupied = 1 - static_cast<double>(COccupancyGridMap2D::l2p(static_cast<int8_t>(l)));
    blocked[static_cast<uint8_t>(l)] = params.unknown_blocks ? occupied >= limit : occupied > limit;
  }
  const auto& cells = map.grid->getRawMap();
  const auto count = static_cast<size_t>(map.grid->getSizeX()) * static_cast<size_t>(map.grid->getSizeY());
  std::vector<uint8_t> out(count);
  std::transform(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(count), out.begin(),
                 [&](auto l) { return blocked[static_cast<uint8_t>(l)]; });
  return out;
}

DistanceField distanceField(const GridMap& map, const ObstacleParams& obstacles, const DistanceFieldParams& params) {
  return {map.frame(), blockedCells(map, obstacles), params};
}

}  // namespace sidestep
