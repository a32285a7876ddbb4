// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/obstacles.h"
#include "maps/grid_map.h"

namespace sidestep {

/// The walls of a map: the lines between obstacle cells and others, each as long as it is straight. What nobody has
/// looked at is no wall, unless `obstacles` says so. [m], map frame
std::vector<Segment> wallsOf(const GridMap& map, const ObstacleParams& obstacles);

}  // namespace sidestep
