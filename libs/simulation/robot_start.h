// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <span>

#include "core/random.h"
#include "simulation/crowd.h"
#include "simulation/wall_index.h"
#include "simulation/world_params.h"

namespace sidestep {

/// Where a robot begins and where it goes.
struct RobotStart {
  mrpt::math::TPose2D pose;  ///< [m, rad]
  mrpt::math::TPoint2D goal;
};

/// As the parameters say, with what they leave to chance drawn: the shift and turn of the start, or start and goal of a route,
/// clear of walls and of whoever is there; it starts facing its goal.
/// @throws ConfigError if no such route is found.
RobotStart drawStart(const RobotParams& params, Random random, std::span<const Person> people, const WallIndex& walls);

}  // namespace sidestep
